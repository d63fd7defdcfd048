"""What the ε → 0 study shows: plots, each written as PNG and SVG on light ground, and report.html."""

import textwrap

import matplotlib
import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter, NullLocator

from comparisons.drawing import style
from comparisons.drawing.axes import draw_histories, plain_number, say_none, vertical_range
from comparisons.drawing.plots import DRAWN_SPACING, legend_on_top, panels, save_all
from comparisons.drawing.style import plt
from comparisons.files import write_text
from comparisons.measures.convergence import PAIRS, at_time, error_of, value_of
from comparisons.measures.quantities import BUDDING, DISTANCES, DRAWN, NAMES
from comparisons.page import html
from comparisons.page.html import escaped, figures, quantity, setting
from endoflow.curves import resample

#: Colour of the sharp run, and colour maps from the largest to the smallest ε and from the first to the last time.
SHARP = style.ENGINE_COLOURS["boundary-integral"][0]
EPSILONS = matplotlib.colormaps["YlOrBr"]
TIMES = matplotlib.colormaps["BuPu"]

#: Least distance of two slope labels, as a part of the axis.
LABEL_GAP = 0.075
LIMITS_NOTE = (
    '<p class="note">v0 of v0 + a ε^p fitted to the phase-field values alone. Its error is, with four or more ε, the '
    "larger of the fit’s 95 % half width and the change when the largest ε is left out; with three ε the whole distance "
    "from the smallest ε to the limit.</p>"
)


def write_page(sharp, diffuse, metrics, case, directory):
    """Write plots and report.html of a study's endoflow.Run, DiffuseRuns and metrics into directory (Path).

    case: {"section.key": value} of the parameters that all runs share.
    """
    plots = {
        "errors": ("Errors against ε, with the fitted orders p", errors(metrics)),
        "limits": (f"Values at {metrics['times_us'][-1]:.4g} µs and their limit ε → 0", limits(metrics)),
        "membranes": ("Membranes of all ε and the sharp one", membranes(sharp, diffuse, metrics["times_us"])),
        "histories": ("Histories", histories(sharp, diffuse)),
    }
    write_text(directory / "report.html", convergence_html(metrics, case, save_all(plots, directory), directory))


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
    figure, grid = panels(len(DISTANCES) + len(PAIRS) + 1, 3.0)
    for axes, column in zip(grid, (*DISTANCES, *PAIRS)):
        lines = []
        for time, colour in zip(times, colours):
            own = at_time(records, time)
            lines.append((time, colour, [r["epsilon_nm"] for r in own], [error_of(r, column) for r in own]))
        _draw_errors(axes, column, lines, metrics["orders"])
    sharp = metrics["sharp"][BUDDING]
    budding = [(run["epsilon_nm"], run[BUDDING]) for run in metrics["runs"]]
    error = [None if None in (time, sharp) else abs(time - sharp) for _, time in budding]
    _draw_errors(grid[-1], BUDDING, [(None, "#333333", [e for e, _ in budding], error)], metrics["orders"])
    handles = [plt.Line2D([], [], color=colour, marker="o", markersize=5, linestyle="") for colour in colours]
    handles.append(plt.Line2D([], [], color="#666666", linestyle=(0, (4, 2)), linewidth=1.2))
    legend_on_top(figure, handles, [f"{time:.4g} µs" for time in times] + ["fit, with its order p"])
    return figure


def _draw_errors(axes, quantity, lines, orders):
    """One panel; lines: [(time, colour, ε, errors)]."""
    title = NAMES[quantity]
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
        axes.set_xticks([])
        say_none(axes, "not in these runs")
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
        axes.yaxis.set_major_formatter(plain_number)
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
    figure, grid = panels(len(DISTANCES) + len(PAIRS) + 1, 2.8)
    for axes, column in zip(grid, (*DISTANCES, *PAIRS)):
        points = [(r["epsilon_nm"], value_of(r, column)) for r in own]
        _draw_limit(axes, column, points, entries.get((column, time)))
    budding = [(run["epsilon_nm"], run[BUDDING]) for run in metrics["runs"]]
    _draw_limit(grid[-1], BUDDING, budding, entries.get((BUDDING, None)))
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
    axes.set_title(NAMES[quantity], size=9.5)
    axes.set_xlabel("ε (nm)")
    points = [(e, v) for e, v in points if v is not None]
    if not points or entry is None:
        axes.set_xticks([])
        say_none(axes, "not in these runs")
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
    figure, grid = panels(len(DRAWN))
    histories = [sharp.history, *(one.run.history for one in diffuse)]
    looks = [{"color": SHARP, "linewidth": 3.6}, *({"color": colour, "linewidth": 1.3} for colour in colours)]
    lines = [(history["time_us"], history, look) for history, look in zip(histories, looks)]
    draw_histories(grid, DRAWN, lines, "none in any run")
    _name_runs(figure, diffuse, colours)
    return figure


def _name_runs(figure, diffuse, colours):
    """Legend of the sharp run and all ε."""
    handles = [plt.Line2D([], [], color=SHARP, linewidth=3.6)]
    handles += [plt.Line2D([], [], color=colour, linewidth=1.6) for colour in colours]
    legend_on_top(figure, handles, ["sharp", *(f"ε = {one.epsilon:g} nm" for one in diffuse)])


