"""Jülicher & Lipowsky (1993, 1996), Lipowsky (1992): a domain without curvature of its own buds to shorten its edge."""

import math

import numpy as np
from scipy.optimize import brentq
from scipy.special import j0, j1

from comparisons.drawing.style import plt
from comparisons.paper.figures import COLOURS
from comparisons.paper.item import Printed, Result, followed, no_runs, text

TITLE = "Budding by line tension (Jülicher & Lipowsky 1996)"
SOURCE = (
    "R. Lipowsky, J. Phys. II France 2, 1825 (1992); F. Jülicher, R. Lipowsky, Phys. Rev. Lett. 70, 2964 (1993) and "
    "Phys. Rev. E 53, 2670 (1996)"
)

#: The membrane: energy ½ β κ² per area, in pN nm; radii of domain and rim, width of the edge, in nm; where the branch ends, in pN.
STIFFNESS, PATCH, RIM, WIDTH, LAST_LINE_ENERGY = 50.0, 100.0, 400.0, 0.3, 25

#: Spontaneous curvatures (1/nm) that say to which side the domain buds; the second one is eight times as large, so that what goes
#: with the power 2/3 of it is four times as large.
FAINT = (8e-5, 6.4e-4)

#: Neck radii (nm) at which the branch is read, well above the edge's width; what the second ones give beside the first is how well
#: the limit is known.
NECKS = ((8.0, 4.0, 2.0), (10.0, 5.0, 2.5))

SETTINGS = {
    "domain.radius": f"{RIM:g}",
    "domain.height": "900",
    "membrane.bending_stiffness": f"{2 * STIFFNESS:g}",
    "membrane.bending_stiffness_coated": f"{2 * STIFFNESS:g}",
    "molecules.patch_radius": f"{PATCH:g}",
    "molecules.interface_width": f"{WIDTH:g}",
    "molecules.line_energy": "2",
}

wanted = no_runs


def domain_radius():
    """Radius L (nm) of the flat domain whose molecules are in equilibrium: a round edge has c = √2 ε_c/(12 L) around it, and as much
    more inside, which is taken from the domain."""
    trace = math.sqrt(2) * WIDTH / 12
    return brentq(lambda radius: radius**2 + trace * RIM**2 / radius - PATCH**2, 0.8 * PATCH, PATCH)


def line_tension(line_energy):
    """τ L/β of a line energy σ̂ (pN): a flat edge costs τ = σ̂ √2/6 per length."""
    return line_energy * math.sqrt(2) / 6 * domain_radius() / STIFFNESS


def stability_limit():
    """τ L/β beyond which a flat disc in a flat membrane of the same stiffness, clamped horizontally at the rim, buckles.

    The edge compresses the disc by τ/L, the membrane around bears nothing: Δw = a J₀(kr) with k² = τ/(Lβ) inside and w' = b (r − R²/r)
    outside, so that k J₀(kL)/J₁(kL) = −2L/(R² − L²). j₀₁² = 5.783 in an infinite membrane.
    """
    radius = domain_radius()
    ratio = 2 * radius**2 / (RIM**2 - radius**2)
    return brentq(lambda x: x * j0(x) + ratio * j1(x), 2.0, 3.0) ** 2


def instability(branches):
    """τ L/β at the first fold, without spontaneous curvature: what C takes off goes with C^(2/3)."""
    faint, stronger = (line_tension(branch.folds[0]) for branch in branches)
    return faint + (faint - stronger) / 3


def closing(branch, necks):
    """(values, limit): τ L/β where the last part of the branch has three neck radii (nm), and for a neck of radius a → 0.

    The catenoid around a narrow neck makes corrections of the order (a/L) ln(a/L) and a/L, which three necks determine.
    """
    neck, tension = branch.columns["neck_radius_nm"], line_tension(branch.columns["followed_value"])
    last = slice(int(np.argmin(np.where(np.isfinite(neck), tension, np.inf))), None)
    values = np.interp(necks, neck[last][::-1], tension[last][::-1])
    part = np.array(necks) / domain_radius()
    columns = np.column_stack([np.ones(3), part * np.log(part), part])
    return values, float(np.linalg.solve(columns, values)[0])


