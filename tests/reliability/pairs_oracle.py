"""What must hold after two runs have met in one directory (see random_pairs.py)."""

import json
import os
import re
import signal
import time
from pathlib import Path

import h5py
import numpy as np

#: Relative differences from the uninterrupted run. Mass is conserved to round-off in one engine and to 1e-6 in the other; energies
#: are compared with what is interpolated between the steps of another run. The two problems differ by tens of per cent.
MASS, ENERGY, SHAPE_MASS = 1e-3, 0.02, 0.05


class Wrong(Exception):
    """Something was lost or mixed, or a command ended with another code than it should."""


def status(pid):
    """(state, session) of a process, None when there is none."""
    try:
        words = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except (FileNotFoundError, ProcessLookupError):
        return None
    return words[0], int(words[3])


def members_of_session(leader):
    """Processes that a session leader has started, itself included, that still run."""
    found = ((int(path.name), status(path.name)) for path in Path("/proc").glob("[0-9]*"))
    return {pid for pid, seen in found if seen and seen[1] == leader and seen[0] != "Z"}


def wait_for_session(leader):
    """What mpirun leaves behind when it is killed ends by itself, soon."""
    deadline = time.monotonic() + 60
    while members_of_session(leader):
        if time.monotonic() > deadline:
            raise Wrong(f"processes {members_of_session(leader)} go on a minute after their mpirun has ended")
        time.sleep(0.05)


def is_engine(pid):
    try:
        return b"endoflow-" in Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0", 1)[0]
    except (FileNotFoundError, ProcessLookupError):
        return False


def send(pid, number):
    """Whether the process was there to get the signal."""
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        return False
    return True


def read_rows(file):
    """(times, lines) of a history.csv, a torn last line left out."""
    if not file.exists():
        return np.array([]), []
    text = file.read_text()
    lines = text.splitlines()[1:]
    if lines and not text.endswith("\n"):
        lines.pop()
    return np.array([float(line.split(",", 1)[0]) for line in lines]), lines


def column(file, name):
    header, *lines = file.read_text().splitlines()
    at = header.split(",").index(name)
    return np.array([float(line.split(",")[at]) for line in lines])


def checkpoint_time(directory):
    """Time of the last whole checkpoint [us], None without one."""
    for name in ("state.h5", "state.previous.h5"):
        try:
            with h5py.File(directory / "checkpoint" / name, "r") as file:
                return float(file.attrs["time_us"])
        except (OSError, KeyError):
            continue
    return None


def shapes_of(directory):
    """[(time, mass)] of shapes.h5; mass is the molecules' of the recorded curve, nm^2."""
    with h5py.File(directory / "shapes.h5", "r") as file:
        out = []
        for name in sorted(file["shapes"]):
            shape = file["shapes"][name]
            r, s, c = (shape[key][:] for key in ("r", "s", "c"))
            mass = np.sum(np.pi * np.diff(s) * ((r * c)[1:] + (r * c)[:-1]))
            out.append((float(shape.attrs["time"]), float(mass)))
        return out


class Snapshot:
    """A run's directory as it stands."""

    def __init__(self, directory):
        self.directory = directory
        self.times, self.lines = read_rows(directory / "history.csv")
        self.checkpoint_time = checkpoint_time(directory)
        self.record = None
        if (directory / "run.json").exists():
            try:
                self.record = json.loads((directory / "run.json").read_text())
            except ValueError:
                raise Wrong(f"{directory}/run.json is torn") from None
        parameters = (self.record or {}).get("parameters", {})
        self.patch = int(parameters["molecules"]["patch_radius"]) if self.record else None
        earlier = directory / "earlier"
        self.earlier = {path for path in earlier.iterdir()} if earlier.exists() else set()

    def describe(self):
        if not self.record:
            return "no run"
        reached = f"{self.times[-1]:.4g} us" if len(self.times) else "no row"
        return f"patch {self.patch}, {self.record['state']}, {reached}, checkpoint {self.checkpoint_time} us"


class Reference:
    """The uninterrupted run of a problem."""

    def __init__(self, directory):
        file = directory / "history.csv"
        self.times = column(file, "time_us")
        self.mass = column(file, "molecule_mass_nm2")[-1]
        self.energy = column(file, "bending_energy_pN_nm")
        self.shape_mass = shapes_of(directory)[0][1]


