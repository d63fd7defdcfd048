"""The measurements: each a function of a Bench that returns a dict for bench.json.

A dict with the key `skipped` says in a sentence why there is no figure.
"""

import csv
import json
import os
import shutil
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path
from statistics import median

SOURCE = Path(__file__).resolve().parent.parent
STANDARD_CASE = SOURCE / "cases" / "standard.toml"

#: No field files: they are no part of what is compared.
NO_FIELDS = "output.field_interval=0"

#: Names of the runs of the phase field's schemes.
PAPER_RUN, PRODUCTION_RUN = "phase_field_paper", "phase_field_production"

#: What stands for a figure of an engine that is not there.
NO_PHASE_FIELD = {"skipped": "endoflow was built without the phase-field engine (ENDOFLOW_PHASEFIELD=OFF)"}


class RunFailed(Exception):
    """A command ended with an error."""


@dataclass(frozen=True)
class Bench:
    """Where things are and how much to measure."""

    build: Path
    output: Path
    quick: bool
    repeats: int
    scaling: tuple = (1, 2)  # numbers of processes

    def command(self, *arguments, processes=1):
        """Run `endoflow …` to its end; returns its wall time in s. Raises RunFailed."""
        begin = time.monotonic()
        launcher = ["mpirun", "-n", str(processes)] if processes > 1 else []
        process = subprocess.run(
            [*launcher, str(self.build / "endoflow"), *map(str, arguments)],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        )
        if process.returncode != 0:
            line = (process.stderr.strip() or process.stdout.strip() or "no message").splitlines()[0]
            raise RunFailed(f"endoflow {' '.join(map(str, arguments))} ended with {process.returncode}: {line}")
        return time.monotonic() - begin

    def has_phase_field(self):
        """Whether the build has this engine."""
        return (self.build / "endoflow-phase-field").exists()

    def directory(self, name):
        """Where a run lies."""
        return self.output / "runs" / name

    def run(self, engine, name, *settings, processes=1):
        """One run of the standard case; returns run.json."""
        directory = self.directory(name)
        shutil.rmtree(directory, ignore_errors=True)
        options = [option for setting in settings for option in ("--set", setting)]
        self.command("run", engine, STANDARD_CASE, "-o", directory, *options, processes=processes)
        return json.loads((directory / "run.json").read_text(encoding="utf-8"))

    def repeated(self, engine, name, *settings):
        """The same run `repeats` times, as a summary."""
        return summary([self.run(engine, name, *settings) for _ in range(self.repeats)])


def summary(records):
    """Medians over run.json dicts of one run repeated: wall and CPU time, in all and by phase; steps and end."""
    last = records[-1]
    phases = {
        name: {key: median(record["phases"][name][key] for record in records) for key in ("wall_s", "cpu_s")}
        for name in last["phases"]
    }
    budding = last["events"].get("budding")
    return {
        "wall_s": median(record["wall_s"] for record in records),
        "cpu_s": median(record["cpu_s"] for record in records),
        "end_us": last["time_us"],
        "exit_reason": last["exit_reason"],
        "budding_time_us": budding and budding["time_us"],
        "steps": last["steps"],
        "notes": last.get("notes", {}).get("integrator", {}),
        "processes": last["processes"],
        "threads": last["threads"],
        "phases": phases,
    }


def kernels(bench):
    """Source-target pairs per second of CPU time on one core."""
    program = bench.build / "bench-ring-kernels"
    if not program.exists():
        return {"skipped": f"{program} is not built; `make bench` builds it"}
    found = subprocess.run([str(program), str(3 if bench.quick else 9)], capture_output=True, text=True, check=True)
    return {"pairs_per_second_and_core": json.loads(found.stdout)}


def to_budding(bench):
    """The standard case by the boundary-integral engine, until the neck is narrower than 5 nm."""
    return bench.repeated("boundary-integral", "to_budding", "output.stop_at_budding=true")


def to_the_end(bench):
    """The standard case by the boundary-integral engine to its end, 20 µs; with --quick to 1 µs."""
    return bench.repeated("boundary-integral", "to_the_end", f"time.end={1 if bench.quick else 20}")


