"""How far a study is: what its runs are expected to cost, and the line that says how far all of them are.

Seconds of CPU time on a core of 2024, from runs that were measured; the present machine's speed corrects them. Sharp engine: 11 s to
20 µs. Scheme production: 430 s to 1.2 µs, and as ε^-1.55. Scheme paper: by steps and unknowns. docs/results/standard-case.md has what
runs cost today.
"""

import math
import shutil
import sys
import time

from comparisons.studies.member_runner import FAILED, FINISHED, INTERRUPTED, simulated_time, start_time

#: Seconds to REFERENCE_TIME (µs), and the power of the time they grow with: steps are short at first.
SHARP, PRODUCTION, REFERENCE_TIME = (11.0, 0.54), (1100.0, 0.35), 20.0

#: Scheme production: layer (nm) of the measured run, and the power of ε.
LAYER, LAYER_POWER = 1.2, -1.55

#: Scheme paper: seconds per step and thousand unknowns, and their power.
PER_STEP, UNKNOWNS_POWER = 0.010, 1.15

#: Unknowns of scheme paper in a layer (nodes of u, λ, φ, g, f of a cell of size h) along a membrane of about this length (nm).
MEMBRANE = 110.0

#: Seconds between two updates of the line on a terminal.
UPDATE_INTERVAL = 0.5


def expected_seconds(member, time):
    """Seconds that a member (members.Member) takes to a simulated time (µs)."""
    if member.engine == "boundary-integral":
        seconds, power = SHARP
        return seconds * (time / REFERENCE_TIME) ** power
    numerics = member.parameters.get("phase_field", {})
    if numerics.get("scheme") == "paper":
        own = numerics.get("paper", {})
        return steps(member.parameters.get("time", {}), own, time) * seconds_per_step(numerics)
    seconds, power = PRODUCTION
    thinner = (numerics.get("epsilon", LAYER) / LAYER) ** LAYER_POWER
    return seconds * thinner * (time / REFERENCE_TIME) ** power


def steps(times, paper, end):
    """Steps of scheme paper's ramp from 0 to `end` (µs): they double every ramp_steps up to max_step."""
    step = times.get("initial_step") or 1e-5
    longest, each = paper.get("max_step", 2e-3), paper.get("ramp_steps", 10)
    taken, time = 0.0, 0.0
    while step < longest and time + each * step < end:
        taken, time, step = taken + each, time + each * step, 2 * step
    return taken + max(0.0, end - time) / min(step, longest)


def seconds_per_step(numerics):
    """Seconds of a step of scheme paper."""
    epsilon = numerics.get("epsilon", LAYER)
    h = numerics.get("cell_size") or 1.04 * epsilon
    cells = MEMBRANE * 2 * (numerics.get("band_width") or 4.5) * epsilon / h**2
    nodes = numerics.get("degree", 3) ** 2 * 6.3
    return PER_STEP * (1e-3 * cells * nodes) ** UNKNOWNS_POWER


def remaining_seconds(running, waiting, ended):
    """Seconds of work left; None while nothing is known of this machine's speed.

    running: [(elapsed s, expected s of what it has done, expected s of what is left)], waiting: [expected s],
    ended: [(elapsed s, expected s)].
    """
    known = [(elapsed, done) for elapsed, done, left in running if done > 1e-3 * (done + left)] + list(ended)
    spent, expected = (sum(one) for one in zip(*known)) if known else (0.0, 0.0)
    if not math.isfinite(expected) or expected <= 0:
        return None
    return spent / expected * (sum(left for _, _, left in running) + sum(waiting))


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
