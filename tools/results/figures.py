"""The documentation's figures: a function each, from tables of docs/results/data to docs/images/*.svg."""

import numpy as np

from results import ink, tables
from results.portraits import PORTRAITS
from results.schematics import SCHEMATICS
from results.tables import columns
from results.writing import written


def log_axis(axes, which, ticks):
    """A logarithmic axis with plain numbers as ticks."""
    getattr(axes, f"set_{which}scale")("log")
    getattr(axes, f"set_{which}ticks")(ticks, [f"{tick:g}" for tick in ticks], minor=False)
    getattr(axes, f"{which}axis").set_minor_formatter("")


def slope(axes, x, y, order):
    """A guide of an order through a point (x[-1], y)."""
    axes.plot(x, y * (x / x[-1]) ** order, color=ink.FAINT[0], linewidth=1, linestyle=":")
    axes.annotate(f"ε{'²' if order == 2 else ''}", (x[0], y * (x[0] / x[-1]) ** order), xytext=(3, 2), textcoords="offset points", color=ink.FAINT[0])


def necks():
    """Neck of both engines in the standard case, and their difference."""
    time, diffuse, sharp, off = columns("standard-differences", "time_us", "neck_nm", "neck_sharp_nm", "neck")
    figure, (above, below) = ink.panels(2, 1, (6.4, 4.2), sharex=True, gridspec_kw={"height_ratios": (2, 1)})
    above.plot(time, sharp, label="boundary integral", **ink.SHARP_LINE)
    above.plot(time, diffuse, label="phase field", **ink.DIFFUSE_LINE)
    above.axhline(5, color=ink.FAINT[0], linewidth=1, linestyle=":")
    above.annotate("budding", (20, 5), xytext=(0, 3), textcoords="offset points", ha="right")
    log_axis(above, "y", (1, 2, 5, 10, 20))
    above.set_ylabel("neck radius (nm)")
    above.legend()
    below.plot(time, 100 * off, **ink.DIFFUSE_LINE)
    below.axhline(0, color=ink.FAINT[0], linewidth=1)
    below.set_ylabel("difference (%)")
    log_axis(below, "x", (0.2, 0.5, 1, 2, 5, 10, 20))
    below.set_xlabel("time (µs)")
    return figure


def thin_layers():
    """Errors of uniform layers against their thickness."""
    epsilon, *errors = columns("thin-layers", "epsilon_nm", "late", "neck_0.8", "neck_0.4", "energy_0.5")
    figure, axes = ink.panels()
    looks = (("budding time", ink.DIFFUSE_LINE), ("neck at 0.8 µs", {"color": ink.SHARP[0], "marker": "o"}))
    looks += (("neck at 0.4 µs", {"color": ink.SHARP[0], "marker": "^", "linestyle": "--"}), ("energy at 0.5 µs", {"color": ink.THIRD[0], "marker": "D"}))
    for error, (label, look) in zip(errors, looks):
        axes.plot(epsilon, 100 * np.abs(error), label=label, **look)
    slope(axes, epsilon, 0.05, 2)
    log_axis(axes, "x", (0.42, 0.6, 0.85, 1.2))
    log_axis(axes, "y", (0.1, 0.2, 0.5, 1, 2, 5))
    axes.set_xlabel("ε (nm)")
    axes.set_ylabel("difference from the sharp engine (%)")
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    return figure


def smooth_case():
    """Errors of the smooth case against the layer's thickness."""
    figure, grid = ink.panels(1, 3, (7.6, 3.1), sharex=True)
    shown = (("mean_distance_nm", "mean distance (nm)"), ("neck_radius_error_nm", "neck radius (nm)"), ("bending_energy_error_pN_nm", "energy (pN nm)"))
    for axes, (column, title) in zip(grid, shown):
        for time, look in ((0.25, {"color": ink.THIRD[0], "marker": "D"}), (0.5, ink.SHARP_LINE), (1.0, ink.DIFFUSE_LINE)):
            epsilon, error = columns("smooth-case", "epsilon_nm", column, time_us=time)
            if np.isfinite(error).sum() > 1:
                axes.plot(epsilon, np.abs(error), label=f"{time:g} µs", **look)
        axes.set_yscale("log")
        log_axis(axes, "x", (0.6, 0.85, 1.2, 1.7, 2.4))
        axes.set_title(title)
        axes.set_xlabel("ε (nm)")
    epsilon, error = columns("smooth-case", "epsilon_nm", "bending_energy_error_pN_nm", time_us=0.25)
    slope(grid[2], epsilon, 1.5 * error[-1], 2)
    grid[0].legend()
    return figure


