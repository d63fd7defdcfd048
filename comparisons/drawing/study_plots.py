"""Plots of the ε → 0 study, each written as PNG and SVG on light ground."""

import textwrap

import matplotlib
import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter, NullLocator

from comparisons.drawing import style
from comparisons.drawing.plots import DRAWN_SPACING, legend_on_top, save_all, vertical_range
from comparisons.drawing.pyplot import plt
from comparisons.measures.convergence import BUDDING, DISTANCES, PAIRS, at_time, error_of, value_of
from endoflow.curves import resample

#: Titles of the quantities: name and unit.
TITLES = {
    "mean_distance_nm": "Mean distance (nm)",
    "hausdorff_distance_nm": "Hausdorff distance (nm)",
    "neck_radius_nm": "Neck radius (nm)",
    "bud_diameter_nm": "Lateral diameter (nm)",
    "membrane_area_nm2": "Membrane area (nm²)",
    "volume_extracellular_nm3": "Volume gained (nm³)",
    "bending_energy_pN_nm": "Bending energy (pN nm)",
    "budding_time_us": "Budding time (µs)",
}

#: Histories shown for all runs.
HISTORIES = (
    "neck_radius_nm",
    "bud_diameter_nm",
    "bud_height_nm",
    "membrane_area_nm2",
    "bending_energy_pN_nm",
    "area_strain_max",
)

#: Colour of the sharp run, and colour maps from the largest to the smallest ε and from the first to the last time.
SHARP = style.ENGINE_COLOURS["boundary-integral"][0]
EPSILONS = matplotlib.colormaps["YlOrBr"]
TIMES = matplotlib.colormaps["BuPu"]

#: Least distance of two slope labels, as a part of the axis.
LABEL_GAP = 0.075


def write_all(sharp, diffuse, metrics, directory):
    """Write every plot of a study's endoflow.Run, DiffuseRuns and metrics into directory; returns {name: title}."""
    figures = {
        "errors": ("Errors against ε, with the fitted orders p", errors(metrics)),
        "limits": (f"Values at {metrics['times_us'][-1]:.4g} µs and their limit ε → 0", limits(metrics)),
        "membranes": ("Membranes of all ε and the sharp one", membranes(sharp, diffuse, metrics["times_us"])),
        "histories": ("Histories", histories(sharp, diffuse)),
    }
    return save_all(figures, directory)


def shades(colours, count):
    """`count` colours of a map, from light to dark, none too pale for a line."""
    return [colours(level) for level in (np.linspace(0.42, 0.95, count) if count > 1 else [0.75])]


def spread(places, gap):
    """Numbers (n,) close to `places` that keep their order and are at least `gap` apart."""
    order = np.argsort(places, kind="stable")
    moved = np.array(places, dtype=float)
    for before, after in zip(order, order[1:]):
        moved[after] = max(moved[after], moved[before] + gap)
    return moved - (moved - places).mean() if len(moved) else moved


def errors(metrics):
    """|error| of every quantity against ε on logarithmic axes, one line with its order for each stated time."""
    times, records = metrics["times_us"], metrics["records"]
    colours = shades(TIMES, len(times))
    figure, grid = plt.subplots(2, 4, figsize=(12.4, 6.0), layout="constrained")
    for axes, quantity in zip(grid.flat, (*DISTANCES, *PAIRS)):
        lines = []
        for time, colour in zip(times, colours):
            own = at_time(records, time)
            lines.append((time, colour, [r["epsilon_nm"] for r in own], [error_of(r, quantity) for r in own]))
        _draw_errors(axes, quantity, lines, metrics["orders"])
    sharp = metrics["sharp"][BUDDING]
    budding = [(run["epsilon_nm"], run[BUDDING]) for run in metrics["runs"]]
    error = [None if None in (time, sharp) else abs(time - sharp) for _, time in budding]
    _draw_errors(grid.flat[-1], BUDDING, [(None, "#333333", [e for e, _ in budding], error)], metrics["orders"])
    handles = [plt.Line2D([], [], color=colour, marker="o", markersize=5, linestyle="") for colour in colours]
    handles.append(plt.Line2D([], [], color="#666666", linestyle=(0, (4, 2)), linewidth=1.2))
    legend_on_top(figure, handles, [f"{time:.4g} µs" for time in times] + ["fit, with its order p"])
    return figure


