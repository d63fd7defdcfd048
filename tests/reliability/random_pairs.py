"""Runs that meet: pairs of starts and restarts in one directory, with random ends, other keys and signals.

    python3 tests/reliability/random_pairs.py build/endoflow --pairs 200
    python3 tests/reliability/random_pairs.py build/endoflow --engine phase-field --pairs 40

Two commands are started in one directory at nearly the same time. Each starts or restarts a run of one of two problems, up to
a random end, with a random shape interval; half of them get a signal at a random time, those of several processes at mpirun or
at one of its children. Afterwards the directory must hold one run of one problem (history, shapes and run.json agree with the
uninterrupted run of that problem), what was there before must be continued or stand in earlier/, and each command must have
ended with the code that the documentation gives for what happened to it. After some pairs the directory's run is continued to
its end and compared again. Ends with 1 and says what is wrong, with the seed that repeats it.
"""

import argparse
import collections
import random
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import engines  # noqa: E402
import pairs_oracle as oracle  # noqa: E402
from kill_and_restart import SETTINGS, directory_of_runs  # noqa: E402

UNTIL = {"boundary-integral": 5e-4, "phase-field": 2e-4}
PATCHES = (18, 22)  # nm: two problems whose masses and energies differ by tens of per cent
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL)
PAIRS_OF_A_DIRECTORY = 8


@dataclass
class Command:
    """A start or restart, and what happened to it."""

    restart: bool
    patch: int
    end: float
    shape_interval: float
    delay: float = 0.0  # s, after the other one
    processes: int = 1
    signal: int = 0
    signal_delay: float = 0.0  # s, after its start
    at_child: bool = False  # of mpirun
    process: subprocess.Popen = None
    delivered: bool = False
    code: int = 0
    out: str = ""
    errors: str = ""
    pids: set = field(default_factory=set)

    def words(self, options, directory):
        settings = {
            **SETTINGS[options.engine],
            "molecules.patch_radius": self.patch,
            "molecules.interface_width": 5.5,
            "output.checkpoint_interval": 0,
            "output.field_interval": 0,
            "output.shape_interval": self.shape_interval,
            "time.end": self.end,
        }
        words = [options.program, "run", options.engine, "/dev/null", "-o", directory]
        words += engines.options(engines.texts(settings))
        words += ["--restart"] if self.restart else []
        return engines.launcher(self.processes) + [str(word) for word in words]

    def start(self, options, directory):
        self.process = subprocess.Popen(self.words(options, directory), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        text=True, start_new_session=True)
        self.pids.add(self.process.pid)

    def send(self):
        """The signal, to mpirun or to one of its children, if it is there still."""
        self.pids |= oracle.members_of_session(self.process.pid)
        if self.process.poll() is not None:
            return
        children = [pid for pid in oracle.members_of_session(self.process.pid) if oracle.is_engine(pid)]
        target = min(children) if self.at_child and children else self.process.pid
        self.at_child = target != self.process.pid
        self.delivered = oracle.send(target, self.signal)

    def describe(self):
        what = f"{'restart' if self.restart else 'start'} patch {self.patch} to {self.end:.3g}"
        where = f" on {self.processes}" if self.processes > 1 else ""
        whom = " (a child)" if self.at_child else ""
        sent = f", {signal.Signals(self.signal).name}{whom} after {self.signal_delay:.2f} s" if self.delivered else ""
        return f"{what}{where}{sent}: code {self.code}; {(self.errors or self.out).strip().splitlines()[-1:]}"


def random_command(options, generator, present, duration):
    """`present`: the patch of the run in the directory, None when there is none."""
    restart = present is not None and generator.random() < 0.6
    same = restart and generator.random() < 0.7
    command = Command(
        restart=restart,
        patch=present if same else generator.choice(PATCHES),
        end=options.until * generator.uniform(0.05, 1),
        shape_interval=options.until / generator.choice((4, 10, 20)),
        processes=2 if options.engine == "phase-field" and generator.random() < 0.3 else 1,
    )
    if generator.random() < 0.5:
        command.signal = generator.choice(SIGNALS)
        command.signal_delay = generator.uniform(0, 1.1 * duration)
        command.at_child = command.processes > 1 and generator.random() < 0.5
    return command