#: What the relatives of the standard case are called beside the axis.
SHORT = {
    "membrane.constitutive_law=coarse-grained": "coarse-grained law", "membrane.constitutive_law=lumped": "lumped law",
    "domain.radius=120": "box 1.5 times as large",
}  # fmt: skip


def relatives():
    """How late the diffuse engine buds in relatives of the standard case, and its largest difference of volume, energy, neck."""
    rows = tables.read("relatives").rows
    figure, (left, right) = ink.panels(1, 2, (7.6, 4.4), sharey=True)
    names = [SHORT.get(row["change"], row["change"].split(".", 1)[1].replace("=", " = ").replace("_", " ")) for row in rows]
    places = np.arange(len(rows))[::-1]
    late = [np.nan if row["late"] is None else 100 * row["late"] for row in rows]
    left.plot(late, places, linestyle="", marker="s", color=ink.DIFFUSE[0])
    left.axvline(0, color=ink.FAINT[0], linewidth=1)
    left.set_yticks(places, names)
    left.set_title("budding late by (%)")
    for column, marker, colour in (("volume", "o", ink.SHARP), ("energy", "D", ink.THIRD), ("neck", "s", ink.DIFFUSE)):
        values = [np.nan if row[column] is None else 100 * row[column] for row in rows]
        right.plot(values, places, linestyle="", marker=marker, markersize=4.5, color=colour[0], label=column)
    right.set_title("largest difference (%)")
    right.legend()
    return figure


def refinement():
    """Error of the sharp engine's budding time against its elements, and against the tolerance."""
    rows = tables.read("refinement").rows
    best = next(row for row in rows if row["elements"] == 140)["budding_us"]
    figure, (left, right) = ink.panels(1, 2, (6.8, 2.9), sharey=True)
    space = [row for row in rows if row["tolerance"] == 1e-6 and row["points"] == 8]
    left.plot([row["elements"] for row in space], [abs(row["budding_us"] / best - 1) for row in space], **ink.SHARP_LINE)
    log_axis(left, "x", (40, 60, 80, 110))
    left.set_yscale("log")
    left.set_xlabel("elements, tolerance 10⁻⁶")
    left.set_ylabel("error of the budding time")
    finest = next(row["budding_us"] for row in rows if row["elements"] == 80 and row["tolerance"] == 1e-8)
    steps = [row for row in rows if row["elements"] == 80 and row["points"] == 8 and row["tolerance"] > 1e-8]
    right.plot([row["tolerance"] for row in steps], [abs(row["budding_us"] / finest - 1) for row in steps], **ink.SHARP_LINE)
    right.set_xscale("log")
    right.set_xlabel("tolerance, 80 elements, against 10⁻⁸")
    return figure


def radii():
    """Budding time, diameter and neck against the coat's radius."""
    radius, budding, neck, diameter, end = columns("twelve-radii", "radius_nm", "budding_us", "neck_nm", "diameter_nm", "end_us")
    figure, grid = ink.panels(1, 3, (7.6, 3))
    for axes, values, title in zip(grid, (budding, diameter, neck), ("budding time (µs)", "diameter at 20 µs (nm)", "neck then (nm)")):
        axes.plot(radius, values, **ink.SHARP_LINE)
        axes.set_title(title)
        axes.set_xlabel("coat's radius (nm)")
        axes.set_xticks((20, 30, 40, 50, 60))
    log_axis(grid[2], "y", (0.5, 1, 2, 5, 10))
    return figure


