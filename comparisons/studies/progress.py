"""The line that says how far all members of a study are."""

import shutil
import sys
import time

from comparisons.studies.member_runner import FAILED, FINISHED, INTERRUPTED, simulated_time

#: Seconds between two updates of the line on a terminal.
UPDATE_INTERVAL = 0.5


class Progress:
    """Callable for member_runner.run_all: one live line on a terminal, a new line at each change otherwise."""

    def __init__(self, total, already_done, parallel, stream=None):
        self.total, self.already_done, self.parallel = total, already_done, parallel
        self.stream = stream or sys.stdout
        self.live = self.stream.isatty()
        self.durations, self.known = [], {}
        self.counts, self.updated = None, 0.0

    def __call__(self, running, outcomes):
        now = time.time()
        for one in running:
            self.known[one.task.member.name] = one.started
        for name in [name for name in self.known if name in outcomes]:
            started = self.known.pop(name)
            if outcomes[name].state == FINISHED:
                self.durations.append(now - started)
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
        advances = [fraction(one) for one in running]
        if advances:
            parts[1] += " (" + ", ".join(f"{100 * reached:.0f} %" for _, reached in advances[:8]) + ")"
        waiting = self.total - self.already_done - len(running) - len(outcomes)
        left = remaining([(now - o.started, a) for o, (a, _) in zip(running, advances)], waiting, self.durations)
        if running or waiting:
            parts.append("ETA –" if left is None else f"ETA {duration(left / min(self.parallel, len(running) or 1))}")
        return ", ".join(parts)

    def _show(self, text):
        width = shutil.get_terminal_size().columns - 1
        self.stream.write("\r" + text[:width].ljust(width) if self.live else text + "\n")
        self.stream.flush()

    def finish(self):
        """End the live line."""
        if self.live and self.counts is not None:
            self.stream.write("\n")


def fraction(one):
    """(done since its start, done in all) of a running member, as fractions of the simulated time."""
    end, start = one.task.member.end, one.start_time
    now = max(start, simulated_time(one.task.member.directory, one.started))
    return (now - start) / (end - start) if end > start else 0.0, now / end if end > 0 else 0.0


def remaining(running, waiting, durations):
    """Seconds of work left, None while nothing is known.

    running: [(elapsed s, fraction done)], waiting: number of members, durations: s of those that ended.
    """
    totals = [elapsed / done for elapsed, done in running if done > 1e-3]
    known = totals + list(durations)
    if not known:
        return None
    mean = sum(known) / len(known)
    left = [max(0.0, (elapsed / done if done > 1e-3 else mean) - elapsed) for elapsed, done in running]
    return sum(left) + waiting * mean


def duration(seconds):
    """A duration in words: "42 s", "3 min", "5.1 h"."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
