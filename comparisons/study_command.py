"""What the commands that run many members share: options, running the members, messages."""

import argparse
import contextlib
import fcntl
import os
import sys
from pathlib import Path

from commands import BAD_INPUT, IO_FAILURE, positive_integer


def study_parser(study, description, output):
    """Parser of `endoflow STUDY` with the options every study has; output: what -o defaults to, for the help."""
    parser = argparse.ArgumentParser(
        prog=f"endoflow {study}",
        description=description,
        allow_abbrev=False,
        epilog="Finished runs are not repeated and interrupted ones are continued when the command is given again.",
    )
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help=f"where to write (default: {output})")
    parser.add_argument(
        "--set", metavar="section.key=value", action="append", default=[], help="for every run; may be repeated"
    )
    parser.add_argument("--jobs", metavar="N", type=positive_integer, help="most runs at a time (default: all cores)")
    parser.add_argument(
        "--processes",
        metavar="N",
        type=positive_integer,
        default=1,
        help="MPI processes of each phase-field run (default: 1)",
    )
    return parser


def case_parser(study, description):
    """Parser of a study of one case."""
    parser = study_parser(study, description, f"out/CASE/{study}")
    parser.add_argument("case", metavar="CASE.toml", type=Path, help="case file")
    parser.add_argument("--until", metavar="T", help="time.end in µs")
    return parser


def common_settings(options):
    """The settings of every member, in the order in which they override the case file."""
    return [*options.set, *([f"time.end={options.until}"] if options.until else [])]


def output_directory(options, study):
    """Where the study of a case is written."""
    return options.output or Path("out") / options.case.stem / study


def program():
    """The endoflow that started this script."""
    from members import StudyError

    found = os.environ.get("ENDOFLOW_PROGRAM")
    if not found:
        raise StudyError("start this as a command of endoflow, or name that program in ENDOFLOW_PROGRAM", BAD_INPUT)
    return Path(found)


@contextlib.contextmanager
def lock(directory):
    """Make the directory (Path) and keep other studies out of it."""
    from members import StudyError

    directory.mkdir(parents=True, exist_ok=True)
    with open(directory / ".lock", "w", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            message = f"{directory}: another study is at work here; wait, or choose another -o"
            raise StudyError(message, IO_FAILURE) from None
        yield


def run_members(members, options, interruption):
    """Run what is left of the members; returns {member name: Outcome} of those that were run."""
    from member_runner import Task, available_cores, member_environment, run_all, shares
    from members import CONTINUE, FINISHED, run_command, work_left
    from progress import Progress

    processes = max([options.processes if member.engine == "phase-field" else 1 for member in members], default=1)
    parallel, threads = shares(available_cores(), options.jobs, processes)
    if options.jobs and parallel < options.jobs:
        cores = available_cores()
        print(f"{parallel} run(s) at a time: {processes} process(es) for each, and there are {cores} cores", flush=True)
    work = {member.name: work_left(member) for member in members}
    # Without it, every mpirun would bind its processes to the same first cores.
    mpirun = ("mpirun", "--bind-to", "none") if parallel > 1 else ("mpirun",)
    tasks = [
        Task(member, run_command(program(), member, work[member.name], options.processes, mpirun))
        for member in members
        if work[member.name] != FINISHED
    ]
    done, continued = len(members) - len(tasks), list(work.values()).count(CONTINUE)
    known = [f"{done} finished before"] * (done > 0) + [f"{continued} to be continued"] * (continued > 0)
    print(f"{len(members)} run(s)" + "".join(f", {text}" for text in known), flush=True)
    progress = Progress(len(members), done, parallel)
    outcomes = run_all(tasks, parallel, member_environment(threads), progress, interruption)
    progress.finish()
    return outcomes


def report_failures(command, outcomes):
    """One line on stderr for each failed member; returns their number."""
    failed = {name: outcome.message for name, outcome in outcomes.items() if outcome.state == "failed"}
    for name, message in failed.items():
        print(f"endoflow {command}: {name}: {message}", file=sys.stderr)
    return len(failed)
