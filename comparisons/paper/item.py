"""What an item of the paper is made of: runs, or branches of stationary shapes by `endoflow statics`."""

import math
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import endoflow
from comparisons import ROOT
from comparisons.errors import RUN_FAILED, StudyError
from comparisons.studies.members import program
from endoflow.errors import last_word

BOUNDARY_INTEGRAL, PHASE_FIELD = "boundary-integral", "phase-field"

#: The exit_reason of a run whose neck closed.
NECK_CLOSED = "neck-closed"

#: `--quick`: the time (µs) a phase-field run is followed. Its layer is the paper's: a thicker one saves no time, because the cells
#: are those of the patch's edge, 1.2 nm wide, and with ε = 1.7 or 2.4 nm the steps shrink from 0.1 µs on.
QUICK_END = 0.5


@dataclass(frozen=True)
class Wanted:
    """A run. name: within its item; case: a file's stem in cases/; settings: {"section.key": text}; end: µs."""

    name: str
    engine: str
    case: str
    settings: dict = field(hash=False)
    end: float


@dataclass(frozen=True)
class NotRun:
    """Why there is no run."""

    reason: str


@dataclass(frozen=True)
class Printed:
    """A statement of the paper beside ours; ours: {engine name or "": text}."""

    what: str
    paper: str
    ours: dict


@dataclass(frozen=True)
class Result:
    """What an item shows.

    rows: for the CSV file, list of {column: value}; figures: {name: (title, matplotlib Figure)};
    printed: list of Printed; remarks: sentences on what differs and why, to which the page adds the runs that are missing.
    """

    rows: list
    figures: dict
    printed: list
    remarks: list


def both_engines(name, case, settings, end, quick, quick_end=QUICK_END, quick_settings=None):
    """The run of each engine; with `quick` the phase field ends at quick_end, with quick_settings in addition."""
    diffuse = {**settings, **(quick_settings or {})} if quick else settings
    return [
        Wanted(name, BOUNDARY_INTEGRAL, case, settings, end),
        Wanted(name, PHASE_FIELD, case, diffuse, min(end, quick_end) if quick else end),
    ]


def is_run(found):
    """Whether there is a run to look at; None is one that was not asked for."""
    return found is not None and not isinstance(found, NotRun)


def ended_as(record):
    """Why the run of a run.json ended, or else its state; None of an empty one."""
    return record.get("exit_reason") or record.get("state")


def state_of(found):
    """How a run ended, that it has not, or why there is none."""
    if found is None:
        return "not asked for"
    return ended_as(found.record) if is_run(found) else f"not run: {found.reason}"


def last_time(run):
    """Time (µs) a run reached."""
    return float(run.shape_times[-1])


def end_of(run):
    """Time (µs) a run's history reached."""
    return float(run.history["time_us"][-1])


def value_at(run, column, time):
    """A history column at a time (µs); None where it does not exist, the run ended before, or there is none to look at."""
    if not is_run(run):
        return None
    end = end_of(run)
    value = float(run.history_at(column, min(time, end))) if time <= end * (1 + 1e-9) else math.nan
    return value if math.isfinite(value) else None


def final_value(run, column):
    """A history column's last value; None where it does not exist."""
    return value_at(run, column, end_of(run))


def text(value, digits=4, unit=""):
    """A number as text, a dash for None."""
    return "–" if value is None else f"{value:.{digits}g}" + (f" {unit}" if unit else "")


def filled(rows):
    """The rows with the columns of the longest one, None where a row has none."""
    columns = max(rows, key=len)
    return [{column: row.get(column) for column in columns} for row in rows]


def quick_remark(quick):
    """The sentence every item with quick phase-field runs shows."""
    if not quick:
        return []
    return [
        f"Quick: the phase-field runs have the paper's layer, but with flow they end at {QUICK_END:g} µs, before budding; they show "
        "that the engine does the case, and how far it is from the sharp one until then."
    ]


def not_run_remarks(runs):
    """One sentence for each run that is missing."""
    return [
        f"{name}, {engine}: {state_of(found)}"
        for name, engines in runs.items()
        for engine, found in engines.items()
        if not is_run(found)
    ]


@dataclass(frozen=True)
class Branch:
    """columns: {name: array} of its rows, in the branch's order; folds: values of the key there; ended: why it ends.

    work: of held necks, run.json's notes.held_neck.
    """

    columns: dict
    folds: list
    ended: str
    work: dict = field(default_factory=dict)


def followed(case, key, end, settings):
    """The Branch of cases/CASE.toml with settings {section.key: text} in a key, to its value `end`. Raises StudyError."""
    return branch_by(case, ["--continue-in", f"{key}={end:g}"], settings)


def held(case, first, last, settings):
    """The Branch of shapes whose neck is held from a radius ("open" or text of a number, nm) to another. Raises StudyError."""
    return branch_by(case, ["--hold", f"neck_radius={first}:{last}"], settings)


def branch_by(case, request, settings):
    """The Branch that `endoflow statics` makes of a request, options of its command line. Raises StudyError."""
    with tempfile.TemporaryDirectory() as scratch:
        directory = Path(scratch) / "branch"
        words = [str(program()), "statics", str(ROOT / "cases" / f"{case}.toml"), "-o", str(directory)]
        for name, value in settings.items():
            words += ["--set", f"{name}={value}"]
        done = subprocess.run([*words, *request], capture_output=True, text=True, check=False)
        if not (directory / "run.json").exists() or done.returncode not in (0, RUN_FAILED):
            raise StudyError(last_word(done.stderr), RUN_FAILED)
        run = endoflow.load(directory)
    notes = run.record["notes"].get("branch")
    if notes is None:
        raise StudyError(last_word(done.stderr), RUN_FAILED)
    folds = [fold["value"] for fold in notes["folds"]]
    return Branch(dict(run.history), folds, notes["ended_because"], run.record["notes"].get("held_neck", {}))
