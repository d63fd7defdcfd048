"""Akamatsu et al. (2020): how far a force of actin on the coat pulls it in, at five tensions."""

import math

import numpy as np

from comparisons.drawing.style import plt
from comparisons.paper.figures import COLOURS
from comparisons.paper.item import Printed, Result, followed, text

TITLE = "Internalisation by actin that pulls at the coat (Akamatsu et al. 2020)"
SOURCE = "M. Akamatsu, R. Vasan, D. Serwas, M. A. Ferrin, P. Rangamani, D. G. Drubin, eLife 9, e49840 (2020)"

#: Tensions (pN/nm), with --quick, and the force (pN) that branches are followed to.
TENSIONS, QUICK_TENSIONS, END = (0.01, 0.03, 0.1, 0.3, 1.0), (0.01, 1.0), 400

#: Height (nm) of the coat over the ring at which a pit counts as pulled in.
INTERNALISED = 100

#: β of bare and coated membrane, pN nm, as cases/actin.toml has it.
BETA = 160

#: What the paper finds needed, at low and at high tension.
PUBLISHED = {0.01: "some 10 to 20 pN", 1.0: "over 100 pN"}


def wanted(quick):
    """No runs: branches are made with the item."""
    return []


def tube_force(tension):
    """The force (pN) that a long tube of the membrane takes, 2π √(2βσ)."""
    return 2 * math.pi * math.sqrt(2 * BETA * tension)


def rows_of(tension, branch):
    """A row for each shape of a branch."""
    names = ("coat_force_pN", "coat_extension_nm", "bud_height_nm", "neck_radius_nm")
    return [
        {
            "tension_pN_per_nm": tension,
            **{name: float(value) if math.isfinite(value) else "" for name, value in zip(names, values)},
        }
        for values in zip(*(branch.columns[name] for name in names))
    ]


def force_to(branch, height):
    """The largest force (pN) on the branch's way to a height (nm) of the coat over the ring; None where it does not get there."""
    force, extension = branch.columns["coat_force_pN"], branch.columns["coat_extension_nm"]
    beyond = np.flatnonzero(extension >= height)
    if len(beyond) == 0:
        return None
    after = int(beyond[0])
    if after == 0:
        return 0.0
    there = np.interp(height, extension[after - 1 : after + 1], force[after - 1 : after + 1])
    return float(max(force[:after].max(), there))


def words_of(tension, branch):
    """The force that internalisation takes, folds on the way, and where the branch ends."""
    words = f"{text(force_to(branch, INTERNALISED))} pN to {INTERNALISED} nm"
    if branch.folds:
        words += f", first fold at {text(branch.folds[0])} pN"
    return f"{words}; {branch.ended} at {text(float(branch.columns['coat_extension_nm'][-1]), 3)} nm; a tube takes {text(tube_force(tension))} pN"


def draw(branches):
    """The force against how far the coat is above the ring."""
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    for (tension, branch), colour in zip(branches.items(), COLOURS):
        axes.plot(branch.columns["coat_extension_nm"], branch.columns["coat_force_pN"], color=colour, label=f"{tension:g} pN/nm")
        axes.axhline(tube_force(tension), color=colour, linewidth=0.8, linestyle=":")
    axes.set(xlabel="coat's height over the ring (nm)", ylabel="force on the coat (pN)")
    axes.legend(title="tension")
    return figure


def result(runs, quick):
    """See item.Result."""
    tensions = QUICK_TENSIONS if quick else TENSIONS
    branches = {
        tension: followed(
            "actin", "membrane.coat_force", END, {"membrane.coat_force": "0.1", "membrane.rim_tension": f"{tension:g}"}
        )
        for tension in tensions
    }
    printed = [
        Printed(f"force to internalise at {tension:g} pN/nm", PUBLISHED.get(tension, "–"), {"": words_of(tension, branch)})
        for tension, branch in branches.items()
    ]
    remarks = [
        "The coat, 60 nm in radius when flat, is that of Hassinger et al. (2017), β = 160 pN nm and C = 0.04/nm, on a membrane of the "
        "same stiffness; it is pulled in proportion to c, and a ring between 80 and 120 nm of material radius bears the force. "
        "Theirs has other radii and a stiffer coat; the numbers are orders of magnitude.",
        "Dotted: the force that a long tube of bare membrane takes, 2π √(2βσ).",
    ]
    rows = [row for tension, branch in branches.items() for row in rows_of(tension, branch)]
    return Result(rows, {"akamatsu2020": (TITLE, draw(branches))}, printed, remarks)
