"""Plots of the azimuthal modes of a run."""

import numpy as np
from matplotlib.colors import LinearSegmentedColormap

from comparisons.drawing import style
from comparisons.drawing.plots import save_all
from comparisons.drawing.pyplot import plt
from comparisons.drawing.surfaces import Revolved
from endoflow.curves import resample

#: From the lowest mode to the highest; lightness is monotone.
MODE_COLOURS = LinearSegmentedColormap.from_list("modes", ("#8E1068", "#0072B2", "#56B4A0", "#B9C76A"))

#: What the initial shapes are called.
INITIAL_TITLES = {
    "dome": "Displaced half-way to the coat's edge",
    "edge": "Displaced at the coat's edge",
    "sheet": "The whole sheet displaced",
    "coat": "The coat's edge out of round",
    "worst": "Worst displacement",
}

#: Largest displacement at the start, nm.
INITIAL_AMPLITUDE = 0.1

#: Smallest displacement (nm) that the histories show.
SMALLEST_SHOWN = 1e-4

#: Columns and rows of the picture of the shapes; displacement (nm) that is drawn.
PANEL_TIMES, PANEL_MODES, DRAWN_DISPLACEMENT = 4, 3, 4.0


def write_all(modes, directory):
    """Write the plots of an endoflow.Modes into directory (Path); returns {name: title}."""
    figures = {
        "modes_rates": ("Largest growth rate of each mode", rates(modes)),
        "modes_perturbations": ("What 0.1 nm becomes", perturbations(modes)),
        "modes_shapes": ("The fastest mode's displacement, drawn 4 nm large", shapes(modes)),
    }
    return save_all(figures, directory)


def colours(modes):
    """{m: colour}."""
    return {m: MODE_COLOURS(i / max(1, len(modes.modes) - 1)) for i, m in enumerate(modes.modes)}


def mark_budding(axes, modes):
    """A dotted line at the time of budding."""
    if modes.budding is not None:
        axes.axvline(modes.budding, color="#888888", linewidth=0.9, linestyle=":")


def rates(modes):
    """All rates, and those about zero."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.6, 3.8), layout="constrained")
    for m, colour in colours(modes).items():
        for axes in (left, right):
            axes.plot(modes.times, modes.rates[m], color=colour, marker="o", markersize=3, label=f"m = {m}")
    for axes in (left, right):
        axes.axhline(0, color="#444444", linewidth=0.8)
        axes.set_xlabel("time (µs)")
        mark_budding(axes, modes)
    left.set_title("Growth rate (1/µs)")
    right.set_title("The same about zero")
    top = max(rate.max() for rate in modes.rates.values())
    right.set_ylim(-3, max(1.0, 1.15 * top))
    left.legend(ncols=2, fontsize=8)
    return figure


def perturbations(modes):
    """The largest displacement against time, one panel for each initial shape."""
    names = modes.initial_shapes
    figure, grid = plt.subplots(
        1, len(names), figsize=(3.1 * len(names), 3.4), sharey=True, layout="constrained", squeeze=False
    )
    for axes, name in zip(grid.flat, names):
        for m, colour in colours(modes).items():
            peak = modes.perturbations[m, name]["peak_nm"]
            axes.plot(modes.times, np.where(peak > 0, peak, np.nan), color=colour, label=f"m = {m}")
        axes.axhline(INITIAL_AMPLITUDE, color="#444444", linewidth=0.8, linestyle="--")
        axes.set_title(INITIAL_TITLES.get(name, name), fontsize=9)
        axes.set_xlabel("time (µs)")
        axes.set_yscale("log")
        axes.set_ylim(bottom=SMALLEST_SHOWN)
        mark_budding(axes, modes)
    grid.flat[0].set_ylabel("largest displacement (nm)")
    grid.flat[-1].legend(fontsize=7, ncols=2)
    return figure


def shapes(modes):
    """The meridian and both sides of the fastest mode, at times up to budding, for the lowest modes."""
    chosen = np.unique(np.linspace(0, modes.last_index, PANEL_TIMES).round().astype(int))
    rows = modes.modes[:PANEL_MODES]
    meridians = [modes.meridians[i] for i in chosen]
    low = min(meridian.z.min() for meridian in meridians) - 6
    high = max(meridian.z.max() for meridian in meridians) + 6
    rim = max(meridian.r.max() for meridian in meridians)
    figure, grid = plt.subplots(
        len(rows),
        len(chosen),
        figsize=(3.1 * len(chosen), 0.5 + len(rows) * 3.1 * (high - low) / (2 * rim) + 0.25 * len(rows)),
        sharex=True,
        sharey=True,
        squeeze=False,
        layout="constrained",
    )
    for line, m in zip(grid, rows):
        line[0].set_ylabel(f"m = {m}", weight="bold")
        for axes, meridian in zip(line, meridians):
            mode = meridian.modes[m]
            axes.set_title(f"t = {meridian.time:.3g} µs, {mode.growth:+.2f}/µs".replace("-", "−"), fontsize=9)
            axes.set(xlim=(-rim, rim), ylim=(low, high), aspect="equal")
            for side in (-1, 1):
                axes.plot(side * meridian.r, meridian.z, color="#999999", linewidth=1)
                # cos(m φ) at φ = 0 and at φ = π
                amount = DRAWN_DISPLACEMENT * (1 if side > 0 or m % 2 == 0 else -1) * mode.w
                r, z = meridian.r + amount * meridian.normal_r, meridian.z + amount * meridian.normal_z
                axes.plot(side * r, z, color=style.ENGINE_COLOURS["boundary-integral"][0], linewidth=1.6)
            axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
    for axes in grid[-1]:
        axes.set_xlabel("r (nm)")
    return figure


def surface(meridian, spacing):
    """(points, quads, arrays) of an endoflow.modes.Meridian for a .vtp file: c and each mode's displacement (nm), vectors."""
    modes = sorted(meridian.modes)
    along = [meridian.modes[m].w for m in modes]
    r, z, n_r, n_z, c, *w = resample(
        meridian.r, meridian.z, spacing, meridian.normal_r, meridian.normal_z, meridian.c, *along
    )
    revolved = Revolved(r, z)
    normal = revolved.vectors(n_r, n_z)
    arrays = {"c": revolved.around(c)}
    for m, values in zip(modes, w):
        amount = revolved.around(values) * np.cos(m * revolved.azimuth)
        arrays[f"mode_{m}_displacement_nm"] = amount[:, None] * normal
    return revolved.points, revolved.quads, arrays