def vesicle():
    """Differences of both engines while a prolate vesicle relaxes."""
    time, energy, *off = columns("vesicle", "time_us", "energy_sharp_pN_nm", "energy", "height", "volume")
    figure, (left, right) = ink.panels(1, 2, (6.8, 2.9), sharex=True)
    left.plot(time, energy, **ink.SHARP_LINE)
    left.set_title("energy, sharp (pN nm)")
    for values, label, look in zip(off, ("energy", "height", "volume"), (ink.DIFFUSE_LINE, {"color": ink.SHARP[0], "marker": "o"}, {"color": ink.THIRD[0], "marker": "D"})):
        right.plot(time, 100 * values, label=label, **look)
    right.axhline(0, color=ink.FAINT[0], linewidth=1)
    right.set_title("difference (%)")
    right.legend()
    for axes in (left, right):
        log_axis(axes, "x", (0.01, 0.1, 1, 5))
        axes.set_xlabel("time (µs)")
    return figure


def mode_gains():
    """What a coat's edge that is out of round becomes, against the coat's radius."""
    radius, most, second, third, gain = columns("modes-of-radii", "radius_nm", "most_m2_nm", "end_m2_nm", "end_m3_nm", "gain_m2")
    figure, axes = ink.panels(size=(6.4, 3.2))
    axes.plot(radius, most / 0.1, label="m = 2, largest on the way", color=ink.DIFFUSE[0], marker="^", linestyle=":")
    axes.plot(radius, second / 0.1, label="m = 2, at budding", color=ink.DIFFUSE[0], marker="s")
    axes.plot(radius, third / 0.1, label="m = 3, at budding", color=ink.SHARP[0], marker="o", linestyle="--")
    axes.plot(radius, gain, label="m = 2, largest of all, at budding", color=ink.THIRD[0], marker="D", linestyle="-.")
    axes.axhline(1, color=ink.FAINT[0], linewidth=1)
    axes.set_yscale("log")
    axes.set_xlabel("coat's radius (nm)")
    axes.set_ylabel("displacement over that of the start")
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    return figure


def noise():
    """Neck and height of the standard case with their standard deviations at 310 K."""
    names = ("time_us", "neck_radius_nm", "neck_rms_nm", "height_nm", "height_rms_nm", "ellipticity_rms", "neck_ellipticity_rms")
    time, neck, neck_rms, height, height_rms, bud, bud_neck = columns("noise", *names)
    figure, grid = ink.panels(1, 3, (7.6, 2.9), sharex=True)
    for axes, mean, rms, title in ((grid[0], neck, neck_rms, "neck radius (nm)"), (grid[1], height, height_rms, "height (nm)")):
        axes.fill_between(time, mean - rms, mean + rms, color=ink.TINT[0])
        axes.plot(time, mean, **ink.SHARP_LINE)
        axes.set_title(title)
    grid[2].plot(time, 100 * bud, label="bud", **ink.SHARP_LINE)
    grid[2].plot(time, 100 * bud_neck, label="neck", **ink.DIFFUSE_LINE)
    grid[2].set_title("ellipticity (%)")
    grid[2].legend()
    for axes in grid:
        axes.set_xlabel("time (µs)")
    return figure


def energy():
    """Energy of the standard case and the power that the fluid takes."""
    time, bending, power = columns("standard-energy", "time_us", "energy_pN_nm", "dissipation_pN_nm_per_us")
    figure, (left, right) = ink.panels(1, 2, (6.8, 2.9), sharex=True)
    left.plot(time, bending / 1e3, **ink.SHARP_LINE)
    left.set_title("bending energy (10³ pN nm)")
    right.plot(time, power, **ink.SHARP_LINE)
    right.set_yscale("log")
    right.set_title("dissipation (pN nm/µs)")
    for axes in (left, right):
        log_axis(axes, "x", (0.001, 0.01, 0.1, 1, 10))
        axes.set_xlabel("time (µs)")
    return figure


