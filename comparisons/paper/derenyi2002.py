"""Derényi, Jülicher & Prost (2002): the force on a membrane tube against its length."""

import math

from comparisons.drawing.style import plt
from comparisons.paper.figures import COLOURS
from comparisons.paper.item import Printed, Result, followed, no_runs, text

TITLE = "A tube pulled from a membrane (Derényi, Jülicher & Prost 2002)"
SOURCE = "I. Derényi, F. Jülicher, J. Prost, Phys. Rev. Lett. 88, 238101 (2002)"

#: Of cases/tube.toml: energy ½βκ² per area, in pN nm, and tension, in pN/nm.
STIFFNESS, TENSION = 100.0, 0.1

#: Radii (nm) of the membrane's rim, and the box's height.
RADII, HEIGHT = (80, 200), 700

wanted = no_runs


def plateau_force():
    """2π√(2βσ), pN."""
    return 2 * math.pi * math.sqrt(2 * STIFFNESS * TENSION)


def tube_radius():
    """√(β/(2σ)), nm."""
    return math.sqrt(STIFFNESS / (2 * TENSION))


def measured_radius(columns):
    """Radius (nm) of the tube that a branch's last step adds."""
    area, height = columns["membrane_area_nm2"], columns["bud_height_nm"]
    return float((area[-1] - area[-2]) / (2 * math.pi * (height[-1] - height[-2])))


def draw(branches):
    """Force over its plateau against the length over the tube's radius."""
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    for (radius, branch), colour in zip(branches.items(), COLOURS):
        length = branch.columns["bud_height_nm"] / tube_radius()
        axes.plot(length, branch.columns["pole_force_pN"] / plateau_force(), color=colour, label=f"R = {radius} nm")
    axes.axhline(1, color="0.6", linewidth=0.8)
    axes.set(xlabel="length / √(β/(2σ))", ylabel="force / (2π√(2βσ))")
    axes.legend()
    return figure


def result(runs, quick):
    """See item.Result."""
    branches = {
        radius: followed(
            "tube", "membrane.pole_force", 100, {"domain.radius": str(radius), "domain.height": str(HEIGHT)}
        )
        for radius in RADII
    }
    rows, printed = [], []
    for radius, branch in branches.items():
        force, height = branch.columns["pole_force_pN"], branch.columns["bud_height_nm"]
        rows += [
            {"rim_radius_nm": radius, "length_nm": float(h), "force_pN": float(f)} for h, f in zip(height, force)
        ]
        long_tube = f"tube of {height[-1]:.0f} nm, rim of {radius} nm"
        theirs = f"2π√(2βσ) = {text(plateau_force(), 9)} pN", f"√(β/(2σ)) = {text(tube_radius(), 6)} nm", "13 % above"
        printed += [
            Printed(f"force, {long_tube}", theirs[0], {"": f"{text(force[-1], 9)} pN"}),
            Printed(f"radius, {long_tube}", theirs[1], {"": f"{text(measured_radius(branch.columns), 6)} nm"}),
            Printed(f"largest force, rim of {radius} nm", theirs[2], {"": f"{100 * (max(force) / plateau_force() - 1):.1f} % above"}),
        ]
    remarks = [
        "β = 100 pN nm, σ = 0.1 pN/nm; the force acts on a spot of 5 nm, not on a point.",
        "The overshoot depends on the membrane's size: that of the paper is a wide membrane's. The force approaches its plateau in a "
        "damped oscillation, through folds.",
    ]
    return Result(rows, {"derenyi2002": (TITLE, draw(branches))}, printed, remarks)
