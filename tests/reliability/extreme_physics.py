"""Physics at its extremes: every run ends well, or stops with the error that belongs to it; no number is not finite.

    python3 tests/reliability/extreme_physics.py build/endoflow                           # tens of minutes
    python3 tests/reliability/extreme_physics.py build/endoflow --engine boundary-integral
    python3 tests/reliability/extreme_physics.py build/endoflow --quick                   # seconds: some of the sharp ones

Prints a table. What is checked of every run: exit code and message, rows without not-a-numbers, molecules conserved, energy
balanced, and a flat membrane that rests when it has no spontaneous curvature. Ends with 1 when something is otherwise.
"""

import argparse
import csv
import math
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from engines import options, texts  # noqa: E402

ENGINES = ("boundary-integral", "phase-field")
ENDED_WELL = (0, "")
BAD_INPUT = (2, "domain.membrane_height")
NEAR_WALL = (3, "membrane-near-wall")
NEGATIVE_STIFFNESS = (3, "negative-stiffness")

# The phase field costs more by far, so its runs are shorter.
COMMON = {
    "boundary-integral": {"time.end": 0.1, "boundary_integral.threads": 1},
    "phase-field": {"time.end": 0.0005},
}
MASS_TOLERANCE = {"boundary-integral": 1e-9, "phase-field": 1e-6}
# Of the sharp engine: forces and motion belong to shapes that differ by the error of a step, time.tolerance = 1e-4; an
# order of magnitude more where a stiff neck is about to close.
BALANCE_TOLERANCE = 1e-3
LONGEST = 1800  # s; a run that takes longer hangs


@dataclass
class Case:
    name: str
    settings: dict
    ends: dict = field(default_factory=dict)  # engine: (exit code, part of the message); ENDED_WELL if not named
    quick: bool = False
    rests: bool = False  # nothing moves


def viscosity_ratio(ratio, **how):
    return Case(f"viscosity ratio {ratio:g}", {"fluid.viscosity_intracellular": 1e-3 * ratio}, **how)


def stiffness_ratio(ratio, **how):
    return Case(f"stiffness ratio {ratio:g}", {"membrane.bending_stiffness_coated": 100 * ratio}, **how)


def patch_radius(radius, **how):
    return Case(f"patch of {radius:g} nm", {"molecules.patch_radius": radius}, **how)


def membrane_height(height, **how):
    return Case(f"membrane {160 - height:g} nm below the top", {"domain.membrane_height": height}, **how)


def pin_band(half_width, **how):
    return Case(f"pin band of ±{half_width:g} nm", {"domain.pin_half_width": half_width}, **how)


CASES = [
    viscosity_ratio(1e-3, quick=True),
    viscosity_ratio(1e-2),
    viscosity_ratio(1),
    viscosity_ratio(1e2),
    viscosity_ratio(1e3, quick=True),
    stiffness_ratio(1),
    stiffness_ratio(10),
    stiffness_ratio(100, ends={"boundary-integral": NEGATIVE_STIFFNESS}, quick=True),
    Case("the same, coarse-grained law",
         {"membrane.bending_stiffness_coated": 1e4, "membrane.constitutive_law": "coarse-grained"}),
    patch_radius(2, quick=True),
    patch_radius(5),
    patch_radius(20),
    patch_radius(60),
    patch_radius(72),
    Case("no spontaneous curvature", {"membrane.spontaneous_curvature": 0}, quick=True, rests=True),
    membrane_height(155, ends={"boundary-integral": BAD_INPUT, "phase-field": BAD_INPUT}, quick=True),
    membrane_height(140, ends={"boundary-integral": NEAR_WALL}, quick=True),
    pin_band(0.05),
    pin_band(0.5),
    pin_band(40),
]


class Wrong(Exception):
    """A run that did not end as it should."""


def run(program, engine, case, directory):
    settings = {"output.field_interval": 0, **COMMON[engine], **case.settings}
    words = [program, "run", engine, "/dev/null", "-o", directory, *options(texts(settings))]
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=LONGEST)


def rows_of(directory):
    with open(directory / "history.csv", newline="") as file:
        return [{name: float(cell) for name, cell in row.items() if cell} for row in csv.DictReader(file)]


def check_rows(rows, engine, case):
    for row in rows:
        for name, value in row.items():
            if not math.isfinite(value):
                raise Wrong(f"{name} is {value} at {row['time_us']} us")
        mass = row["molecule_mass_nm2"] / rows[0]["molecule_mass_nm2"] - 1
        if abs(mass) > MASS_TOLERANCE[engine]:
            raise Wrong(f"mass of the molecules changed by {mass:.1e} at {row['time_us']} us")
        balance = row.get("energy_balance_relative", 0)
        if abs(balance) > BALANCE_TOLERANCE:
            raise Wrong(f"energy balance broken by {balance:.1e} at {row['time_us']} us")
    if case.rests and abs(rows[-1]["bud_height_nm"]) > 1e-6:
        raise Wrong(f"a membrane without forces moved by {rows[-1]['bud_height_nm']:.1e} nm")


def judge(program, engine, case):
    """What a table says of a run; Wrong with what is wrong about it."""
    with tempfile.TemporaryDirectory() as scratch:
        directory = Path(scratch) / "run"
        try:
            process = run(program, engine, case, directory)
        except subprocess.TimeoutExpired:
            raise Wrong(f"still runs after {LONGEST} s") from None
        code, message = case.ends.get(engine, ENDED_WELL)
        said = process.stderr.strip()
        if process.returncode != code or message not in said or (code == 0 and said):
            raise Wrong(f"ended with {process.returncode}: {said[-300:] or 'no message'}")
        if code == BAD_INPUT[0]:
            return f"refused: {message}"
        rows = rows_of(directory)
        check_rows(rows, engine, case)
        last = rows[-1]
        return f"{message or 'done'}: {len(rows) - 1} steps to {last['time_us']:.3g} us, height {last['bud_height_nm']:.3g} nm"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, help="the command endoflow")
    parser.add_argument("--engine", choices=ENGINES, action="append", help="[both]")
    parser.add_argument("--case", help="only cases whose name contains this")
    parser.add_argument("--quick", action="store_true", help="a few cases of the boundary-integral engine")
    options = parser.parse_args()
    engines = options.engine or (ENGINES[:1] if options.quick else ENGINES)
    cases = [case for case in CASES if (case.quick or not options.quick) and (options.case or "") in case.name]
    wrong = 0
    for engine in engines:
        for case in cases:
            begin = time.monotonic()
            try:
                outcome = judge(options.program.resolve(), engine, case)
            except Wrong as reason:
                wrong += 1
                outcome = f"WRONG: {reason}"
            print(f"{engine:17}  {case.name:28}  {time.monotonic() - begin:6.1f} s  {outcome}", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
