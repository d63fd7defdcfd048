"""Nothing is lost when a run is killed: kills a run at random times (SIGKILL), restarts it, compares the end.

    python3 tests/reliability/kill_and_restart.py build/endoflow --kills 50
    python3 tests/reliability/kill_and_restart.py build/endoflow --engine phase-field --kills 20 --until 0.01
    python3 tests/reliability/kill_and_restart.py build/endoflow --engine phase-field --kills 20 --signal INT

One uninterrupted run is the reference. Then a run in another directory is killed and restarted until it reaches its end,
again and again until the number of kills is reached; each time history.csv and shapes.h5 must hold the reference's rows and
shapes, none missing, none twice, none torn. Checkpoints are written after every step, so that many kills hit a file that
is being written. With --signal, runs are asked to stop instead, anywhere within a step. Ends with 1 and says what differs
when something was lost.
"""

import argparse
import contextlib
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1]))

import engines  # noqa: E402

#: A continued phase-field run makes new factors, and Newton's method ends where ψ changes by 9e-7 nm: 1.2e-4 of the
#: height of 0.0076 nm in a run's first row, and of what follows from it.
TOLERANCE = {"boundary-integral": 1e-10, "phase-field": 1e-3}

# Small enough that a run takes seconds; a checkpoint after every step, a shape about as often.
SETTINGS = {
    "boundary-integral": {
        "boundary_integral.elements": 24,
        "boundary_integral.threads": 1,
        "boundary_integral.restart_interval": 8,  # so that there are many points to go on from
    },
    "phase-field": engines.COARSE["phase-field"] | {
        "molecules.interface_width": 5.5,  # wide enough for the coat's edge to need no smaller cells
    },
}
UNTIL = {"boundary-integral": 0.02, "phase-field": 0.001}


class Lost(Exception):
    """Something the run had written is missing, damaged or different."""


def command(options, directory, restart):
    settings = {
        "output.checkpoint_interval": 0,
        "output.shape_interval": options.until / 20,
        "output.field_interval": options.until / 4,
        "time.end": options.until,
        **SETTINGS[options.engine],
        **dict(item.split("=", 1) for item in options.set),
    }
    words = [options.program, "run", options.engine, options.case, "-o", directory]
    words += engines.options(engines.texts(settings))
    return [str(word) for word in words] + (["--restart"] if restart else [])


def start(options, directory, restart):
    return subprocess.Popen(
        command(options, directory, restart), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )


def last_checkpoint(directory):
    """What tells one checkpoint from the next: file and time of writing [ns]; None before the first."""
    for name in ("state.h5", "state.previous.h5"):
        try:
            status = (directory / "checkpoint" / name).stat()
        except FileNotFoundError:
            continue
        return status.st_ino, status.st_mtime_ns
    return None


def read_history(directory):
    """Column names and the rows as numbers, not-a-number where a cell is empty."""
    text = (directory / "history.csv").read_text()
    if not text.endswith("\n"):
        raise Lost("history.csv ends in a torn row")
    header, *lines = text.splitlines()
    names = header.split(",")
    rows = []
    for number, line in enumerate(lines, 2):
        cells = line.split(",")
        if len(cells) != len(names):
            raise Lost(f"history.csv:{number}: {len(cells)} cells, not {len(names)}")
        rows.append([float(cell) if cell else np.nan for cell in cells])
    return names, np.array(rows)


def read_shapes(directory):
    with h5py.File(directory / "shapes.h5", "r") as file:
        groups = [file["shapes"][name] for name in sorted(file["shapes"])]
        return [(group.attrs["time"], {name: values[:] for name, values in group.items()}) for group in groups]


def compare_values(what, values, expected, tolerance, scale=0.0):
    if values.shape != expected.shape:
        raise Lost(f"{what}: {values.shape} values, not {expected.shape}")
    if not np.array_equal(np.isnan(values), np.isnan(expected)):
        raise Lost(f"{what}: empty in other places")
    scale = max(scale, np.nanmax(np.abs(expected), initial=0.0))
    difference = np.nanmax(np.abs(values - expected), initial=0.0)
    if difference > tolerance * scale:
        raise Lost(f"{what}: differs by {difference:.3g}, more than {tolerance:g} of {scale:.3g}")
    return difference / scale if scale else 0.0


def compare_histories(directory, reference, tolerance):
    names, rows = read_history(directory)
    expected_names, expected = read_history(reference)
    if names != expected_names:
        raise Lost(f"history.csv: columns {names}, not {expected_names}")
    times = rows[:, 0]
    if np.any(np.diff(times) <= 0):
        raise Lost(f"history.csv: time does not increase after {times[:-1][np.diff(times) <= 0][0]} us")
    if len(rows) != len(expected):
        raise Lost(f"history.csv: {len(rows)} rows, not {len(expected)}")
    # Columns that are relative to something already are residuals near round-off: 1 is their scale.
    return max(
        compare_values(f"history.csv, {name}", rows[:, i], expected[:, i], tolerance, float(name.endswith("_relative")))
        for i, name in enumerate(names)
        if name != "wall_s"
    )


def compare_shapes(directory, reference, tolerance):
    shapes, expected = read_shapes(directory), read_shapes(reference)
    if len(shapes) != len(expected):
        raise Lost(f"shapes.h5: {len(shapes)} shapes, not {len(expected)}")
    largest = 0.0
    for (at, values), (at_expected, wanted) in zip(shapes, expected):
        if abs(at - at_expected) > tolerance * max(at_expected, 1e-300) or values.keys() != wanted.keys():
            raise Lost(f"shapes.h5: shape at {at} us, not {at_expected} us, or with other columns")
        for name in wanted:
            # The curve's points are nm; a membrane that is still flat has curvatures and velocities near round-off.
            scale = 1e-3 if name in ("kappa", "u_r", "u_z", "lambda") else 0.0
            what = f"shapes.h5, {name} at {at} us"
            largest = max(largest, compare_values(what, values[name], wanted[name], tolerance, scale))
    return largest


