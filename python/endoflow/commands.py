"""The program's commands as functions: run, statics, sweep, compare, infer."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any, Iterable, Mapping, Union

from .cases import Case, case_file, case_name, literal, settings
from .program import call
from .progress import Progress
from .run_directory import Run, load

Directory = Union[str, Path]


def run(
    engine: str,
    case: Case = "",
    *,
    set: Mapping[str, Any] | None = None,
    until: float | None = None,
    output: Directory | None = None,
    processes: int = 1,
    restart: bool = False,
    progress: bool = True,
) -> Run:
    """Run a case with an engine, "boundary-integral" or "phase-field"; returns what load() makes of its directory.

    case: a path, the name of a case that comes with the program, TOML text ("" is the standard case) or a dict of sections;
    set: {"section.key": value} over the case; until: time.end in µs; output: the run's directory [out/CASE/ENGINE];
    processes: of MPI, phase field only; restart: continue from the checkpoint there. Raises InputError, SolverError or
    FileError with the program's words. A KeyboardInterrupt (a cancelled cell) stops the run with a checkpoint.
    """
    directory = Path(output) if output is not None else Path("out") / case_name(case) / engine
    with case_file(case) as file:
        arguments = ["run", engine, file, *settings(set), "-o", str(directory)]
        arguments += [] if until is None else ["--until", f"{until:.17g}"]
        arguments += ["--restart"] if restart else []
        bar = Progress(directory, progress)
        try:
            call(arguments, bar, ["mpirun", "-n", str(processes)] if processes > 1 else [])
        finally:
            bar.close()
    return load(directory)


def statics(
    case: Case = "",
    *,
    set: Mapping[str, Any] | None = None,
    continue_in: tuple[str, float] | None = None,
    output: Directory | None = None,
) -> Run:
    """The stationary shape of a case, or with continue_in=("section.key", end) all shapes from the case's value to `end`."""
    directory = Path(output) if output is not None else Path("out") / case_name(case) / "statics"
    with case_file(case) as file:
        arguments = ["statics", file, *settings(set), "-o", str(directory)]
        arguments += [] if continue_in is None else ["--continue-in", f"{continue_in[0]}={continue_in[1]:.17g}"]
        call(arguments)
    return load(directory)


def sweep(
    case: Case,
    vary: Mapping[str, Union[str, Iterable[Any]]],
    *,
    engine: str = "boundary-integral",
    set: Mapping[str, Any] | None = None,
    until: float | None = None,
    output: Directory | None = None,
    jobs: int | None = None,
    processes: int = 1,
) -> list[dict[str, Any]]:
    """Run a case with many values of some parameters; returns the rows of sweep.csv, numbers as float, empty cells None.

    vary: {"section.key": values or "first:last:step"}, all combinations; engine: also "both". Runs that are finished in
    `output` are not repeated. The key "directory" of a row is what load() takes.
    """
    directory = Path(output) if output is not None else Path("out") / case_name(case) / "sweep"
    with case_file(case) as file:
        arguments = ["sweep", file, "--engine", engine, "-o", str(directory), *settings(set)]
        for key, values in vary.items():
            text = values if isinstance(values, str) else ",".join(literal(value).strip('"') for value in values)
            arguments += ["--vary", f"{key}={text}"]
        arguments += [] if until is None else ["--until", f"{until:.17g}"]
        arguments += [] if jobs is None else ["--jobs", str(jobs)]
        arguments += ["--processes", str(processes)]
        call(arguments)
    with open(directory / "sweep.csv", newline="", encoding="utf-8", errors="surrogateescape") as table:
        return [{key: _value(cell) for key, cell in row.items()} for row in csv.DictReader(table)]


def compare(a: Union[Run, Directory], b: Union[Run, Directory], *, output: Directory = "comparison") -> dict[str, Any]:
    """Compare two runs (or their directories); returns metrics.json and leaves it with plots and report.html in `output`."""
    directories = [str(run.directory if isinstance(run, Run) else run) for run in (a, b)]
    call(["compare", *directories, "-o", str(output)])
    metrics: dict[str, Any] = json.loads((Path(output) / "metrics.json").read_text(encoding="utf-8"))
    return metrics


def infer(
    study: Directory,
    *,
    output: Directory | None = None,
    calibrate: int = 0,
    truth: Union[Run, Directory, None] = None,
    sensitivity: bool = False,
    jobs: int | None = None,
    processes: int = 1,
) -> dict[str, Any]:
    """Parameters from data: the study is a TOML file; returns infer.json and leaves it with plots and report.html in `output`.

    calibrate: as many cases with known truth as well, that of a run `truth` if given; sensitivity: Sobol indices as well. Runs that are finished in `output` [out/STUDY/infer]
    are not repeated.
    """
    directory = Path(output) if output is not None else Path("out") / Path(study).stem / "infer"
    arguments = ["infer", str(study), "-o", str(directory), "--processes", str(processes)]
    arguments += [] if jobs is None else ["--jobs", str(jobs)]
    arguments += ["--calibrate", str(calibrate)] if calibrate else []
    arguments += [] if truth is None else ["--truth", str(truth.directory if isinstance(truth, Run) else truth)]
    arguments += ["--sensitivity"] if sensitivity else []
    call(arguments)
    results: dict[str, Any] = json.loads((directory / "infer.json").read_text(encoding="utf-8"))
    return results


def _value(cell: str) -> Any:
    """A cell of a table."""
    try:
        return float(cell) if cell else None
    except ValueError:
        return cell
