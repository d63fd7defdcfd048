"""Runs members in parallel: one failure does not stop the others, an interruption lets all write their checkpoints."""

import contextlib
import os
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from comparisons.studies.members import read_record
from endoflow.errors import last_word
from endoflow.history import time_reached

#: Seconds between two looks at the running members.
POLL_INTERVAL = 0.1

#: File in a member's directory: all that a run wrote to stderr which failed, the launcher's words included.
ERRORS = "errors.txt"

#: Variables that limit a process's threads.
THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")

FINISHED, FAILED, INTERRUPTED, WAITING = "finished", "failed", "interrupted", "waiting"


@dataclass(frozen=True)
class Task:
    """A member (members.Member) and the command line that runs it."""

    member: object
    command: list


@dataclass(frozen=True)
class Outcome:
    """How a member ended: FINISHED, FAILED, INTERRUPTED or WAITING (never started); message: one line, or ""."""

    state: str
    message: str = ""


@dataclass
class Running:
    """A member that runs. started: time.time() in s; start_time: simulated time (µs) it started from."""

    task: Task
    process: subprocess.Popen
    errors: object
    started: float
    start_time: float


class Interruption:
    """Counts SIGINT, SIGTERM and SIGHUP while it is the context; `signal` is the first one's number, 0 without any.

    Members are in sessions of their own: a terminal that is closed would leave them running behind a study that is gone.
    """

    def __init__(self):
        self.signal, self.count = 0, 0

    def __enter__(self):
        self._before = {number: signal.signal(number, self._note) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
        return self

    def __exit__(self, *_):
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _note(self, number, _frame):
        self.signal, self.count = self.signal or number, self.count + 1


def shares(cores, jobs, processes):
    """(parallel members, threads of each process) such that members × processes × threads does not exceed the cores.

    jobs: wanted members in parallel, None for as many as fit.
    """
    fitting = max(1, cores // processes)
    parallel = fitting if jobs is None else min(jobs, fitting)
    return parallel, max(1, cores // (parallel * processes))


def available_cores():
    """Cores this process may use."""
    return len(os.sched_getaffinity(0))


def member_environment(threads):
    """This process's environment with at most `threads` threads for each process of a member."""
    limits = {}
    for name in THREAD_VARIABLES:
        own = os.environ.get(name, "")
        limits[name] = str(min(int(own), threads) if own.isdigit() and int(own) > 0 else threads)
    return {**os.environ, **limits}


def run_all(tasks, parallel, environment, progress, interruption):
    """Run Tasks, `parallel` at a time; returns {member name: Outcome}.

    progress(running, outcomes) is called at every look. interruption: an entered Interruption; the first signal makes
    the members stop at their next step (SIGINT), the second kills them.
    """
    waiting, running, outcomes, heard = list(tasks), [], {}, 0
    while waiting or running:
        if interruption.count > heard:
            _signal_all(running, signal.SIGKILL if heard else signal.SIGINT)
            heard = interruption.count
        if interruption.count:
            outcomes.update({task.member.name: Outcome(WAITING) for task in waiting})
            waiting.clear()
        while waiting and len(running) < parallel:
            task = waiting.pop(0)
            try:
                running.append(_started(task, environment))
            except OSError as error:
                outcomes[task.member.name] = Outcome(FAILED, f"{task.command[0]}: {error.strerror}")
        ended = [one for one in running if one.process.poll() is not None]
        running = [one for one in running if one not in ended]
        outcomes.update({one.task.member.name: _outcome(one, interruption.count > 0) for one in ended})
        progress(running, outcomes)
        if running and not ended:
            time.sleep(POLL_INTERVAL)
    return outcomes


def _started(task, environment):
    """Start a member in a session of its own, so that the terminal's Ctrl-C reaches it only through us."""
    errors = tempfile.TemporaryFile()
    with contextlib.suppress(OSError):
        (task.member.directory / ERRORS).unlink(missing_ok=True)
    process = subprocess.Popen(
        task.command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=errors,
        env=environment,
        start_new_session=True,
    )
    return Running(task, process, errors, time.time(), start_time(task))


def _outcome(one, interrupted):
    """How an ended member ended."""
    one.errors.seek(0)
    text = one.errors.read().decode("utf-8", "replace")
    one.errors.close()
    code = one.process.returncode
    record = read_record(one.task.member.directory) or {}
    if code == 0 and record.get("state") == "finished":
        return Outcome(FINISHED)
    if interrupted and (record.get("state") == "interrupted" or code in (-signal.SIGINT, -signal.SIGKILL, 130)):
        return Outcome(INTERRUPTED)
    if text:
        _keep_errors(one.task.member.directory, text)
    if code < 0:
        return Outcome(FAILED, f"ended by {signal.Signals(-code).name}; run the study again to continue it")
    return Outcome(FAILED, last_word(text) or f"ended with exit code {code} and without a finished run.json")


def _keep_errors(directory, text):
    """Leave what a failed run wrote to stderr in its directory (Path), which need not be there yet."""
    with contextlib.suppress(OSError):  # the failure itself is reported
        directory.mkdir(parents=True, exist_ok=True)
        (directory / ERRORS).write_text(text, encoding="utf-8")


def _signal_all(running, number):
    """Signal the processes at the bottom of every member's tree: mpirun itself would not let its children finish."""
    children = _children()
    for one in running:
        for pid in _leaves(one.process.pid, children):
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.kill(pid, number)


def _children():
    """{parent's id: [ids]} of every process, from /proc."""
    children = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError, ValueError, IndexError):
            fields = stat.read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
            children.setdefault(int(fields[1]), []).append(int(stat.parent.name))
    return children


def _leaves(pid, children):
    """Ids of the descendants of a process that have no children; the process itself when it has none."""
    below = children.get(pid, [])
    return [leaf for child in below for leaf in _leaves(child, children)] if below else [pid]


def start_time(task):
    """Simulated time (µs) at which a task starts: where its member's run was interrupted, or 0."""
    return simulated_time(task.member.directory) if "--restart" in task.command else 0.0


def simulated_time(directory, since=0.0):
    """Time (µs) of the last complete row of a member's history.csv; 0 before the first.

    A file older than `since` (time.time() in s) belongs to an earlier run and counts as none.
    """
    path = directory / "history.csv"
    try:
        return time_reached(path) if path.stat().st_mtime >= since else 0.0
    except OSError:
        return 0.0
