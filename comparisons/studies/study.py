"""Runs the members of a study in its directory, with messages."""

import contextlib
import fcntl
import os
import shutil
import sys
from pathlib import Path

from comparisons.errors import BAD_INPUT, IO_FAILURE, StudyError
from comparisons.files import shown


def program():
    """The endoflow that started this script."""
    found = os.environ.get("ENDOFLOW_PROGRAM")
    if not found:
        raise StudyError("start this as a command of endoflow, or name that program in ENDOFLOW_PROGRAM", BAD_INPUT)
    return Path(found)


@contextlib.contextmanager
def lock(directory):
    """Make the directory (Path) and keep other studies out of it; a study that is refused leaves none behind."""
    new = not directory.exists()
    directory.mkdir(parents=True, exist_ok=True)
    with open(directory / ".lock", "w", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            message = f"{directory}: another study is at work here; wait, or choose another -o"
            raise StudyError(message, IO_FAILURE) from None
        try:
            yield
        finally:
            if new and [entry.name for entry in directory.iterdir()] == [".lock"]:
                shutil.rmtree(directory)


def run_members(members, options, interruption):
    """Run what is left of the members; returns {member name: Outcome} of those that were run."""
    from comparisons.studies.member_runner import Task, available_cores, member_environment, run_all, shares
    from comparisons.studies.members import CONTINUE, FINISHED, run_command, work_left
    from comparisons.studies.progress import Progress, duration

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
    progress = Progress(tasks, done, parallel)
    if tasks:
        seconds = sum(progress.expected(task.member.name) for task in tasks)
        print(f"about {duration(seconds)} of work for one core, by runs that were measured", flush=True)
    outcomes = run_all(tasks, parallel, member_environment(threads), progress, interruption)
    progress.finish()
    return outcomes


def report_failures(command, outcomes):
    """One line on stderr for each failed member; returns their number."""
    failed = {name: outcome.message for name, outcome in outcomes.items() if outcome.state == "failed"}
    for name, message in failed.items():
        print(f"endoflow {command}: {name}: {shown(message)}", file=sys.stderr)
    return len(failed)