def run_pair(options, directory, commands):
    """Starts both, sends their signals in time, and waits until nothing of them is left."""
    begin = time.monotonic()
    due = [(command.delay, i, command, "start") for i, command in enumerate(commands)]
    due += [(command.delay + command.signal_delay, i, command, "send") for i, command in enumerate(commands) if command.signal]
    for when, _, command, what in sorted(due, key=lambda item: (item[0], item[1], item[3] == "send")):
        time.sleep(max(0.0, begin + when - time.monotonic()))
        if what == "start":
            command.start(options, directory)
        else:
            command.send()
    for command in commands:
        command.out, command.errors = command.process.communicate()
        command.code = command.process.returncode
        oracle.wait_for_session(command.process.pid)


def one_pair(options, directory, generator, duration, references):
    before = oracle.Snapshot(directory)
    commands = [random_command(options, generator, before.patch, duration) for _ in range(2)]
    commands[1].delay = generator.choice((0, generator.uniform(0, duration)))
    run_pair(options, directory, commands)
    try:
        for command, other in (commands, commands[::-1]):
            oracle.check_code(command, other, before)
        after = oracle.Snapshot(directory)
        killed = any(c.delivered for c in commands) or oracle.unchanged(after, before)  # by an earlier pair
        oracle.check_run(after, references, killed)
        oracle.check_nothing_lost(before, after, commands, references)
    except oracle.Wrong as wrong:
        told = "".join(f"\n    {command.describe()}" for command in commands)
        raise oracle.Wrong(f"{wrong}{told}\n    before: {before.describe()}") from None
    return commands


def finish(options, directory, references):
    """What is left of the directory's run can be continued to its end and is then that of the problem."""
    snapshot = oracle.Snapshot(directory)
    if snapshot.checkpoint_time is None:
        return
    command = Command(True, snapshot.patch, options.until, options.until / 10)
    run_pair(options, directory, [command])
    if command.code != 0:
        raise oracle.Wrong(f"the run cannot be continued to its end: {command.describe()}")
    after = oracle.Snapshot(directory)
    oracle.check_run(after, references, False)
    oracle.check_nothing_lost(snapshot, after, [command], references)
    if abs(after.times[-1] - options.until) > 1e-9 * options.until:
        raise oracle.Wrong(f"continued to {after.times[-1]} us, not {options.until} us")


def reference(options, root, patch):
    """The uninterrupted run, and how long it takes [s]."""
    command = Command(False, patch, options.until, options.until / 20)
    begin = time.monotonic()
    run_pair(options, root / f"reference-{patch}", [command])
    if command.code != 0:
        raise oracle.Wrong(f"the uninterrupted run: {command.describe()}")
    return oracle.Reference(root / f"reference-{patch}"), time.monotonic() - begin


def random_pairs(options, root):
    runs = {patch: reference(options, root, patch) for patch in PATCHES}
    references = {patch: run for patch, (run, _) in runs.items()}
    duration = min(seconds for _, seconds in runs.values())
    print(f"uninterrupted: {', '.join(str(len(run.times)) for run in references.values())} rows, {duration:.1f} s", flush=True)
    generator = random.Random(options.seed)
    codes, sent = collections.Counter(), 0
    for pair in range(options.pairs):
        directory = root / f"run-{pair // PAIRS_OF_A_DIRECTORY}"
        commands = one_pair(options, directory, generator, duration, references)
        codes.update(command.code for command in commands)
        sent += sum(command.delivered for command in commands)
        if options.verbose:
            print(f"{pair}:" + "".join(f"\n    {command.describe()}" for command in commands), flush=True)
        if (pair + 1) % PAIRS_OF_A_DIRECTORY == 0 or pair + 1 == options.pairs:
            finish(options, directory, references)
            print(f"{pair + 1} pairs", flush=True)
    table = ", ".join(f"{code}: {count}" for code, count in sorted(codes.items()))
    print(f"{options.engine}: {options.pairs} pairs, {sent} signals, nothing lost, nothing mixed; exit codes {table}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, help="the command endoflow")
    parser.add_argument("--engine", choices=UNTIL, default="boundary-integral")
    parser.add_argument("--pairs", type=int, default=PAIRS_OF_A_DIRECTORY)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--until", type=float, help="latest end in us")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="leave the runs there")
    parser.add_argument("--verbose", action="store_true", help="what each command did")
    options = parser.parse_args()
    options.program = options.program.resolve()
    options.until = options.until or UNTIL[options.engine]
    try:
        with directory_of_runs(options.keep) as directory:
            random_pairs(options, Path(directory))
    except oracle.Wrong as wrong:
        print(f"WRONG (--seed {options.seed}): {wrong}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
