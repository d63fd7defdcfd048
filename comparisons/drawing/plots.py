"""Static plots of a comparison, each written as PNG and SVG on light ground."""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.collections import LineCollection
from matplotlib.ticker import LogLocator, NullFormatter
from scipy.integrate import trapezoid

from comparisons.drawing import style
from comparisons.drawing.axes import distance, draw_histories, half_width, plain_number, time_axis, vertical_range
from comparisons.drawing.style import plt
from comparisons.files import named
from comparisons.measures.metrics import compared, concentration_profile, last_budding
from comparisons.measures.quantities import DRAWN
from endoflow.curves import resample

#: Panels of the picture of both membranes, and spacing (nm) of the drawn curve.
PANELS = 4
DRAWN_SPACING = 0.4

#: Number of colour steps between c = 0 and c = 1.
COLOUR_LEVELS = 64

#: Smallest part of the largest value that a logarithmic axis shows: what is lower started from zero.
SMALLEST_SHOWN = 1e-5


def write_all(a, b, metrics, labels, directory):
    """Write every plot of endoflow.Run objects a, b and their metrics into directory (Path); returns {name: title}."""
    colours = [light for light, _ in style.colours(a, b)]
    times = panel_times(metrics)
    figures = {
        "membranes": ("Both membranes, coloured by molecule concentration c", membranes(a, b, times, labels, colours)),
        "outlines": ("Outlines on top of each other", outlines(a, b, times, labels, colours)),
        "concentration": ("Concentration against membrane area", concentration(a, b, times, labels, colours)),
        "histories": ("Histories", histories(a, b, labels, colours, time_axis(metrics))),
        "distances": ("Distance between the membranes", distances(metrics)),
    }
    if covers_paper_times(metrics):
        title = "Both membranes at the times of the paper's Fig. 4"
        figures["membranes_paper_times"] = (title, membranes(a, b, style.PAPER_TIMES, labels, colours))
    return save_all(figures, directory)


def save_all(figures, directory):
    """Write figures, {name: (title, figure)}, into directory (Path); returns {name: title}."""
    for name, (_, figure) in figures.items():
        save(figure, directory, name)
    return {name: title for name, (title, _) in figures.items()}


def save(figure, directory, name):
    """Write a figure as directory/name.png and .svg and close it."""
    # savefig() would go through every figure once more before it draws it
    with named(directory / f"{name}.png"):
        FigureCanvasAgg(figure).print_png(directory / f"{name}.png")
    figure.set_layout_engine("none")  # keeps the layout just made
    with named(directory / f"{name}.svg"):
        FigureCanvasSVG(figure).print_svg(directory / f"{name}.svg", metadata={"Date": None})
    plt.close(figure)


def covers_paper_times(metrics):
    """Whether both runs have shapes at all times of the paper's figure."""
    first, last = metrics["common_interval_us"]
    return first <= style.PAPER_TIMES[0] and style.PAPER_TIMES[-1] <= last


def panel_times(metrics):
    """At most PANELS output times (µs), evenly chosen up to a little after budding or, if earlier, to the end of both runs."""
    first, last = metrics["common_interval_us"]
    wanted = np.linspace(first, min(last, 1.2 * (last_budding(metrics) or last)), PANELS + 1)[1:]
    output_times = np.array([record["time_us"] for record in compared(metrics["times"])])
    return output_times[np.unique(np.argmin(np.abs(output_times[:, None] - wanted), axis=0))]


def draw_half(axes, shape, side, z_range, rim, line_width):
    """One membrane in the half-plane `side` (−1 left, +1 right), coloured by c, its extracellular side tinted."""
    r, z, c = resample(shape.r, shape.z, DRAWN_SPACING, shape.c)
    x = side * r
    outline = np.vstack((np.column_stack((x, z)), [(x[-1], z_range[0]), (0.0, z_range[0])]))
    axes.fill(*outline.T, color=style.EXTRACELLULAR, linewidth=0, zorder=1)
    pieces, levels = pieces_of_equal_level(np.column_stack((x, z)), c)
    lines = LineCollection(
        pieces, cmap=style.CONCENTRATION, linewidths=line_width, capstyle="round", joinstyle="round", zorder=3
    )
    lines.set_array(levels)
    lines.set_clim(0.0, 1.0)
    axes.add_collection(lines, autolim=False)
    half = plt.Rectangle((min(0, side * rim), z_range[0]), rim, z_range[1] - z_range[0], transform=axes.transData)
    lines.set_clip_path(half)
    return lines


def pieces_of_equal_level(points, c):
    """Split a curve, points (n, 2) with concentrations c (n,), into polylines of one colour level that share end points.

    Returns the list of polylines and the array of their concentrations.
    """
    level = np.round(np.clip(0.5 * (c[1:] + c[:-1]), 0, 1) * COLOUR_LEVELS)
    starts = np.concatenate(([0], np.nonzero(np.diff(level))[0] + 1))
    ends = np.append(starts[1:], len(level))
    return [points[i : j + 1] for i, j in zip(starts, ends)], level[starts] / COLOUR_LEVELS