def check_run(run, references, killed):
    """The directory holds one run of one problem. `killed`: signals were sent, so that its end may be missing."""
    if run.record is None:
        if len(run.times):
            raise Wrong("history.csv has rows, but there is no run.json")
        return
    if run.record["state"] not in ("finished", "interrupted") and not killed:
        raise Wrong(f"state {run.record['state']}, and nobody has killed it")
    if np.any(np.diff(run.times) <= 0):
        raise Wrong("time does not increase in history.csv")
    if run.record["state"] == "finished" and abs(run.times[-1] / run.record["parameters"]["time"]["end"] - 1) > 1e-9:
        raise Wrong(f"finished at {run.times[-1]} us, not at {run.record['parameters']['time.end']} us")
    expected = references[run.patch]
    header = (run.directory / "history.csv").read_text().splitlines()[0].split(",")
    values = {name: [float(line.split(",")[i]) for line in run.lines] for i, name in enumerate(header)
              if name in ("molecule_mass_nm2", "bending_energy_pN_nm")}
    wanted = np.interp(run.times, expected.times, expected.energy)
    compare("history.csv, mass", values["molecule_mass_nm2"], expected.mass, MASS, run)
    compare("history.csv, energy", values["bending_energy_pN_nm"], wanted, ENERGY, run)
    try:
        shapes = shapes_of(run.directory)
    except (OSError, KeyError, RuntimeError):
        if not killed:
            raise Wrong("shapes.h5 cannot be read, and nobody has killed the run") from None
        return
    times = np.array([at for at, _ in shapes])
    if np.any(np.diff(times) <= 0):
        raise Wrong(f"shapes.h5: times {times}")
    compare("shapes.h5, mass", [mass for _, mass in shapes], expected.shape_mass, SHAPE_MASS, run)


def compare(what, values, expected, tolerance, run):
    difference = np.max(np.abs(np.array(values, float) / expected - 1), initial=0)
    if not difference <= tolerance:
        raise Wrong(f"{what}: {difference:.3g} off the uninterrupted run with patch {run.patch}")


def covers(run, before):
    """Whether a run goes on from where `before` can be continued: the rows up to the checkpoint are there, letter by letter."""
    if run.patch != before.patch or run.checkpoint_time is None or run.checkpoint_time < before.checkpoint_time:
        return False
    kept = int(np.sum(before.times <= before.checkpoint_time * (1 + 1e-12)))
    return run.lines[:kept] == before.lines[:kept]


def unchanged(run, before):
    return (run.patch, run.lines) == (before.patch, before.lines)


def check_nothing_lost(before, after, commands, references):
    """What was there before is there still, or was continued, or stands in earlier/."""
    if not before.earlier <= after.earlier:
        raise Wrong("an earlier run is gone")
    moved = [Snapshot(path) for path in after.earlier - before.earlier]
    starts = sum(not command.restart for command in commands)
    if len(moved) > starts:
        raise Wrong(f"{len(moved)} runs were moved to earlier/ by {starts} starts")
    for run in moved:
        check_run(run, references, True)
    if before.record is None:
        return
    if any(unchanged(run, before) for run in (after, *moved)):
        return
    if before.checkpoint_time is None or not any(covers(run, before) for run in (after, *moved)):
        raise Wrong("the run that was there is neither unchanged nor continued nor in earlier/")


def check_code(command, other, before):
    """The exit code is the documented one of what happened to the command."""
    code, errors = command.code, command.errors
    several = command.processes > 1
    if "Traceback" in errors or "terminate called" in errors:
        raise Wrong(f"no orderly end: {errors}")
    if code == 0:
        if "finished at" not in command.out and "nothing to do" not in command.out:
            raise Wrong(f"code 0 without a last word: {command.out}")
        return
    if command.delivered and code in codes_of_signal(command):
        return
    problems = {before.patch, *([] if other.restart else [other.patch])}
    if code == 2 and command.restart and "a restart cannot change" in errors and problems - {command.patch, None}:
        return
    if code == 4 and (holder := re.search(r"in use by (?:process (\d+)|another process)", errors)):
        if holder[1] is None or int(holder[1]) in other.pids or other.processes > 1:
            return
    if code == 4 and command.restart and "holds no checkpoint" in errors:
        if before.checkpoint_time is None or not other.restart:
            return
    if code == 4 and command.restart and "holds no run to continue" in errors:
        if before.record is None or (not other.restart and other.delivered):
            return
    raise Wrong(f"code {code}{' of mpirun' if several else ''}: {errors.strip() or command.out.strip()}")


def codes_of_signal(command):
    """A signal that comes before the program has begun to listen ends it as any other; mpirun has a code of its own."""
    number = command.signal
    if command.processes == 1:
        return {-number} if number == signal.SIGKILL else {-number, 128 + number}
    return {128 + number, -number} if command.at_child or number == signal.SIGKILL else {1, 128 + number, -number}
