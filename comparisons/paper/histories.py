"""Histories of several runs on the same axes."""

import numpy as np

from comparisons.drawing import style
from comparisons.drawing.plots import legend_on_top
from comparisons.drawing.pyplot import plt

from .item import is_run

COLUMNS = ("neck_radius_nm", "bud_diameter_nm", "bud_height_nm")

#: Colours of runs in order (Okabe and Ito), and the line of each engine.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
LINES = {"boundary-integral": "-", "phase-field": (0, (4, 2))}


#: Where the time axis begins, µs; for runs of less than a microsecond that part of their length.
FIRST_SHOWN = 0.01


def history_names(titles, engines):
    """Names of the lines: {(run name, engine): text} from {run name: title}."""
    return {
        (name, engine): f"{title}, {style.ENGINE_NAMES[engine]}" for name, title in titles.items() for engine in engines
    }


def history_figure(runs, names, columns=COLUMNS):
    """Columns against time (logarithmic); names: {(run name, engine): legend text}. A run's colour is its name's."""
    order = list(dict.fromkeys(name for name, _ in names))
    figure, grid = plt.subplots(1, len(columns), figsize=(10.6, 3.6), layout="constrained")
    handles, texts = [], []
    for (name, engine), legend in names.items():
        run = runs[name].get(engine)
        if not is_run(run):
            continue
        look = {"color": COLOURS[order.index(name) % len(COLOURS)], "linestyle": LINES[engine]}
        for axes, column in zip(grid, columns):
            values = run.history[column] * style.HISTORY_PLOTS[column].factor
            line = axes.plot(run.history["time_us"], values, **look)
        handles.append(line[0])
        texts.append(legend)
    last = max((axes.dataLim.x1 for axes in grid if np.isfinite(axes.dataLim.x1)), default=1.0)
    for axes, column in zip(grid, columns):
        axes.set_title(style.axis_label(column))
        axes.set_xscale("log", nonpositive="mask")
        axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        axes.set_xlim(min(FIRST_SHOWN, FIRST_SHOWN * last), last)
        if not np.isfinite(axes.dataLim.y1):
            axes.text(0.5, 0.5, "none in any run", transform=axes.transAxes, ha="center", color="#777777")
            axes.set_yticks([])
        axes.set_ylim(bottom=0)
        axes.set_xlabel("time (µs)")
    if "neck_radius_nm" in columns and np.isfinite(grid[columns.index("neck_radius_nm")].dataLim.y1):
        grid[columns.index("neck_radius_nm")].axhline(
            style.BUDDING_NECK_RADIUS, color="#888888", linewidth=0.9, linestyle=":"
        )
    if handles:
        legend_on_top(figure, handles, texts)
    return figure
