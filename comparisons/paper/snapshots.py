"""Rows of panels for some runs at some times."""

import style
from .item import is_run, last_time
from .pictures import gallery


def panels_at(found, times):
    """[(panel title, Shape or sentence)] of a run at some times (µs)."""
    if not is_run(found):
        return [(f"t = {time:.4g} µs", f"not run: {found.reason}") for time in times]
    ended = f"the run ended at {last_time(found):.4g} µs" + ended_because(found)
    return [
        (f"t = {time:.4g} µs", found.shape_at(time) if time <= last_time(found) * (1 + 1e-12) else ended)
        for time in times
    ]


def ended_because(run):
    """Why a run ended before its time, in words; "" when it did not."""
    reason = run.record.get("exit_reason")
    return {"neck_closed": "\n(neck closed)", "budded": "\n(budded)"}.get(reason, "")


def snapshots(runs, times, names, arrows=False):
    """Figure with a row for each engine and run (names: {run name: title}); rows without any shape are left out.

    times: µs, or a function of (engine, found) that gives them.
    """
    rows = []
    for name, title in names.items():
        for engine, found in runs[name].items():
            chosen = times(engine, found) if callable(times) else times
            rows.append((f"{title}\n{style.ENGINE_NAMES[engine]}", panels_at(found, chosen)))
    return gallery(rows, arrows=arrows)


def own_times(count=4):
    """Times for snapshots(): `count`, spread evenly over each run."""
    return lambda _, found: (
        [last_time(found) * (i + 1) / count for i in range(count)] if is_run(found) else [0.0] * count
    )
