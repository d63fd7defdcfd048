"""Fig. 6: diameter and neck radius at 20 µs against the patch radius."""

import numpy as np
from scipy.stats import linregress

from comparisons import PHASE_FIELD
from comparisons.drawing import style
from comparisons.drawing.style import plt
from comparisons.paper import patch_sweep
from comparisons.paper.item import Printed, Result, Wanted, end_of, final_value, is_run, quick_remark, text
from comparisons.paper.patch_sweep import EARLY, STATIONARY, of_engine
from comparisons.studies.members import NECK_CLOSED
from comparisons.studies.sweep_table import engines_of

TITLE = "Fig. 6: vesicle diameter and neck radius by patch radius"

#: What the text prints: diameter (nm) of the fastest budding patch of 36 nm, and the radius of the smallest neck.
PAPER_DIAMETER, PAPER_RADIUS, PAPER_NECK_MINIMUM = 42.0, 36, 40

#: Radii (nm) whose late necks are also computed with a thinner layer (nm): a stationary neck would not depend on it.
THIN_RADII, THIN = (36, 48), 0.85


def wanted(quick):
    """The patch sweep, and unless `quick` two of its radii with a thinner layer."""
    thin = [
        Wanted(thin_name(r), PHASE_FIELD, "standard", {"phase_field.epsilon": f"{THIN:g}"} | of_radius(r), STATIONARY)
        for r in THIN_RADII
    ]
    return patch_sweep.wanted(quick) + ([] if quick else thin)


def of_radius(radius):
    """The setting of a patch radius (nm)."""
    return {} if radius == PAPER_RADIUS else {"molecules.patch_radius": str(radius)}


def thin_name(radius):
    """Name of the run with the thinner layer."""
    return f"{patch_sweep.name_of(radius)}, ε={THIN:g}"


def late_necks(runs):
    """item.Printed of the last neck by both layers, for every radius that has the thinner one."""
    found = []
    for radius in THIN_RADII:
        both = [runs.get(name, {}).get(PHASE_FIELD) for name in (patch_sweep.name_of(radius), thin_name(radius))]
        if all(is_run(run) for run in both):
            words = " / ".join(f"{text(final_value(run, 'neck_radius_nm'), 3)} at {end_of(run):g} µs" for run in both)
            what = f"last neck radius at r_c = {radius} nm with layers of 1.2 / {THIN:g} nm, nm"
            found.append(Printed(what, "stationary", {PHASE_FIELD: words}))
    return found


def line_fit(x, y):
    """(slope, intercept, R²) of the straight line through y(x); None for fewer than three points or a constant."""
    if len(x) < 3 or np.ptp(y) == 0:
        return None
    line = linregress(x, y)
    return line.slope, line.intercept, line.rvalue**2


def draw(rows):
    """Diameter and neck radius against the patch radius."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.4, 3.9), layout="constrained")
    for engine in engines_of(rows):
        look = {"color": style.ENGINE_COLOURS[engine][0], "label": style.ENGINE_NAMES[engine], **style.LOOKS[engine]}
        x, y = of_engine(rows, engine, "bud_diameter_nm")
        left.plot(x, y, **look)
        x, y = of_engine(rows, engine, "neck_radius_nm")
        right.plot(x, y, **{**look, "label": f"{look['label']}, {STATIONARY:g} µs or end"})
        x, y = of_engine(rows, engine, "neck_radius_at_1_us_nm")
        right.plot(x, y, **{**look, "label": f"{look['label']}, {EARLY:g} µs", "alpha": 0.45})
    left.plot(PAPER_RADIUS, PAPER_DIAMETER, "*", color="#333333", markersize=13, label="paper's text", zorder=5)
    right.axvline(PAPER_NECK_MINIMUM, color="#333333", linewidth=1, linestyle=":", label="paper: smallest neck")
    left.set(xlabel="patch radius (nm)", ylabel="lateral diameter (nm)", ylim=(0, None))
    right.set(xlabel="patch radius (nm)", ylabel="neck radius (nm)", ylim=(0, None))
    left.set_title("Vesicle diameter")
    right.set_title("Neck radius")
    left.legend()
    right.legend()
    return figure


def neck_minimum(rows, engine, column):
    """The smallest neck in words; at the end several may have closed."""
    closed = [row["patch_radius_nm"] for row in rows if row["engine"] == engine and row["state"] == NECK_CLOSED]
    if closed and column == "neck_radius_nm":
        return ", ".join(f"{radius:g}" for radius in closed) + " (closed)"
    found = patch_sweep.best(*of_engine(rows, engine, column))
    return "–" if found is None else f"{found[0]:.3g} (neck {found[1]:.3g} nm)"


def result(runs, quick):
    """See item.Result."""
    rows = patch_sweep.table(runs)
    engines = engines_of(rows)
    fits = {engine: line_fit(*of_engine(rows, engine, "bud_diameter_nm")) for engine in engines}
    at_36 = {r["engine"]: r["bud_diameter_nm"] for r in rows if r["patch_radius_nm"] == PAPER_RADIUS}
    linear = {e: "–" if f is None else f"{f[0]:.3g} r_c + {f[1]:.3g} nm, R² = {f[2]:.4f}" for e, f in fits.items()}
    printed = [
        Printed(
            "diameter at r_c = 36 nm, nm",
            "≈ 42 (the vesicle that buds fastest)",
            {e: text(v, 4) for e, v in at_36.items()},
        ),
        Printed("diameter against r_c", "a linear function", linear),
        *(
            Printed(
                f"patch radius of the smallest neck {when}, nm",
                "40",
                {e: neck_minimum(rows, e, column) for e in engines},
            )
            for when, column in ((f"at {EARLY:g} µs", "neck_radius_at_1_us_nm"), ("at the end", "neck_radius_nm"))
        ),
        *late_necks(runs),
    ]
    remarks = [
        f"The neck radii at {STATIONARY:g} µs are not stationary: see Fig. 5. A sharp neck keeps draining, so its value and the "
        f"radius that has the smallest one are a matter of the time chosen: soon after budding, at {EARLY:g} µs, it is the "
        "paper's radius; later the necks of smaller patches get ahead. The paper's necks stop at a width comparable to its "
        "diffuse layer; that this keeps the early order is a guess.",
        "The paper prints no numbers for the curves of Fig. 6; only those of its text are compared.",
        *quick_remark(quick),
    ]
    title = f"At {STATIONARY:g} µs, or at the run's end if that is earlier"
    return Result(rows, {"fig6": (title, draw(rows))}, printed, remarks)
