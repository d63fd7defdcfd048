"""The line that says how far all members of a study are."""

import shutil
import sys
import time

from comparisons.studies.cost import expected_seconds, remaining_seconds
from comparisons.studies.member_runner import FAILED, FINISHED, INTERRUPTED, simulated_time, start_time

#: Seconds between two updates of the line on a terminal.
UPDATE_INTERVAL = 0.5


class Progress:
    """Callable for member_runner.run_all: one live line on a terminal, a new line at each change otherwise.

    tasks: what is run (member_runner.Task); already_done: number of other members.
    """

    def __init__(self, tasks, already_done, parallel, stream=None):
        self.members = {task.member.name: (task.member, start_time(task)) for task in tasks}
        self.total, self.already_done, self.parallel = len(tasks) + already_done, already_done, parallel
        self.stream = stream or sys.stdout
        self.live = self.stream.isatty()
        self.ended, self.known = [], {}
        self.counts, self.updated = None, 0.0

    def __call__(self, running, outcomes):
        now = time.time()
        for one in running:
            self.known[one.task.member.name] = one.started
        for name in [name for name in self.known if name in outcomes]:
            started = self.known.pop(name)
            if outcomes[name].state == FINISHED:
                self.ended.append((now - started, self.expected(name)))
        counts = (len(running), len(outcomes))
        if counts == self.counts and not (self.live and now > self.updated + UPDATE_INTERVAL):
            return
        self.counts, self.updated = counts, now
        self._show(self.text(running, outcomes, now))

    def text(self, running, outcomes, now):
        """The line."""
        states = [outcome.state for outcome in outcomes.values()]
        parts = [f"{self.already_done + states.count(FINISHED)} of {self.total} done", f"{len(running)} running"]
        parts += [f"{states.count(s)} {s}" for s in (FAILED, INTERRUPTED) if s in states]
        advances = [(one, one.task.member, reached(one)) for one in running]
        if advances:
            percent = [100 * time / member.end if member.end > 0 else 0.0 for _, member, time in advances[:8]]
            parts[1] += " (" + ", ".join(f"{one:.0f} %" for one in percent) + ")"
        names = {member.name for _, member, _ in advances}
        waiting = [name for name in self.members if name not in names and name not in outcomes]
        left = remaining_seconds(
            [
                (now - one.started, work(member, one.start_time, time), work(member, time, member.end))
                for one, member, time in advances
            ],
            [self.expected(name) for name in waiting],
            self.ended,
        )
        if running or waiting:
            parts.append("ETA –" if left is None else f"ETA {duration(left / min(self.parallel, len(running) or 1))}")
        return ", ".join(parts)

    def expected(self, name):
        """Expected seconds of a member's whole task."""
        member, start = self.members[name]
        return work(member, start, member.end)

    def _show(self, text):
        width = shutil.get_terminal_size().columns - 1
        self.stream.write("\r" + text[:width].ljust(width) if self.live else text + "\n")
        self.stream.flush()

    def finish(self):
        """End the live line."""
        if self.live and self.counts is not None:
            self.stream.write("\n")


def reached(one):
    """Simulated time (µs) a running member has reached."""
    return max(one.start_time, simulated_time(one.task.member.directory, one.started))


def work(member, start, end):
    """Expected seconds from one simulated time (µs) to another."""
    return max(0.0, expected_seconds(member, end) - expected_seconds(member, start)) if end > start else 0.0


def duration(seconds):
    """A duration in words: "42 s", "3 min", "5.1 h"."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