def listed_fields(directory):
    """Times and files of fields.pvd."""
    data_sets = ElementTree.parse(directory / "fields.pvd").iter("DataSet")
    return [(float(item.get("timestep")), item.get("file")) for item in data_sets]


def compare_fields(directory, reference, tolerance):
    names = [sorted(path.name for path in (root / "fields").glob("*")) for root in (directory, reference)]
    if names[0] != names[1]:
        raise Lost(f"fields: {names[0]}, not {names[1]}")
    if (reference / "fields.pvd").exists():
        listed, expected = listed_fields(directory), listed_fields(reference)
        if [file for _, file in listed] != [file for _, file in expected]:
            raise Lost(f"fields.pvd: lists {listed}, not {expected}")
        times = [np.array([time for time, _ in items]) for items in (listed, expected)]
        compare_values("fields.pvd, times", *times, tolerance)


def finish(process, what):
    _, errors = process.communicate()
    if process.returncode != 0:
        raise Lost(f"{what} ended with {process.returncode}: {errors.strip()}")


def stop(process, number):
    """Send the signal; False when the run had just reached its end. A program that does not listen yet ends as by any signal."""
    process.send_signal(number)
    _, errors = process.communicate()
    if process.returncode == 0:
        return False
    if process.returncode not in (-number, 128 + number) or (errors and process.returncode > 0):
        raise Lost(f"{number.name} ended a run with {process.returncode}: {errors.strip()}")
    return True


class Statistics:
    kills = rounds = early_kills = damaged_shapes = 0
    duration = 0.0  # s, of the fastest whole run so far: the machine may have become quicker than for the reference
    largest_difference = 0.0


def note_damage(directory, statistics):
    """How often a kill left a shapes.h5 that cannot be read: a restart has to mend that."""
    try:
        read_shapes(directory)
    except FileNotFoundError:
        pass
    except (OSError, KeyError, RuntimeError):
        statistics.damaged_shapes += 1


def wait_for_checkpoint(process, directory, last):
    while process.poll() is None and last_checkpoint(directory) == last:
        time.sleep(0.002)


def one_round(options, directory, generator, statistics):
    """Runs to the end with as many kills as come in between.

    A kill before the first checkpoint of a run tests its start and no more. So the run after it is spared until it has
    written one: on a machine that has become slow, most kills would come early otherwise.
    """
    early = False
    while True:
        last = last_checkpoint(directory)
        restart = last is not None
        begin = time.monotonic()
        process = start(options, directory, restart)
        if statistics.kills >= options.kills:
            return finish(process, "the last run")
        if early:
            wait_for_checkpoint(process, directory, last)
        try:
            process.wait(timeout=generator.uniform(0, 0.6 * statistics.duration))
        except subprocess.TimeoutExpired:
            if not stop(process, options.signal):
                return None
            statistics.kills += 1
            early = last_checkpoint(directory) == last
            statistics.early_kills += early
            note_damage(directory, statistics)
            continue
        if not restart:  # a restarted run may have had little left to do
            statistics.duration = min(statistics.duration, time.monotonic() - begin)
        return finish(process, "a restarted run" if restart else "a run")


def kill_and_restart(options, root):
    tolerance = TOLERANCE[options.engine]
    reference = root / "reference"
    begin = time.monotonic()
    finish(start(options, reference, False), "the uninterrupted run")
    statistics = Statistics()
    statistics.duration = time.monotonic() - begin
    print(f"uninterrupted: {len(read_history(reference)[1])} rows, {statistics.duration:.1f} s", flush=True)
    generator = random.Random(options.seed)
    while statistics.kills < options.kills:
        directory = root / f"round-{statistics.rounds}"
        one_round(options, directory, generator, statistics)
        difference = max(
            compare_histories(directory, reference, tolerance), compare_shapes(directory, reference, tolerance)
        )
        compare_fields(directory, reference, tolerance)
        statistics.rounds += 1
        statistics.largest_difference = max(statistics.largest_difference, difference)
        print(f"{statistics.kills} kills, {statistics.rounds} runs complete, largest difference "
              f"{statistics.largest_difference:.2g}", flush=True)
    print(
        f"{options.engine}: {statistics.kills} kills, {statistics.rounds} runs reached their end, nothing lost; "
        f"{statistics.early_kills} kills before a run's first checkpoint, {statistics.damaged_shapes} left an "
        f"unreadable shapes.h5; largest relative difference {statistics.largest_difference:.2g} (allowed {tolerance:g})"
    )


def directory_of_runs(keep):
    """A context with the directory `keep` (Path), or without one with a directory that goes with the context."""
    return contextlib.nullcontext(keep) if keep else tempfile.TemporaryDirectory()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, help="the command endoflow")
    parser.add_argument("--engine", choices=TOLERANCE, default="boundary-integral")
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--signal", choices=("KILL", "INT", "TERM", "HUP"), default="KILL")
    parser.add_argument("--seed", type=int, default=1, help="of the times of the kills")
    parser.add_argument("--case", type=Path, default=Path(os.devnull), help="case file [the standard case]")
    parser.add_argument("--until", type=float, help="time.end in us")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="as for endoflow run")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="leave the runs there")
    options = parser.parse_args()
    options.program = options.program.resolve()
    options.signal = signal.Signals[f"SIG{options.signal}"]
    options.until = options.until or UNTIL[options.engine]
    try:
        with directory_of_runs(options.keep) as directory:
            kill_and_restart(options, Path(directory))
    except Lost as loss:
        print(f"LOST: {loss}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