def draw_pair(axes, shapes, colours, z_range, rim, line_width=3.0):
    """Run A's membrane on the left half-plane, run B's on the right, out to r = rim (nm); returns coloured lines."""
    for shape, side in zip(shapes, (-1, 1)):
        lines = draw_half(axes, shape, side, z_range, rim, line_width)
    axes.axvline(0.0, color="#666666", linewidth=0.8, linestyle=(0, (6, 3, 1, 3)), zorder=2)
    for side, colour in zip((-1, 1), colours):
        axes.plot(
            [0.03 * side * rim, side * rim],
            [z_range[0]] * 2,
            color=colour,
            linewidth=5,
            clip_on=False,
            zorder=4,
            solid_capstyle="butt",
        )
    axes.set(xlim=(-rim, rim), ylim=z_range, aspect="equal", facecolor=style.CYTOPLASM)
    axes.grid(False)
    axes.xaxis.set_major_formatter(distance)
    return lines


def membranes(a, b, times, labels, colours):
    """Panels of both membranes side by side at some times (µs)."""
    pairs = [(a.shape_at(t), b.shape_at(t)) for t in times]
    z_range = vertical_range([shape for pair in pairs for shape in pair], 8.0)
    columns = 2 if len(times) > 1 else 1
    rows = -(-len(times) // columns)
    height = 0.9 + rows * (0.3 + 3.7 * (z_range[1] - z_range[0]) / 160)
    figure, grid = plt.subplots(
        rows, columns, figsize=(9.4, height), sharex=True, sharey=True, squeeze=False, layout="constrained"
    )
    for axes, time, pair in zip(grid.flat, times, pairs):
        lines = draw_pair(axes, pair, colours, z_range, rim=half_width(pair))
        axes.set_title(f"t = {time:.4g} µs")
    for axes in grid[-1]:
        axes.set_xlabel("r (nm)")
    for axes in grid[:, 0]:
        axes.set_ylabel("z (nm)")
    figure.colorbar(
        lines, ax=grid, label="molecule concentration c", shrink=0.7, aspect=25, pad=0.02
    ).outline.set_visible(False)
    _name_halves(figure, labels, colours)
    return figure


def panels(count, height=2.6, columns=4):
    """(figure, [axes]) with `count` panels, some in a row of this height (inches)."""
    rows = -(-count // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(3.1 * columns, height * rows), squeeze=False, layout="constrained")
    for axes in grid.flat[count:]:
        axes.remove()
    return figure, list(grid.flat[:count])


def legend_on_top(figure, handles, texts):
    """A one-line legend above all panels."""
    strip = 0.36 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - strip))
    figure.legend(
        handles, texts, loc="upper center", ncols=len(texts), fontsize=10.5, borderaxespad=0.3, handlelength=2.6
    )


def _name_halves(figure, labels, colours):
    """Say which run is left and which right."""
    handles = [plt.Line2D([], [], color=colour, linewidth=5, solid_capstyle="butt") for colour in colours]
    names = [f"{side}: {style.literal(label)}" for side, label in zip(("left", "right"), labels)]
    legend_on_top(figure, handles, names)


def _name_lines(figure, labels, colours):
    """Say which line is which run."""
    handles = [plt.Line2D([], [], color=colour, **line) for colour, line in zip(colours, style.LINES)]
    legend_on_top(figure, handles, [style.literal(label) for label in labels])


def outlines(a, b, times, labels, colours):
    """Both outlines on the same axes, one panel for each time (µs)."""
    pairs = [(a.shape_at(t), b.shape_at(t)) for t in times]
    z_range = vertical_range([shape for pair in pairs for shape in pair], 6.0)
    height = 1.1 + 8.6 / len(times) * (z_range[1] - z_range[0]) / half_width(pairs[0])
    figure, grid = plt.subplots(1, len(times), figsize=(9.4, height), sharey=True, squeeze=False, layout="constrained")
    for axes, time, pair in zip(grid[0], times, pairs):
        for shape, colour, line in zip(pair, colours, style.LINES):
            r, z = resample(shape.r, shape.z, DRAWN_SPACING)
            axes.plot(r, z, color=colour, **line)
        axes.set(aspect="equal", xlim=(0, half_width(pair)), ylim=z_range, xlabel="r (nm)")
        axes.set_title(f"t = {time:.4g} µs")
    grid[0, 0].set_ylabel("z (nm)")
    _name_lines(figure, labels, colours)
    return figure


