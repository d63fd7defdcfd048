"""Hassinger, Oster, Drubin & Rangamani (2017): a growing coat under three tensions, and its snap-through."""

import math

import numpy as np

from comparisons.drawing.style import plt
from comparisons.paper.figures import COLOURS
from comparisons.paper.item import Printed, Result, followed, no_runs, text

TITLE = "Snap-through of a growing coat (Hassinger et al. 2017)"
SOURCE = "J. E. Hassinger, G. Oster, D. G. Drubin, P. Rangamani, Proc. Natl. Acad. Sci. 114, E1118 (2017)"

#: Tensions (pN/nm), the coat's radius (nm) a branch is followed to, and what the paper says of it.
TENSIONS = {
    0.002: (110, "from flat to bud smoothly"),
    0.02: (85, "snaps from an open to a closed bud: an S-shaped branch, two folds"),
    0.2: (150, "remains essentially flat"),
}


#: The edge of their code's coat, (1 − tanh γ(α − α₀))/2 in the area A = 2π R₀² α with R₀ = 20 nm and γ = 20, is that of
#: ε_c = R₀²/(√2 γ r_c) here; r_c where the coat snaps.
THEIR_EDGE = 20.0**2 / (math.sqrt(2) * 20 * 80)

wanted = no_runs


def coat_area(radius):
    """Area (nm²) of the coat of a flat patch's radius (nm)."""
    return math.pi * np.asarray(radius) ** 2


def draw(branches):
    """The bud's height along the branches against the coat's area."""
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    for (tension, branch), colour in zip(branches.items(), COLOURS):
        area = coat_area(branch.columns["patch_radius_nm"]) / 1000
        axes.plot(area, branch.columns["bud_height_nm"], color=colour, label=f"{tension:g} pN/nm")
    axes.set(xlabel="coat's area (1000 nm²)", ylabel="height (nm)")
    axes.legend(title="tension")
    return figure


def result(runs, quick):
    """See item.Result."""
    branches = {
        tension: followed("snap-through", "molecules.patch_radius", end, {"membrane.rim_tension": f"{tension:g}"})
        for tension, (end, _) in TENSIONS.items()
    }
    rows, printed = [], []
    for tension, branch in branches.items():
        folds = ", ".join(text(float(coat_area(fold)), 6) for fold in branch.folds)
        heights = branch.columns["bud_height_nm"]
        words = f"folds at {folds} nm² of coat" if branch.folds else "no fold"
        last = float(coat_area(branch.columns["patch_radius_nm"][-1]))
        words += f"; {text(heights[-1])} nm high at {text(last)} nm², where {branch.ended}"
        printed.append(Printed(f"coat that grows under {tension:g} pN/nm", TENSIONS[tension][1], {"": words}))
        names = ("patch_radius_nm", "bud_height_nm", "neck_radius_nm")
        for radius, height, neck in zip(*(branch.columns[name] for name in names)):
            rows.append(
                {
                    "tension_pN_per_nm": tension,
                    "coat_area_nm2": float(coat_area(radius)),
                    "bud_height_nm": float(height),
                    "neck_radius_nm": float(neck) if math.isfinite(neck) else "",
                }
            )
    with_their_edge = followed(
        "snap-through",
        "molecules.patch_radius",
        TENSIONS[0.02][0],
        {"molecules.patch_radius": "60", "molecules.interface_width": f"{THEIR_EDGE:.4g}"},
    )
    folds = ", ".join(text(float(coat_area(fold)), 6) for fold in with_their_edge.folds)
    words = "code’s coat: tanh of 20 (A − A₀)/(2π (20 nm)²)"
    printed.append(Printed("the same under 0.02 pN/nm with their coat’s edge", words, {"": f"folds at {folds} nm² of coat"}))
    remarks = [
        "Their energy is 320 pN nm (H − C₀)² with the mean curvature H, here β = 160 pN nm and C = 2C₀ = 0.04/nm, in coat and bare "
        "membrane alike; box of 400 nm. What the paper says is taken from its text; its curves are not printed as numbers.",
        "Their coat has a tanh profile in area, 20 being the sharpness that their code’s translation by A. Mahdavian "
        "(github.com/mahdavian74/MembraneMechanics_Hassinger_PNAS_2017) runs with; the edge of the branches drawn here is 1.2 nm wide.",
    ]
    return Result(rows, {"hassinger2017": (TITLE, draw(branches))}, printed, remarks)
