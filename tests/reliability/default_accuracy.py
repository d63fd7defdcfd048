"""Whether the sharp engine's default accuracy satisfies its own alarms: runs of the cases in cases/, and their relatives.

    python3 tests/reliability/default_accuracy.py build/endoflow                         # all
    python3 tests/reliability/default_accuracy.py build/endoflow --runs standard,at-rest

Prints a table of what the energy's balance came to. Ends with 1 when a run fails, raises an alarm, or when a membrane that is at
rest from the start moves faster than a millionth of what the standard case does.
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import engines  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
#: The largest inflow of the standard case, nm/µs: its fastest motion is faster still.
STANDARD_INFLOW = 40


@dataclass
class Run:
    """A case with settings to an end (µs), "" for its own; whether the membrane is at rest from the start."""

    case: str
    settings: tuple = ()
    end: str = ""
    at_rest: bool = False


NO_CURVATURE = "membrane.spontaneous_curvature=0"
RUNS = {
    **{
        name: Run(name)
        for name in (
            "asymptotic",
            "closed_vesicle",
            "demo",
            "fickian",
            "geometric",
            "growing-coat",
            "line-tension",
            "phase-diagram",
            "snap-through",
            "statics",
            "tube",
        )
    },
    "standard": Run("standard", end="1"),
    **{f"patch-{radius}": Run("standard", (f"molecules.patch_radius={radius}",), "1.5") for radius in (20, 28, 44, 60)},
    "at-rest": Run("standard", ("molecules.patch_radius=20",), "2000"),
    "flat": Run("standard", (NO_CURVATURE,), "10", at_rest=True),
    "no-coat": Run("standard", (NO_CURVATURE, "membrane.bending_stiffness_coated=100"), "10", at_rest=True),
    **{
        f"sphere-{name}": Run(
            "closed_vesicle",
            (f"domain.spheroid_polar_axis={polar}", f"domain.spheroid_equatorial_axis={equatorial}"),
            "10",
            at_rest=True,
        )
        for name, polar, equatorial in (("oblate", 50, 50.0001), ("prolate", 50.0001, 50))
    },
}


def fastest(directory):
    """The largest |inflow| [nm/µs] and dissipated power [pN nm/µs] of a run's history."""
    lines = (directory / "history.csv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return tuple(
        max(abs(float(row[column])) for row in rows) for column in ("inflow_nm_per_us", "dissipated_power_pN_nm_per_us")
    )


def faults(run, directory, finished):
    """What is wrong with a run, as texts."""
    found = [] if finished.returncode == 0 else [f"exit {finished.returncode}: {finished.stderr.strip()}"]
    record = json.loads((directory / "run.json").read_text(encoding="utf-8"))
    found += [f"alarm {alarm['name']} at {alarm['time_us']:.4g} µs: {alarm['value']:.2g}" for alarm in record["alarms"]]
    if run.at_rest and finished.returncode == 0:
        inflow, power = fastest(directory)
        if inflow > 1e-6 * STANDARD_INFLOW:
            found.append(f"moves by {inflow:.2g} nm/µs")
        if power > 1e-6:
            found.append(f"takes {power:.2g} pN nm/µs")
    return found, record


def row(name, record):
    """The table's row of a run."""
    balance = record["accuracy"].get("energy-balance", {"largest": float("nan"), "time_us": float("nan")})
    budding = record["events"].get("budding", {}).get("time_us")
    elements = " → ".join(str(count["elements"]) for count in record["notes"].get("elements_from", []))
    cells = [name, f"{balance['largest']:.1e}", f"{balance['time_us']:.4g}", f"{budding:.6f}" if budding else ""]
    steps = str(record["steps"]["accepted"])
    return "| " + " | ".join([*cells, elements, steps, f"{record['cpu_s']:.1f}"]) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--runs", help="names of runs, with commas between; all where it is not given")
    options = parser.parse_args()
    names = options.runs.split(",") if options.runs else list(RUNS)
    if unknown := set(names) - set(RUNS):
        parser.error(f"--runs: there is no {', '.join(sorted(unknown))}; known: {', '.join(RUNS)}")
    head = ["run", "energy balance", "at, µs", "budding, µs", "elements", "steps", "processor time, s"]
    print("| " + " | ".join(head) + " |\n|" + " --- |" * len(head))
    wrong = []
    with tempfile.TemporaryDirectory() as scratch:
        for name in names:
            run, directory = RUNS[name], Path(scratch) / name
            words = [options.program.resolve(), "run", "boundary-integral", ROOT / "cases" / f"{run.case}.toml"]
            words += ["-o", directory, *engines.options((*run.settings, "output.field_interval=0"))]
            words += ["--until", run.end] if run.end else []
            finished = subprocess.run([str(word) for word in words], capture_output=True, text=True)
            found, record = faults(run, directory, finished)
            wrong += [f"{name}: {fault}" for fault in found]
            print(row(name, record), flush=True)
    print("\n".join(wrong) if wrong else f"{len(names)} runs without an alarm")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
