"""How much of the meridian plane and of time plots, pictures and the page show, and how axes are written."""

import numpy as np

from comparisons.measures.metrics import last_budding

#: The axis becomes logarithmic when runs go on this many times longer than budding; it then starts at this fraction.
LOG_FROM, LOG_START = 4, 1e-3


def half_width(shapes):
    """How far from the axis pictures of some shapes go, nm: to the rim, or somewhat beyond a closed membrane."""
    return max(1.15 * shape.r.max() if shape.closed else shape.r[-1] for shape in shapes)


def vertical_range(shapes, margin):
    """(lowest, highest) z in nm of some shapes, with a margin."""
    return min(s.z.min() for s in shapes) - margin, max(s.z.max() for s in shapes) + margin


def long_after_budding(metrics):
    """Whether the runs go on so long after budding that a linear time axis would hide it."""
    budding = last_budding(metrics)
    return budding is not None and last_time(metrics) > LOG_FROM * budding


def last_time(metrics):
    """The later end of both runs' histories, µs."""
    return max(run["end_us"] for run in metrics["runs"].values())


def time_axis(metrics):
    """{first, last, logarithmic}: range (µs) and scale."""
    last = last_time(metrics)
    if long_after_budding(metrics):
        return {"first": LOG_START * last_budding(metrics), "last": last, "logarithmic": True}
    return {"first": 0.0, "last": last if last > 0 else 1.0, "logarithmic": False}


def plain_number(value, _place):
    """Tick label of a logarithmic axis: 0.01, not 10⁻²."""
    return f"{value:g}"


def distance(x, _place):
    """Tick label of an axis across both half-planes: how far from the axis of symmetry."""
    return f"{abs(x):g}"


def say_none(axes, text):
    """Write into an empty panel that there is nothing to draw."""
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", color="#777777")
    axes.set_yticks([])


def mark_time(axes, time, line=":"):
    """A thin grey line at a time (µs); none at None."""
    if time is not None:
        axes.axvline(time, color="#888888", linewidth=0.9, linestyle=line)


def draw_histories(grid, columns, lines, none, label="time (µs)"):
    """Columns {column: Quantity} of histories, one in each of the first panels of a grid; none: what an empty one says.

    lines: [(what it goes along (rows,), history, look)] of each run, for Axes.plot.
    """
    for axes, (column, shown) in zip(grid, columns.items()):
        values = [shown.factor * history[column] for _, history, _ in lines]
        for (along, _, look), value in zip(lines, values):
            axes.plot(along, value, **look)
        axes.set_title(shown.label)
        axes.set_xlabel(label)
        if not any(np.isfinite(value).any() for value in values):
            say_none(axes, none)
