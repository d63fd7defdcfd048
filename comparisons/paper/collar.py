"""What is left to do for the collar of a neck: energy and force of coats whose neck is held, from open to 3 nm."""

import itertools

from scipy.constants import Boltzmann

from comparisons.drawing.style import plt
from comparisons.errors import StudyError
from comparisons.paper.figures import COLOURS
from comparisons.paper.item import Printed, Result, held, no_runs, text

TITLE = "What the collar of a neck has to do"
SOURCE = "no paper's figure: branches of `endoflow statics --hold`"

#: Radii (nm) of the coats, tensions (pN/nm), and the neck's radius (nm) at the end; with --quick.
RADII, TENSIONS, END = (20, 30, 40, 50, 60), (0.002, 0.02, 0.2), 3
QUICK_RADII, QUICK_TENSIONS = (22, 36), (0.02,)

#: The energy is the potential of the force where molecules stay in the material.
MOLECULES = {"molecules.transport": "advection"}

#: Temperature (K) of a cell, and k_B T there in pN nm, to three digits.
TEMPERATURE = 310
THERMAL = round(1e21 * Boltzmann * TEMPERATURE, 2)

wanted = no_runs


def branch_of(radius, tension):
    """The Branch of a coat, or why there is none."""
    settings = {
        "molecules.patch_radius": f"{radius:g}",
        "membrane.rim_tension": f"{tension:g}",
        "molecules.thermal_energy": f"{THERMAL:g}",
        **MOLECULES,
    }
    try:
        return held("standard", "open", END, settings)
    except StudyError as error:
        return str(error)


def words_of(branch):
    """What a branch says, or why there is none."""
    if isinstance(branch, str):
        return branch
    radius, work = branch.columns["followed_value"], branch.work
    narrowest = min(radius)  # beyond a fold a branch goes back to wider necks
    reached = f"{text(radius[0])} to {text(narrowest)} nm" + ("" if narrowest == END else f", {branch.ended}")
    height, push = work["barrier_kT"], work["strongest_constriction_pN"]
    if height == 0:
        return f"{reached}: none, the neck closes by itself and pulls with {text(-push, 3)} pN or more"
    where = f"{text(work['barrier_from_nm'])} to {text(work['barrier_to_nm'])} nm"
    return f"{reached}: {text(height, 5)} k_BT from {where}, {text(push)} pN at most"


def rows_of(radius, tension, branch):
    """A row for each shape of a branch."""
    columns = branch.columns
    return [
        {
            "patch_radius_nm": radius,
            "tension_pN_per_nm": tension,
            "neck_radius_nm": float(neck),
            "force_pN": float(force),
            "work_kT": float(work) / THERMAL,
            "potential_kT": float(potential) / THERMAL,
        }
        for neck, force, work, potential in zip(
            columns["followed_value"], columns["neck_force_pN"], columns["neck_work_pN_nm"], columns["potential_pN_nm"]
        )
    ]


def draw(branches):
    """Work and force against the neck's radius; a column for each tension, a colour for each coat."""
    tensions = list(dict.fromkeys(tension for _, tension in branches))
    radii = list(dict.fromkeys(radius for radius, _ in branches))
    figure, grid = plt.subplots(
        2, len(tensions), figsize=(3.6 * len(tensions) + 0.8, 5.6), sharex=True, sharey="row", squeeze=False, layout="constrained"
    )
    for (radius, tension), branch in branches.items():
        if isinstance(branch, str):
            continue
        column, colour = tensions.index(tension), COLOURS[radii.index(radius)]
        necks = branch.columns["followed_value"]
        grid[0, column].plot(necks, branch.columns["neck_work_pN_nm"] / THERMAL, color=colour, label=f"{radius:g} nm")
        grid[1, column].plot(necks, branch.columns["neck_force_pN"], color=colour)
    for column, tension in enumerate(tensions):
        grid[0, column].set_title(f"{tension:g} pN/nm")
        grid[1, column].set_xlabel("neck radius (nm)")
        grid[1, column].axhline(0, color="0.6", linewidth=0.8)
        grid[0, column].set_yscale("asinh", linear_width=30)
        grid[1, column].set_yscale("asinh", linear_width=30)
    grid[0, 0].set_ylabel("work from the open neck (k_BT)")
    grid[1, 0].set_ylabel("force that holds it, > 0 outwards (pN)")
    grid[0, 0].legend(title="coat's radius")
    return figure


def result(runs, quick):
    """See item.Result."""
    pairs = itertools.product(QUICK_RADII if quick else RADII, QUICK_TENSIONS if quick else TENSIONS)
    branches = {(radius, tension): branch_of(radius, tension) for radius, tension in pairs}
    rows = [row for pair, branch in branches.items() if not isinstance(branch, str) for row in rows_of(*pair, branch)]
    if not rows:
        raise StudyError(next(iter(branches.values())), 3)
    printed = [
        Printed(f"barrier of a coat of {radius:g} nm at {tension:g} pN/nm", "–", {"": words_of(branch)})
        for (radius, tension), branch in branches.items()
    ]
    remarks = [
        "A barrier is the highest rise of the work ∫ f dR on the way from the widest neck there is to "
        f"{END} nm, in units of {THERMAL:g} pN nm ({TEMPERATURE} K). The molecules stay in the material, so that the work is the change of the energy.",
        "Scission changes the energy by 4π κ_G more (membrane.gaussian_stiffness), which no shape on the way knows.",
        "Where a branch has folds, a collar that sets the radius jumps from one shape to another and pays what lies between them.",
        "A branch ends early where the bud touches the membrane around its neck (membrane-crosses-itself), or where another "
        "place becomes narrower (second-neck).",
    ]
    return Result(rows, {"collar": (TITLE, draw(branches))}, printed, remarks)
