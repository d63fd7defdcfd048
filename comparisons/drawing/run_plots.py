"""Plots of a single run."""

import numpy as np

from comparisons.drawing import style
from comparisons.drawing.pictures import Panel, gallery
from comparisons.drawing.plots import save_all
from comparisons.drawing.pyplot import plt
from comparisons.measures.along import Along

#: Panels of the picture of the membrane.
PANELS = 4


def write_all(run, directory):
    """Write the plots of an endoflow.Run into directory (Path); returns {name: title}."""
    figures = {
        "run_membranes": ("The membrane, coloured by molecule concentration c", membranes(run)),
        "run_histories": ("Histories", histories(run)),
    }
    return save_all(figures, directory)


def membranes(run):
    """Output shapes, evenly chosen up to a little after budding or to the end."""
    times = run.shape_times
    end = min(times[-1], 1.2 * (run.event_time("budding") or times[-1]))
    wanted = np.linspace(times[0], end, PANELS + 1)[1:] if len(times) > 1 else times
    chosen = np.unique(np.argmin(np.abs(times[:, None] - wanted), axis=0))
    along = Along(run)
    start = "t = " if along.is_time else ""
    return gallery([("", [Panel(start + along.quantity(times[index]), run.shapes[index]) for index in chosen])])


def histories(run):
    """Every quantity of style.HISTORY_PLOTS against what the run goes along."""
    along = Along(run)
    figure, grid = plt.subplots(2, 4, figsize=(12.4, 5.2), layout="constrained")
    colour = style.ENGINE_COLOURS.get(run.engine, style.SECOND_RUN_COLOUR)[0]
    grid.flat[-1].set_axis_off()
    for axes, (column, shown) in zip(grid.flat, style.HISTORY_PLOTS.items()):
        values = run.history[column] * shown.factor
        axes.set_title(style.axis_label(column))
        axes.set_xlabel(along.label)
        if not np.isfinite(values).any():
            axes.text(0.5, 0.5, "none in this run", transform=axes.transAxes, ha="center", color="#777777")
            axes.set_yticks([])
            continue
        axes.plot(along.values, values, color=colour, marker="o" if len(values) == 1 else "")
        if run.event_time("budding") is not None:
            axes.axvline(run.event_time("budding"), color="#888888", linewidth=0.9, linestyle=":")
    return figure
