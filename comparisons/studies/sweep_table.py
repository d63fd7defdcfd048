"""sweep.csv: one row for each member of a sweep.

Columns: the varied parameters (section.key), engine, state, exit_reason, time_us (reached), budding_time_us, then the
last row of history.csv: what is SWEPT, neck_radius_nm to bending_energy_pN_nm; alarms (names of the
quantities that left the bounds of an accurate run, between semicolons); program (version and revision of all that took part
in the run, between semicolons); wall_s; directory. Empty cells stand for "does not
exist" (no neck, no budding, not run). Of a run that went on longer than the sweep asks for, time_us and what stands in
history.csv are those at the sweep's end, wall_s is that of the whole run.
"""

import math

import numpy as np

from comparisons.measures.quantities import BUDDING, SWEPT
from comparisons.studies.members import covers, differing_parameters, read_record
from endoflow import EndoflowError
from endoflow.alarms import alarms_of
from endoflow.history import read_history

#: Columns of the table that come from the last row of history.csv.
FINAL = tuple(column for column in SWEPT if column != BUDDING)


def row(member, outcome=None):
    """The row of a member (members.Member) as {column: value}, None for an empty cell.

    outcome: of this study's run (member_runner.Outcome), None when there was none.
    """
    record = read_record(member.directory)
    longer = covers(record, member)
    if (
        record is not None
        and not longer
        and differing_parameters(record["parameters"], member.parameters, member.engine)
    ):
        record = None  # another study's run
    found = record or {}
    end = member.end if longer else math.inf
    state, reason, time = found.get("state", "not run"), found.get("exit_reason"), found.get("time_us")
    if time is not None and time > end:
        state, reason, time = "finished", "done", end
    if outcome is not None and outcome.state == "failed":
        state, reason = "failed", (reason if state == "failed" else outcome.message)
    return {
        **member.values,
        "engine": member.engine,
        "state": state,
        "exit_reason": reason,
        "time_us": time,
        BUDDING: budding_time(found, end),
        **final_values(member.directory / "history.csv" if record else None, end),
        "alarms": "; ".join(alarm.name for alarm in alarms_of(found) if alarm.time <= end) or None,
        "program": "; ".join(programs(found)) or None,
        "wall_s": found.get("wall_s"),
        "directory": str(member.directory),
    }


def engines_of(rows):
    """The engines of some rows, in their order."""
    return list(dict.fromkeys(row["engine"] for row in rows))


def complaints(rows):
    """A sentence for each row whose run failed, then for each whose run raised alarms."""
    failed = [f"{row['directory']} failed: {row['exit_reason']}" for row in rows if "failed" in (row.get("state"), row.get("outcome"))]
    return failed + [f"{row['directory']}: accuracy alarm: {row['alarms']}" for row in rows if row["alarms"]]


def programs(record):
    """Version and revision of every program that took part in a run (run.json as a dict), each once."""
    parts = [record.get("provenance"), *(record.get("segments") or [])]
    known = [part for part in parts if isinstance(part, dict) and part.get("version")]
    return list(dict.fromkeys(f"{part['version']} ({part.get('git') or 'unknown'})" for part in known))


def mixed_programs(rows):
    """A sentence about rows of the table that different programs made; None when one made them all."""
    found = dict.fromkeys(name for row in rows for name in (row["program"] or "").split("; ") if name)
    if len(found) < 2:
        return None
    return f"the runs were made by different versions of the program: {', '.join(found)}; the column program tells which"


def budding_time(record, end):
    """Budding time (µs) up to `end`, or None."""
    budding = record.get("events", {}).get("budding")
    return budding["time_us"] if budding is not None and budding["time_us"] <= end else None


def final_values(path, end):
    """{column of FINAL: number or None} from the last row of a history.csv (Path, or None), or at `end` (µs) if earlier."""
    try:
        history = None if path is None else read_history(path, ("time_us", *FINAL))
    except EndoflowError:
        history = None
    if history is None:
        return dict.fromkeys(FINAL)
    time = min(end, history["time_us"][-1])
    last = {column: float(np.interp(time, history["time_us"], history[column])) for column in FINAL}
    return {column: value if math.isfinite(value) else None for column, value in last.items()}