def _draw_errors(axes, quantity, lines, orders):
    """One panel; lines: [(time, colour, ε, errors)]."""
    title = TITLES[quantity]
    axes.set_title(title if quantity in DISTANCES else f"|Error| of {title[0].lower()}{title[1:]}", size=9.5)
    axes.set_xlabel("ε (nm)")
    shown = []
    for time, colour, epsilon, values in lines:
        points = [(e, v) for e, v in zip(epsilon, values) if v is not None and v > 0]
        if not points:
            continue
        x, y = map(np.array, zip(*points))
        axes.plot(x, y, "o", color=colour, markersize=5, zorder=3)
        fit = next((o for o in orders if (o["quantity"], o["time_us"]) == (quantity, time)), None)
        if fit is not None:
            fitted = fit["factor"] * x ** fit["order"]
            axes.plot(x, fitted, color=colour, linewidth=1.2, linestyle=(0, (4, 2)))
            shown.append((fitted[np.argmin(x)], x.min(), colour, fit["order"]))
    if not axes.lines:
        axes.set(xticks=[], yticks=[])
        axes.text(0.5, 0.5, "not in these runs", transform=axes.transAxes, ha="center", color="#777777")
        return
    axes.set_xscale("log")
    axes.set_yscale("log")
    _epsilon_ticks(axes, lines)
    _label_orders(axes, shown)


def _epsilon_ticks(axes, lines):
    """Ticks at the ε of the study, room for labels on the left."""
    epsilon = sorted({e for _, _, values, _ in lines for e in values})
    axes.set_xlim(epsilon[0] * (epsilon[0] / epsilon[-1]) ** 0.6 / 1.02, epsilon[-1] * 1.08)
    axes.set_xticks(epsilon, [f"{e:g}" for e in epsilon])
    axes.xaxis.set_minor_locator(NullLocator())
    low, high = axes.get_ylim()
    if high < 10 * low:
        middle = np.sqrt(low * high)
        axes.set_ylim(middle / 3.2, middle * 3.2)
    if high < 100 * low:
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())


def _label_orders(axes, shown):
    """Fitted orders at the left ends; shown: [(error, ε, colour, order)]."""
    if not shown:
        return
    to_axes = axes.transData + axes.transAxes.inverted()
    heights = spread([to_axes.transform((e, v))[1] for v, e, *_ in shown], LABEL_GAP)
    for height, (_, epsilon, colour, order) in zip(heights, shown):
        axes.text(
            epsilon * 0.95,
            height,
            f"p = {order:.2f}",
            transform=axes.get_xaxis_transform(),
            ha="right",
            va="center",
            size=8.5,
            color=colour,
            weight="bold",
        )


def limits(metrics):
    """Values at the last stated time against ε, the fit v0 + a ε^p, v0 with its error, and the sharp run's value."""
    time = metrics["times_us"][-1]
    own = at_time(metrics["records"], time)
    entries = {(e["quantity"], e["time_us"]): e for e in metrics["limits"]}
    figure, grid = plt.subplots(2, 4, figsize=(12.4, 5.6), layout="constrained")
    for axes, quantity in zip(grid.flat, (*DISTANCES, *PAIRS)):
        points = [(r["epsilon_nm"], value_of(r, quantity)) for r in own]
        _draw_limit(axes, quantity, points, entries.get((quantity, time)))
    budding = [(run["epsilon_nm"], run[BUDDING]) for run in metrics["runs"]]
    _draw_limit(grid.flat[-1], BUDDING, budding, entries.get((BUDDING, None)))
    colour = style.ENGINE_COLOURS["phase-field"][0]
    handles = [
        plt.Line2D([], [], color=colour, marker="o", markersize=5, linestyle=""),
        plt.Line2D([], [], color=colour, linestyle=(0, (4, 2)), linewidth=1.2),
        plt.Line2D([], [], color="#333333", marker="D", markersize=5, linestyle="-"),
        plt.Line2D([], [], color=SHARP, linewidth=2),
    ]
    legend_on_top(figure, handles, ["phase field", "$v_0 + a\\,ε^p$", "limit $v_0$ with its error", "sharp"])
    return figure


