"""sweep.csv: one row for each member of a sweep.

Columns: the varied parameters (section.key), engine, state, exit_reason, time_us (reached), budding_time_us, then the
last row of history.csv: neck_radius_nm, lateral_diameter_nm, height_nm, area_nm2, energy_pN_nm; wall_s; directory. Empty
cells stand for "does not exist" (no neck, no budding, not run).
"""

import csv
import math

from comparisons.studies.members import differing_parameters, read_record
from endoflow import EndoflowError
from endoflow.history import read_history

#: Columns of the table that come from the last row of history.csv: {column: history column}.
FINAL = {
    "neck_radius_nm": "neck_radius_nm",
    "lateral_diameter_nm": "bud_diameter_nm",
    "height_nm": "bud_height_nm",
    "area_nm2": "membrane_area_nm2",
    "energy_pN_nm": "bending_energy_pN_nm",
}


def row(member, outcome=None):
    """The row of a member (members.Member) as {column: value}, None for an empty cell.

    outcome: of this study's run (member_runner.Outcome), None when there was none.
    """
    record = read_record(member.directory)
    if record is not None and differing_parameters(record["parameters"], member.parameters, member.engine):
        record = None  # another study's run
    found = record or {}
    budding = found.get("events", {}).get("budding")
    state, reason = found.get("state", "not run"), found.get("exit_reason")
    if outcome is not None and outcome.state == "failed":
        state, reason = "failed", (reason if state == "failed" else outcome.message)
    return {
        **member.values,
        "engine": member.engine,
        "state": state,
        "exit_reason": reason,
        "time_us": found.get("time_us"),
        "budding_time_us": None if budding is None else budding["time_us"],
        **final_values(member.directory / "history.csv" if record else None),
        "wall_s": found.get("wall_s"),
        "directory": str(member.directory),
    }


def final_values(path):
    """{column of FINAL: number or None} from the last row of a history.csv (Path, or None)."""
    try:
        history = None if path is None else read_history(path)
    except EndoflowError:
        history = None
    if history is None:
        return dict.fromkeys(FINAL)
    last = {column: float(history[source][-1]) for column, source in FINAL.items()}
    return {column: value if math.isfinite(value) else None for column, value in last.items()}


def write_table(path, rows):
    """Write rows, list of {column: value}, as CSV."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(rows[0])
        writer.writerows([cell(value) for value in entry.values()] for entry in rows)


def cell(value):
    """A value as text: numbers with 12 digits, None as nothing."""
    if value is None:
        return ""
    return f"{value:.12g}" if isinstance(value, float) else str(value)
