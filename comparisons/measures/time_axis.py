"""The time axis shared by all plots against time."""

from comparisons.measures.metrics import last_budding

#: The axis becomes logarithmic when runs go on this many times longer than budding; it then starts at this fraction.
LOG_FROM, LOG_START = 4, 1e-3


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