def _draw_limit(axes, quantity, points, entry):
    """One panel; points: [(ε, value or None)]; entry: of metrics["limits"], or None."""
    colour = style.ENGINE_COLOURS["phase-field"][0]
    axes.set_title(TITLES[quantity], size=9.5)
    axes.set_xlabel("ε (nm)")
    points = [(e, v) for e, v in points if v is not None]
    if not points or entry is None:
        axes.set(xticks=[], yticks=[])
        axes.text(0.5, 0.5, "not in these runs", transform=axes.transAxes, ha="center", color="#777777")
        return
    x, y = map(np.array, zip(*points))
    axes.set_xlim(-0.06 * x.max(), 1.06 * x.max())
    axes.ticklabel_format(axis="y", useOffset=False)
    if entry["sharp"] is not None:
        axes.axhline(entry["sharp"], color=SHARP, linewidth=2, zorder=1)
    axes.plot(x, y, "o", color=colour, markersize=5, zorder=3)
    if entry["value"] is None:
        text = "no limit:\n" + textwrap.fill(entry["reason"], 28)
        axes.text(0.04, 0.5, text, transform=axes.transAxes, va="center", size=8, color="#777777").set_in_layout(False)
        return
    fine = np.linspace(0, x.max(), 200)
    fitted = entry["value"] + (entry["coefficient"] * fine ** entry["order"] if entry["order"] else 0 * fine)
    axes.plot(fine, fitted, color=colour, linewidth=1.2, linestyle=(0, (4, 2)))
    low, high = axes.get_ylim()
    axes.errorbar(0, entry["value"], entry["error"], color="#333333", marker="D", markersize=5, capsize=3, zorder=4)
    axes.set_ylim(  # a very uncertain limit shall not hide the values
        max(axes.get_ylim()[0], low - (high - low)), min(axes.get_ylim()[1], high + (high - low))
    )


def membranes(sharp, diffuse, times):
    """Outlines of all runs on top of each other, one panel for each time (µs); the broad line is the sharp one."""
    colours = shades(EPSILONS, len(diffuse))
    shapes = [[_shape_or_none(run, t) for run in (sharp, *(one.run for one in diffuse))] for t in times]
    z_range = vertical_range([shape for row in shapes for shape in row if shape is not None], 6.0)
    rim = shapes[0][0].r[-1]
    columns = min(2, len(times))
    rows = -(-len(times) // columns)
    height = 0.7 + rows * (0.5 + 8.6 / columns * (z_range[1] - z_range[0]) / rim)
    figure, grid = plt.subplots(
        rows, columns, figsize=(9.4, height), sharex=True, sharey=True, squeeze=False, layout="constrained"
    )
    for axes in grid.flat[len(times) :]:
        axes.set_axis_off()
    for axes, time, row in zip(grid.flat, times, shapes):
        for shape, colour, width in zip(row, [SHARP, *colours], [4.0] + [1.1] * len(diffuse)):
            if shape is not None:
                axes.plot(*resample(shape.r, shape.z, DRAWN_SPACING), color=colour, linewidth=width)
        axes.set(aspect="equal", xlim=(0, rim), ylim=z_range)
        axes.set_title(f"t = {time:.4g} µs")
    for axes in grid[-1]:
        axes.set_xlabel("r (nm)")
    for axes in grid[:, 0]:
        axes.set_ylabel("z (nm)")
    _name_runs(figure, diffuse, colours)
    return figure


def _shape_or_none(run, time):
    """The run's membrane at a time (µs), None outside the run."""
    covered = run.shape_times[0] <= time <= run.shape_times[-1] * (1 + 1e-9)
    return run.shape_at(time) if covered else None


def histories(sharp, diffuse):
    """Quantities against time of all runs."""
    colours = shades(EPSILONS, len(diffuse))
    figure, grid = plt.subplots(2, 3, figsize=(11.4, 5.4), sharex=True, layout="constrained")
    for axes, column in zip(grid.flat, HISTORIES):
        shown = style.HISTORY_PLOTS[column]
        axes.plot(sharp.history["time_us"], shown.factor * sharp.history[column], color=SHARP, linewidth=3.6)
        for one, colour in zip(diffuse, colours):
            history = one.run.history
            axes.plot(history["time_us"], shown.factor * history[column], color=colour, linewidth=1.3)
        axes.set_title(style.axis_label(column))
        values = np.concatenate([run.history[column] for run in (sharp, *(one.run for one in diffuse))])
        if not np.isfinite(values).any():
            axes.set_yticks([])
            axes.text(0.5, 0.5, "none in any run", transform=axes.transAxes, ha="center", color="#777777")
    for axes in grid[-1]:
        axes.set_xlabel("time (µs)")
    _name_runs(figure, diffuse, colours)
    return figure


def _name_runs(figure, diffuse, colours):
    """Legend of the sharp run and all ε."""
    handles = [plt.Line2D([], [], color=SHARP, linewidth=3.6)]
    handles += [plt.Line2D([], [], color=colour, linewidth=1.6) for colour in colours]
    legend_on_top(figure, handles, ["sharp", *(f"ε = {one.epsilon:g} nm" for one in diffuse)])