def draw(branch):
    """The bud's height along the branch against the line tension."""
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    height = branch.columns["bud_height_nm"] / domain_radius()
    axes.plot(line_tension(branch.columns["followed_value"]), height, color=COLOURS[0], label="stationary shapes")
    for value, name in ((4, "neck closes (1993)"), (stability_limit(), "flat disc buckles"), (8, "flat cap buckles (1992)")):
        axes.axvline(value, color="0.6", linewidth=0.8)
        axes.annotate(name, (value, 0.5), rotation=90, xytext=(3, 0), textcoords="offset points", fontsize="small")
    axes.set(xlabel="line tension τ L/β", ylabel="height / L", xlim=(2, 9))
    return figure


def result(runs, quick):
    """See item.Result."""
    branches = [
        followed(
            "line-tension",
            "molecules.line_energy",
            LAST_LINE_ENERGY,
            {**SETTINGS, "membrane.spontaneous_curvature": f"{curvature:g}"},
        )
        for curvature in FAINT
    ]
    branch = branches[0]
    names = ("bud_height_nm", "neck_radius_nm", "bending_energy_pN_nm", "line_energy_pN_nm")
    rows = [
        {"line_tension": float(line_tension(value)), **{name: none_if_nan(x) for name, x in zip(names, row)}}
        for value, *row in zip(branch.columns["followed_value"], *(branch.columns[name] for name in names))
    ]
    values, limit = closing(branch, NECKS[0])
    uncertainty = abs(closing(branch, NECKS[1])[1] - limit)
    at_necks = ", ".join(f"{text(value)} at {neck:g} nm" for neck, value in zip(NECKS[0], values))
    sphere = 8 * math.pi * STIFFNESS
    energy = branch.columns["bending_energy_pN_nm"][-1]
    printed = [
        Printed(
            "flat domain buckles, τ L/β",
            f"8 as a spherical cap (1992); {text(stability_limit(), 6)} as a plate in a flat membrane, exact",
            {"": text(instability(branches), 5)},
        ),
        Printed(
            "neck closes, τ L/β",
            "4: half of τ/β is the sum of both sides’ mean curvatures, 2/L and 0 (1993, 1996); equal energies of flat and closed "
            "(1992)",
            {"": f"{text(limit, 3)} ± {text(uncertainty, 1)} for a neck of 0 nm, from {at_necks}"},
        ),
        Printed(
            "bending energy of the closed bud",
            f"8πβ = {text(sphere, 6)} pN nm",
            {"": f"{text(energy, 6)} pN nm with a neck of {text(branch.columns['neck_radius_nm'][-1], 2)} nm"},
        ),
        Printed(
            "open buds, stable, τ L/β",
            "",
            {"": f"from the second fold, {text(float(line_tension(branch.folds[1])), 5)}, on, until the neck closes"},
        ),
    ]
    remarks = [
        f"β = {STIFFNESS:g} pN nm in domain and membrane, a domain of {PATCH:g} nm in a rim of {RIM:g} nm without tension, an edge of "
        f"ε_c = {WIDTH:g} nm whose molecules are in equilibrium; τ = σ̂ √2/6. L = {text(domain_radius(), 5)} nm is the flat domain’s radius.",
        "Spherical caps have a kink at the edge and a flat membrane around, so that they buckle late. The smooth membrane buckles "
        "where the plate does, in the limit of a thin edge.",
        f"C = {2 * FAINT[0]:g}/nm says to which side the domain buds; the instability is extrapolated to C = 0 from that branch and "
        f"from one of {2 * FAINT[1]:g}/nm.",
    ]
    return Result(rows, {"juelicher1996": (TITLE, draw(branch))}, printed, remarks)


def none_if_nan(value):
    """A number for a table."""
    return float(value) if math.isfinite(value) else ""