def convergence_html(metrics, case, drawn, directory):
    """The page of an ε → 0 study; case: as of write_page(); drawn: {plot: title}."""
    epsilons = ", ".join(f"{run['epsilon_nm']:g}" for run in metrics["runs"])
    sections = [
        ("Plots", html.plots(drawn, directory)),
        ("Fitted orders", orders_table(metrics)),
        ("Limits for ε → 0", LIMITS_NOTE + limits_table(metrics)),
        ("Distances and errors", records_table(metrics)),
        ("Runs", runs_table(metrics)),
        ("What the numbers rest on", basis_table(metrics)),
        ("Parameters of the case", html.parameters_table(case)),
    ]
    return html.page(
        "endoflow converge",
        "Phase field to sharp membrane",
        f"Case “{case['case.name']}” · ε = {epsilons} nm",
        metrics["warnings"],
        cards(metrics),
        sections,
        directory,
    )


def cards(metrics):
    """The key numbers on top: (title, ready HTML value, note)."""
    last = metrics["times_us"][-1]
    found = []
    for name in DISTANCES:
        entry = entry_of(metrics["orders"], name, last)
        if entry is not None:
            title = NAMES[name].split(" (")[0]
            found.append((f"{title}: order", figures(entry["order"], 3), f"at {last:.4g} µs, {interval(entry)}"))
    smallest = metrics["records"][-1]
    title = f"Mean distance, ε = {smallest['epsilon_nm']:g} nm"
    found.append((title, quantity(smallest["mean_distance_nm"], 3, "nm"), f"at {smallest['time_us']:.4g} µs"))
    budding = entry_of(metrics["limits"], BUDDING, None)
    sharp = metrics["sharp"]["budding_time_us"]
    found.append(("Budding, sharp", quantity(sharp, 4, "µs"), "neck radius below 5 nm"))
    if budding is not None and budding["value"] is not None:
        found.append(("Budding, ε → 0", quantity(budding["value"], 4, "µs"), f"± {figures(budding['error'], 2)} µs"))
    return found


def entry_of(entries, name, time):
    """The entry of `orders` or `limits` for a quantity and time, or None."""
    return next((e for e in entries if (e["quantity"], e["time_us"]) == (name, time)), None)


def interval(entry):
    """The 95 % interval of an order in words."""
    return "from two ε" if entry["low"] is None else f"95 %: {entry['low']:.2f} … {entry['high']:.2f}"


def orders_table(metrics):
    """Fitted orders with their intervals."""
    rows = [
        [
            escaped(NAMES[e["quantity"]].split(" (")[0]),
            setting(e["time_us"], 4),
            figures(e["order"], 3),
            "–" if e["low"] is None else f"{e['low']:.2f} … {e['high']:.2f}",
            ", ".join(f"{value:.2f}" for value in e["local"]),
        ]
        for e in metrics["orders"]
    ]
    return html.table(["error of", "t (µs)", "order", "95 % interval", "between neighbouring ε"], rows)


def limits_table(metrics):
    """Extrapolated values beside the sharp ones."""
    rows = []
    for e in metrics["limits"]:
        value = (
            f"{figures(e['value'], 5)} ± {figures(e['error'], 2)}" if e["value"] is not None else escaped(e["reason"])
        )
        inside = e["difference"] is not None and abs(e["difference"]) <= e["error"]
        verdict = "–" if e["difference"] is None else "yes" if inside else "no"
        cells = [escaped(NAMES[e["quantity"]]), setting(e["time_us"], 4), value, figures(e["order"], 3)]
        rows.append(
            [*cells, "0" if e["sharp"] == 0 else figures(e["sharp"], 5), figures(e["difference"], 3), verdict]
        )
    heads = ["", "t (µs)", "limit", "p", "sharp", "limit − sharp", "within its error"]
    return html.table(heads, rows)


def records_table(metrics):
    """Every record: distances, and the phase field's value with its difference from the sharp one."""
    rows = []
    for r in metrics["records"]:
        cells = [setting(r["time_us"], 4), f"{r['epsilon_nm']:g}", *(figures(r[name], 3) for name in DISTANCES)]
        cells += [f"{figures(r[name]['b'], 5)}<br><small>{signed(r[name]['difference'])}</small>" for name in PAIRS]
        rows.append(cells)
    heads = ["t (µs)", "ε (nm)", *(NAMES[name] for name in DISTANCES), *(NAMES[name] for name in PAIRS)]
    note = '<p class="note">Small: difference from the sharp run.</p>'
    return note + html.table(heads, rows)


def signed(value):
    """A difference with its sign."""
    return "–" if value is None else ("+" if value > 0 else "") + figures(value, 3)


def runs_table(metrics):
    """The runs: resolution, state, cost."""
    rows = []
    for run in [metrics["sharp"], *metrics["runs"]]:
        cells = [
            escaped(run["label"]),
            setting(run.get("cell_size_nm"), 4),
            setting(run["state"]),
            setting(run["exit_reason"]),
        ]
        cells += [figures(run["end_us"]), figures(run["budding_time_us"]), figures(run.get("wall_s"), 3)]
        rows.append([*cells, f"<code>{escaped(run['directory'])}</code>"])
    heads = ["", "cells (nm)", "state", "ended with", "end (µs)", "budding (µs)", "wall (s)", "directory"]
    return html.table(heads, rows)


def basis_table(metrics):
    """Convention, resolution and alarms of the runs."""
    runs = [metrics["sharp"], *metrics["runs"]]
    rows = [[escaped(run["label"]), *map(escaped, run["basis"].values())] for run in runs]
    return html.table(["", *map(escaped, runs[0]["basis"])], rows, "text")