def patch_sweep(bench):
    """`endoflow sweep` over 11 patch radii to budding or 3 µs, all cores, with its table and plots; --quick: 3 radii to 0.1 µs."""
    radii, end = ("20:60:20", 0.1) if bench.quick else ("20:60:4", 3)
    directory = bench.directory("patch_sweep")
    shutil.rmtree(directory, ignore_errors=True)
    wall = bench.command(
        *("sweep", STANDARD_CASE, "--vary", f"molecules.patch_radius={radii}", "--engine", "boundary-integral"),
        *("-o", directory, "--until", end, "--set", "output.stop_at_budding=true", "--jobs", os.cpu_count()),
    )
    records = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(directory.rglob("run.json"))]
    return {
        "wall_s": wall,
        "cpu_s": sum(record["cpu_s"] for record in records),
        "runs": len(records),
        "finished": sum(record["state"] == "finished" for record in records),
        "until_us": end,
    }


def phase_field_schemes(bench):
    """The standard case by both phase-field schemes on one process, one run each: CPU time of `production` up to several
    times, and of `paper` to 0.5 µs, when the mesh has grown, and from there on by the mean of the last fifth of its
    steps, of which it takes at least one per `phase_field.paper.max_step`, 2 ns."""
    if not bench.has_phase_field():
        return NO_PHASE_FIELD
    times, paper_end = ((0.001,), 0.0005) if bench.quick else ((1, 3, 20), 0.5)
    paper = bench.run("phase-field", PAPER_RUN, "phase_field.scheme=paper", f"time.end={paper_end}", NO_FIELDS)
    per_step = late_step_cost(bench.directory(PAPER_RUN) / "history.csv", cpu_per_wall(paper))
    longest_step = paper["parameters"]["phase_field"]["paper"]["max_step"]
    production = bench.run("phase-field", PRODUCTION_RUN, f"time.end={times[-1]}", NO_FIELDS)
    history = bench.directory(PRODUCTION_RUN) / "history.csv"

    def paper_cost(time):
        return paper["cpu_s"] + (time - paper_end) / longest_step * per_step

    return {
        "paper_measured_to_us": paper_end,
        "paper_measured_cpu_s": paper["cpu_s"],
        "paper_cpu_s_per_step": per_step,
        "paper_longest_step_us": longest_step,
        "exit_reason": production["exit_reason"],
        "to": [
            {
                "time_us": time,
                "cpu_s": cpu,
                "steps": steps,
                "paper_cpu_s": paper_cost(time),
                "ratio": paper_cost(time) / cpu,
            }
            for time, cpu, steps in costs(history, cpu_per_wall(production), times)
        ],
    }


def scaling(bench):
    """The standard case by the phase-field engine to 0.02 µs on each of the numbers of processes, which are taken in turn
    in every repeat; --quick: to 0.1 ns."""
    if not bench.has_phase_field():
        return NO_PHASE_FIELD
    end = 1e-4 if bench.quick else 0.02
    records = {count: [] for count in bench.scaling}
    for _ in range(bench.repeats):
        for count, of_count in records.items():
            settings = f"time.end={end}", NO_FIELDS
            of_count.append(bench.run("phase-field", f"scaling_{count}", *settings, processes=count))
    first = records[bench.scaling[0]]
    return {
        "until_us": end,
        "on": [
            {
                "processes": count,
                "wall_s": median(record["wall_s"] for record in of_count),
                "times_as_fast": median(one["wall_s"] / record["wall_s"] for one, record in zip(first, of_count)),
                "solver": of_count[-1]["notes"]["solver"],
            }
            for count, of_count in records.items()
        ],
    }


def cpu_per_wall(record):
    """CPU time per wall time of a run."""
    return record["cpu_s"] / record["wall_s"]


def times_and_walls(history):
    """[(time in µs, wall time in s)] of a history.csv."""
    with open(history, encoding="utf-8", newline="") as file:
        return [(float(row["time_us"]), float(row["wall_s"])) for row in csv.DictReader(file)]


def late_step_cost(history, cpu_per_wall_time):
    """CPU s of a step, the mean over the last fifth of a run's steps."""
    walls = [wall for _, wall in times_and_walls(history)]
    first = min(4 * len(walls) // 5, len(walls) - 2)
    return cpu_per_wall_time * (walls[-1] - walls[first]) / (len(walls) - 1 - first)


def costs(history, cpu_per_wall_time, times):
    """(time, CPU s, steps) up to each of `times`, or to the run's end where that is earlier."""
    rows = times_and_walls(history)
    found = []
    for end in times:
        steps = min(sum(at < end * (1 - 1e-9) for at, _ in rows), len(rows) - 1)
        at, wall = rows[steps]
        found.append((min(at, end), cpu_per_wall_time * wall, steps))
    return found


#: In the order in which they are made.
ALL = {
    "kernels": kernels,
    "to_budding": to_budding,
    "to_the_end": to_the_end,
    "patch_sweep": patch_sweep,
    "phase_field_schemes": phase_field_schemes,
    "scaling": scaling,
}
