"""A study: many runs of one case, what they say, and the page it stands on."""

import contextlib
import fcntl
import shutil
import sys

from comparisons.errors import IO_FAILURE, RUN_FAILED, StudyError, shown
from comparisons.studies.member_runner import FAILED, Interruption, Task, available_cores, member_environment, run_all, shares
from comparisons.studies.members import CONTINUE, FINISHED, program, run_command, work_left
from comparisons.studies.progress import Progress, duration


class Interrupted(Exception):
    """A signal stopped the runs; the same command continues."""


class Study:
    """Many runs in a directory that no other study touches meanwhile. A kind of study says

        members()           the runs to begin with (members.Member), their parameters checked
        evaluate(outcomes)  what they say, after its tables are written; it may run() more
        page(found)         writes plots and report.html; returns the lines that the terminal shows

    options: the command line, with `jobs` and `processes`; output: Path. `failed` counts runs that failed.
    """

    #: What the command is called in messages.
    command = ""

    #: Whether a run that fails is a result like others.
    failures_are_results = False

    def __init__(self, options, output):
        self.options, self.output = options, output
        self.interruption, self.failed = Interruption(), 0

    def members(self):
        """None: an evaluation decides itself what to run."""
        return []

    def conduct(self):
        """Run, evaluate, write the page; returns the exit code."""
        members = self.members()
        with lock(self.output):
            try:
                with self.interruption:
                    found = self.evaluate(self.run(members) if members else {})
            except Interrupted:
                print(f"endoflow {self.command}: interrupted; the same command continues", file=sys.stderr)
                return 128 + self.interruption.signal
            for line in self.page(found):
                print(line)
        return RUN_FAILED if self.failed else 0

    def run(self, members):
        """Run what is left of the members; returns {member name: Outcome} of those that were run. Raises Interrupted."""
        processes = max([self.options.processes if member.engine == "phase-field" else 1 for member in members], default=1)
        parallel, threads = shares(available_cores(), self.options.jobs, processes)
        work = {member.name: work_left(member) for member in members}
        # Without it, every mpirun would bind its processes to the same first cores.
        mpirun = ("mpirun", "--bind-to", "none") if parallel > 1 else ("mpirun",)
        tasks = [
            Task(member, run_command(program(), member, work[member.name], self.options.processes, mpirun))
            for member in members
            if work[member.name] != FINISHED
        ]
        progress = Progress(tasks, len(members) - len(tasks), parallel)
        if self.options.jobs and parallel < self.options.jobs:
            cores = f"{processes} process(es) for each, and there are {available_cores()} cores"
            self.say(f"{parallel} run(s) at a time: {cores}")
        self.announce(list(work.values()), sum(progress.expected(task.member.name) for task in tasks))
        outcomes = run_all(tasks, parallel, member_environment(threads), progress, self.interruption)
        progress.finish()
        if self.interruption.signal:
            self.stopped(members, outcomes)
        self.stop_if_interrupted()
        if not self.failures_are_results:
            self.report_failures(outcomes)
        return outcomes

    def announce(self, work, seconds):
        """Say what is left of runs: how much of each (members.work_left), and what that is expected to take, s."""
        done, continued = work.count(FINISHED), work.count(CONTINUE)
        known = [f"{done} finished before"] * (done > 0) + [f"{continued} to be continued"] * (continued > 0)
        self.say(", ".join([f"{len(work)} run(s)", *known]))
        if done < len(work):
            self.say(f"about {duration(seconds)} of work for one core, by runs that were measured")

    def say(self, text):
        """A line on the terminal while the study is at work."""
        print(text, flush=True)

    def warn(self, texts):
        """One line on stderr for each text."""
        for text in texts:
            print(f"endoflow {self.command}: warning: {shown(text)}", file=sys.stderr)

    def stopped(self, members, outcomes):
        """What is still written after an interruption: nothing."""

    def stop_if_interrupted(self):
        """Raises Interrupted after a signal."""
        if self.interruption.signal:
            raise Interrupted

    def report_failures(self, outcomes):
        """One line on stderr for each failed member."""
        for name, outcome in outcomes.items():
            if outcome.state == FAILED:
                self.failed += 1
                print(f"endoflow {self.command}: {name}: {shown(outcome.message)}", file=sys.stderr)


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
