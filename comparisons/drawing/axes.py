"""How much of the meridian plane and of time plots, pictures and the page show."""

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
