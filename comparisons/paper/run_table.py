"""runs.csv of `endoflow reproduce`: every run behind the items, how far it came, what it cost, what is left and what that may cost."""

from comparisons.studies.cost import expected_seconds
from comparisons.studies.members import FINISHED, Member, covers, differing_parameters, read_record, work_left

from .item import NotRun, ended_as


def rows(members):
    """One row for each of {name: members.Member or item.NotRun}."""
    return [not_asked(name, one) if isinstance(one, NotRun) else row(one) for name, one in members.items()]


def not_asked(name, found):
    """The row of a run that cannot be made."""
    columns = ("engine", "case", "settings", "end_us", "state", "time_us", "steps", "cpu_s", "git", "left_s")
    return {"run": name, **dict.fromkeys(columns), "state": f"refused: {found.reason}"}


def row(member: Member):
    """The row of a member: left_s is the expected CPU time (s) of what is left, 0 when it is finished."""
    record = own_record(member)
    time = min(record.get("time_us") or 0.0, member.end)
    finished = work_left(member) == FINISHED
    left = 0.0 if finished else expected_seconds(member, member.end) - expected_seconds(member, time)
    return {
        "run": member.name,
        "engine": member.engine,
        "case": member.case.stem,
        "settings": " ".join(member.settings),
        "end_us": member.end,
        "state": ended_as(record) or "not run",
        "time_us": time,
        "steps": record.get("steps", {}).get("accepted"),
        "cpu_s": record.get("cpu_s"),
        "git": record.get("provenance", {}).get("git"),
        "left_s": round(left),
    }


def own_record(member):
    """run.json of the member's directory; {} if that holds no run, or one of other parameters."""
    record = read_record(member.directory)
    if record is None or record.get("engine") != member.engine:
        return {}
    differing = differing_parameters(record["parameters"], member.parameters, member.engine)
    return record if covers(record, member) or differing in ([], ["time.end"]) else {}