def concentration(a, b, times, labels, colours):
    """c against the membrane area between axis and point, which stays with the material, one panel for each time (µs)."""
    figure, grid = plt.subplots(1, len(times), figsize=(9.4, 2.9), sharey=True, squeeze=False, layout="constrained")
    for axes, time in zip(grid[0], times):
        for run, colour, line in zip((a, b), colours, style.LINES):
            area, c = concentration_profile(run.shape_at(time))
            axes.plot(1e-3 * area, c, color=colour, **line)
            axes.set_xlim(0, 2e-3 * max(trapezoid(c, area), 0.1 * area[-1]))
        axes.set(ylim=(-0.05, 1.1), xlabel="area from the axis (10³ nm²)")
        axes.set_title(f"t = {time:.4g} µs")
    grid[0, 0].set_ylabel("concentration c")
    _name_lines(figure, labels, colours)
    return figure


def histories(a, b, labels, colours, time_range):
    """Every quantity of DRAWN of both runs against time, budding marked; time_range as of time_axis()."""
    figure, grid = panels(len(DRAWN) + 1)
    looks = [{"color": colour, **line} for colour, line in zip(colours, style.LINES)]
    lines = [(run.history["time_us"], run.history, look) for run, look in zip((a, b), looks)]
    draw_histories(grid, DRAWN, lines, "none in either run")
    for axes, (column, shown) in zip(grid, DRAWN.items()):
        for run, colour in zip((a, b), colours):
            _mark_budding(axes, run, colour)
        _set_time_axis(axes, time_range)
        if shown.logarithmic:
            _set_logarithmic(axes, shown.factor * np.concatenate([run.history[column] for run in (a, b)]))
    if np.isfinite(np.concatenate([run.history["neck_radius_nm"] for run in (a, b)])).any():
        neck = grid[list(DRAWN).index("neck_radius_nm")]
        neck.axhline(style.BUDDING_NECK_RADIUS, color="#888888", linewidth=0.9, linestyle=":")
        neck.set_ylim(bottom=0)
    _budding_times(grid[-1], (a, b), labels, colours)
    _name_lines(figure, labels, colours)
    return figure


def _budding_times(axes, runs, labels, colours):
    """Say in words when each run buds."""
    axes.set_axis_off()
    axes.text(0, 0.84, f"Budding time (neck < {style.BUDDING_NECK_RADIUS:g} nm)", weight="bold", size=10)
    for row, (run, label, colour) in enumerate(zip(runs, labels, colours)):
        time = run.event_time("budding")
        axes.text(0, 0.62 - 0.3 * row, "none" if time is None else f"{time:.4g} µs", size=15, color=colour)
        axes.text(0, 0.51 - 0.3 * row, style.literal(label), size=9, color="#444444")


def _set_time_axis(axes, time_range):
    """Range and scale of the time axis, as of time_axis()."""
    if time_range["logarithmic"]:
        axes.set_xscale("log", nonpositive="mask")
        axes.xaxis.set_major_formatter(plain_number)
    axes.set_xlim(time_range["first"], time_range["last"])


def _mark_budding(axes, run, colour):
    """A thin vertical line at the run's budding time."""
    time = run.event_time("budding")
    if time is not None:
        axes.axvline(time, color=colour, linewidth=0.9, alpha=0.5, zorder=1)


def _set_logarithmic(axes, values):
    """Logarithmic axis if the values (n,) are positive and span a decade."""
    found = values[np.isfinite(values)]
    if found.size and found.min() > 0 and found.max() > 10 * found.min():
        axes.set_yscale("log")
        axes.set_ylim(bottom=max(0.8 * found.min(), SMALLEST_SHOWN * found.max()))
        if found.max() < 1000 * found.min():
            axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axes.yaxis.set_major_formatter(plain_number)
            axes.yaxis.set_minor_formatter(NullFormatter())


def distances(metrics):
    """Mean and Hausdorff distance, and the difference of c, against time."""
    records = compared(metrics["times"])
    time = np.array([record["time_us"] for record in records])
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.4, 3.4), layout="constrained")
    curves = (
        ("hausdorff_distance_nm", "Hausdorff", "#333333", "-"),
        ("mean_distance_nm", "mean", "#7A3E9D", (0, (5, 2))),
    )
    for key, name, colour, dashes in curves:
        left.plot(time, [record[key] for record in records], color=colour, linestyle=dashes, label=name)
    values = np.array([record[key] for record in records for key, *_ in curves])
    if values.any():
        _set_logarithmic(left, values[values > SMALLEST_SHOWN * values.max()])
    if left.get_yscale() == "linear":
        left.set_ylim(0, 1.15 * values.max() or 1.0)
    left.set(xlabel="time (µs)", ylabel="distance (nm)")
    left.set_title("Distance between the membranes")
    left.legend()
    right.plot(time, [record["concentration_max"] for record in records], color="#333333", label="largest |Δc|")
    right.plot(
        time,
        [record["concentration_l1_relative"] or 0 for record in records],
        color="#7A3E9D",
        linestyle=(0, (5, 2)),
        label="∫|Δc| dA / ∫c dA",
    )
    right.set(xlabel="time (µs)", ylabel="difference of c", ylim=(0, None))
    right.set_title("Difference of c at equal membrane area")
    right.legend()
    for axes in (left, right):
        _set_time_axis(axes, time_axis(metrics))
    return figure
