"""The runs that items of the paper want: equal ones are one run, in a directory named by case and settings; their table, runs.csv."""

import hashlib
from dataclasses import replace
from pathlib import Path

import endoflow
from comparisons import ROOT
from comparisons.errors import StudyError
from comparisons.paper import item_module
from comparisons.paper.item import NotRun, ended_as
from comparisons.studies.members import (
    FINISHED,
    checked_member,
    covers,
    differing_parameters,
    directory_name,
    load_run,
    read_record,
    settings_of,
    work_left,
)
from comparisons.studies.progress import duration, expected_seconds
from comparisons.studies.ranges import RangeError

#: Bytes; programs and archives append words of their own.
LONGEST_NAME = 200


class WantedRuns:
    """What is to be run for some items. options: of the command line; output: its directory (Path).

    members: {member name: members.Member, or item.NotRun with what is wrong with its parameters}.
    """

    def __init__(self, items, options, output):
        #: {(item, run's name, engine): member name}, None where an engine was not asked for.
        self.asked = {}
        ends, first, own = {}, {}, own_settings(options)
        for item in items:
            for wanted in item_module(item).wanted(options.quick):
                if options.engine not in (wanted.engine, "both"):
                    self.asked[item, wanted.name, wanted.engine] = None
                    continue
                settings = {**wanted.settings, **own}
                directory = directory_of(wanted, settings)
                name = str(directory.relative_to("runs"))
                self.asked[item, wanted.name, wanted.engine] = name
                end = wanted.end if options.until is None else min(wanted.end, options.until)
                ends[name] = max(end, ends.get(name, 0.0))
                first.setdefault(name, (replace(wanted, settings=settings), output / directory))
        self.members = {name: member_of(name, *first[name], ends[name]) for name in first}

    def runs_of(self, item, found):
        """{name: {engine: endoflow.Run or item.NotRun}} of an item; found: {member name: one of the two}."""
        runs = {}
        for (owner, name, engine), member in self.asked.items():
            if owner == item:
                engines = runs.setdefault(name, {})
                if member is not None:
                    engines[engine] = found[member]
        return runs


def own_settings(options):
    """{section.key: text} of the command line's --set."""
    pairs = [text.partition("=") for text in options.set]
    bad = [key for key, equals, _ in pairs if not equals or key.count(".") != 1]
    if bad:
        raise RangeError(f"--set {bad[0]}: it must read section.key=value")
    return {key: value for key, _, value in pairs}


def directory_of(wanted, settings):
    """Relative directory of a run: case and settings, then the engine."""
    words = [wanted.case, *([directory_name(settings).replace("/", ",")] if settings else [])]
    return Path("runs") / short_enough(",".join(words)) / wanted.engine


def short_enough(name):
    """A file's name that file systems take, which end at 255 bytes: a long one ends in a digest of the whole."""
    if len(name.encode()) <= LONGEST_NAME:
        return name
    digest = hashlib.sha256(name.encode()).hexdigest()[:12]
    return f"{name.encode()[: LONGEST_NAME - 13].decode(errors='ignore')},{digest}"


def member_of(name, wanted, directory, end):
    """The members.Member of a run, or item.NotRun. A run that is there and went on longer is taken as it is."""
    case = ROOT / "cases" / f"{wanted.case}.toml"

    def member_to(time):
        settings = (*settings_of(wanted.settings), f"time.end={time:.12g}")
        return checked_member(name, case, directory, wanted.engine, settings, wanted.settings)

    try:
        member = member_to(end)
        record = read_record(directory)
        if record and differing_parameters(record["parameters"], member.parameters, wanted.engine) == ["time.end"]:
            member = member_to(max(end, record["parameters"]["time"]["end"]))
        return member
    except StudyError as error:
        return NotRun(str(error))


def found_run(member, outcome):
    """The endoflow.Run of a Member, or item.NotRun; outcome: of its run (member_runner.Outcome), None if it was not run now."""
    if isinstance(member, NotRun):
        return member
    if outcome is None and read_record(member.directory) is None:
        return NotRun(f"not run yet, about {duration(expected_seconds(member, member.end))} for one core")
    message = outcome.message if outcome is not None else ""
    try:
        run = load_run(member)
    except (endoflow.EndoflowError, StudyError) as error:
        return NotRun(message or str(error))
    failed = outcome is not None and outcome.state == "failed"
    return NotRun(message) if failed and len(run.shapes) < 2 else run


def run_rows(members):
    """The rows of runs.csv: one for each of {name: members.Member or item.NotRun}."""
    return [refused_row(name, one) if isinstance(one, NotRun) else run_row(one) for name, one in members.items()]


def refused_row(name, found):
    """The row of a run that cannot be made."""
    columns = ("engine", "case", "settings", "end_us", "state", "time_us", "steps", "cpu_s", "git", "left_s")
    return {"run": name, **dict.fromkeys(columns), "state": f"refused: {found.reason}"}


def run_row(member):
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