def folds():
    """A coat that snaps through, and the force of a tube that is pulled."""
    radius, height = columns("snap-through-branch", "radius_nm", "height_nm")
    length, force = columns("tube-branch", "length_nm", "force_pN")
    figure, (left, right) = ink.panels(1, 2, (6.8, 2.9))
    left.plot(radius, height, color=ink.SHARP[0])
    for value in list(tables.read("snap-through").rows[-1].values())[1:]:
        nearest = np.argmin(np.abs(radius - value))
        left.plot(radius[nearest], height[nearest], marker="o", color=ink.DIFFUSE[0])
    left.set_xlabel("coat's radius (nm)")
    left.set_title("height (nm)")
    right.plot(length, force, color=ink.SHARP[0])
    right.axhline(tables.read("tube").rows[0]["plateau_pN"], color=ink.FAINT[0], linewidth=1, linestyle=":")
    right.set_xlabel("length of the tube (nm)")
    right.set_title("force (pN)")
    return figure


def attribution():
    """Area at 0.5 µs from the printed numerics to the sharp membrane, one change at a time."""
    rows = [row for row in tables.read("paper-attribution").rows if row["area_nm2"] is not None]
    figure, axes = ink.panels(size=(7.2, 3.2))
    places = np.arange(len(rows))[::-1]
    areas = [row["area_nm2"] for row in rows]
    axes.barh(places, np.array(areas) - 22000, left=22000, color=ink.TINT[0], edgecolor=ink.SHARP[0])
    for place, row in zip(places, rows):
        text = "" if row["change_nm2"] is None else written(row["change_nm2"], "+.0f")
        axes.annotate(text, (row["area_nm2"], place), xytext=(4, 0), textcoords="offset points", va="center")
    axes.set_yticks(places, [row["change"].split(";")[0].split(":")[0].replace(" instead of quadratic ones of 0.88", "") for row in rows])
    axes.set_xlim(22000, 25200)
    axes.set_xticks((22000, 23000, 24000, 25000))
    axes.set_xlabel("membrane area at 0.5 µs (nm²)")
    axes.grid(visible=False, axis="y")
    return figure


def mobility():
    """Area at 0.5 µs against γ."""
    gamma, area = columns("paper-mobility", "mobility_nm2_per_pN_us", "area_nm2")
    figure, axes = ink.panels()
    axes.plot(gamma, area, **ink.DIFFUSE_LINE)
    axes.set_xscale("log")
    axes.set_xlabel("γ (nm²/(pN µs))")
    axes.set_ylabel("membrane area at 0.5 µs (nm²)")
    return figure


#: {name of the file: (title, what draws it, the tables it shows)}.
FIGURES = {
    "standard-necks": ("Neck radius of both engines against time, and their difference", necks, ("standard-differences",)),
    "standard-energy": ("Energy and dissipation of the standard case", energy, ("standard-energy",)),
    "standard-relatives": ("Differences of the engines in relatives of the standard case", relatives, ("relatives",)),
    "thin-layers": ("Differences of uniform layers from the sharp engine against their thickness", thin_layers, ("thin-layers",)),
    "smooth-case-errors": ("Errors of the smooth case against the layer's thickness", smooth_case, ("smooth-case",)),
    "refinement": ("Error of the sharp engine's budding time", refinement, ("refinement",)),
    "twelve-radii": ("Budding time, diameter and neck against the coat's radius", radii, ("twelve-radii",)),
    "vesicle": ("Energy of a prolate vesicle, and differences of the engines", vesicle, ("vesicle",)),
    "mode-gains": ("Growth of perturbations against the coat's radius", mode_gains, ("modes-of-radii",)),
    "noise": ("Neck, height and ellipticity with thermal noise", noise, ("noise",)),
    "folds": ("A coat that snaps through two folds; the force of a tube", folds, ("snap-through", "snap-through-branch", "tube", "tube-branch")),
    "paper-attribution": ("Area by change of the numerics", attribution, ("paper-attribution",)),
    "paper-mobility": ("Area against the mobility", mobility, ("paper-mobility",)),
} | SCHEMATICS | PORTRAITS


def draw_all():
    """Draw every figure whose tables there are."""
    for name, (title, draw, shown) in FIGURES.items():
        if all(tables.read(table) for table in shown):
            ink.save(draw(), name, title, shown)
