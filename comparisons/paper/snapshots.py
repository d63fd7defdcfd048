"""Rows of panels for some runs at some times."""

import style
from .item import end_of, is_run, last_time
from .pictures import gallery


def panels_at(found, times):
    """[(panel title, Shape or sentence)] of a run at some times (µs)."""
    if not is_run(found):
        return [(f"t = {time:.4g} µs", f"not run: {found.reason}") for time in times]
    ended = f"the run ended at {end_of(found):.4g} µs" + ended_because(found)
    return [
        (f"t = {time:.4g} µs", found.shape_at(time) if time <= last_time(found) * (1 + 1e-12) else ended)
        for time in times
    ]


def ended_because(run):
    """Why a run ended before its time, in words; "" when it did not."""
    reason = run.record.get("exit_reason")
    return {"neck_closed": "\n(neck closed)", "budded": "\n(budded)"}.get(reason, "")


def snapshots(runs, times, names, arrows=False):
    """Figure with a row for each engine and run (names: {run name: title}) at times (µs); rows without any shape are left out."""
    rows = []
    for name, title in names.items():
        for engine, found in runs[name].items():
            rows.append((f"{title}\n{style.ENGINE_NAMES[engine]}", panels_at(found, times)))
    shown = [row for row in rows if any(not isinstance(shape, str) for _, shape in row[1])]
    return gallery(shown or rows[:1], arrows=arrows)
