"""The measurements: each a function of a Bench that returns a dict for bench.json.

A dict with the key `skipped` says in a sentence why there is no figure.
"""

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


class RunFailed(Exception):
    """A command ended with an error."""


@dataclass(frozen=True)
class Bench:
    """Where things are and how much to measure."""

    build: Path
    output: Path
    quick: bool
    repeats: int

    def command(self, *arguments):
        """Run `endoflow …` to its end; returns its wall time in s. Raises RunFailed."""
        begin = time.monotonic()
        process = subprocess.run(
            [str(self.build / "endoflow"), *map(str, arguments)],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        )
        if process.returncode != 0:
            line = (process.stderr.strip() or process.stdout.strip() or "no message").splitlines()[0]
            raise RunFailed(f"endoflow {' '.join(map(str, arguments))} ended with {process.returncode}: {line}")
        return time.monotonic() - begin

    def run(self, engine, name, *settings):
        """One run of the standard case; returns run.json."""
        directory = self.output / "runs" / name
        shutil.rmtree(directory, ignore_errors=True)
        options = [option for setting in settings for option in ("--set", setting)]
        self.command("run", engine, STANDARD_CASE, "-o", directory, *options)
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
    directory = bench.output / "runs" / "patch_sweep"
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
    """CPU time per simulated µs of both phase-field schemes on one process, early in the standard case, and their ratio."""
    if not (bench.build / "endoflow-phase-field").exists():
        return {"skipped": "endoflow was built without the phase-field engine (ENDOFLOW_PHASEFIELD=OFF)"}
    if not offers(bench, "phase_field.scheme=production"):
        return {"skipped": "this version has no phase_field.scheme = production"}
    end = 0.001 if bench.quick else 0.0077
    schemes = ("paper", "production")
    records = {scheme: [] for scheme in schemes}
    for _ in range(bench.repeats):
        for scheme in schemes:  # one after the other, so that both meet the same machine
            settings = (f"phase_field.scheme={scheme}", f"time.end={end}", "output.field_interval=1")
            records[scheme].append(bench.run("phase-field", f"phase_field_{scheme}", *settings))
    per_time = {scheme: [record["cpu_s"] / record["time_us"] for record in records[scheme]] for scheme in schemes}
    return {
        "until_us": end,
        "cpu_s_per_us": {scheme: median(per_time[scheme]) for scheme in schemes},
        "ratio_paper_to_production": median(p / q for p, q in zip(per_time["paper"], per_time["production"])),
        "schemes": {scheme: summary(records[scheme]) for scheme in schemes},
    }


def offers(bench, setting):
    """Whether this version of endoflow accepts a setting, "section.key=value"."""
    command = [str(bench.build / "endoflow"), "check", str(STANDARD_CASE), "--set", setting]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


#: In the order in which they are made.
ALL = {
    "kernels": kernels,
    "to_budding": to_budding,
    "to_the_end": to_the_end,
    "patch_sweep": patch_sweep,
    "phase_field_schemes": phase_field_schemes,
}
