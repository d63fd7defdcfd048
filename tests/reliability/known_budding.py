"""What the sharp engine's accuracy is worth: runs without any override against budding times that are known better.

    python3 tests/reliability/known_budding.py build/endoflow                # default accuracy, all cases
    python3 tests/reliability/known_budding.py build/endoflow --certify      # and whether their certificates hold
    python3 tests/reliability/known_budding.py build/endoflow --cases standard --certify

tests/reference/converged_budding.csv has the cases and their converged times. Prints a table. Ends with 1 when a time
is off by more than twice boundary_integral.accuracy, or when fewer than nine of ten certificates hold the converged time.
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
ALLOWED = 2  # times boundary_integral.accuracy
LEAST_COVERAGE = 0.9
# Budding ends the run: its time is what is compared, nothing else is written.
SETTINGS = ("output.stop_at_budding=true", "output.field_interval=0", "output.shape_interval=1")


@dataclass
class Known:
    name: str
    settings: tuple  # "section.key=value"
    end: str  # µs, later than budding
    budding: float  # µs
    error: float  # µs


def known_cases():
    """The reference's rows."""
    text = (ROOT / "tests" / "reference" / "converged_budding.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return [
        Known(
            row["case"], tuple(row["settings"].split()), row["end_us"], float(row["budding_us"]), float(row["error_us"])
        )
        for row in rows
    ]


def run(program, known, directory, certify):
    """The run.json of a run with default accuracy."""
    case = ROOT / "cases" / "standard.toml"
    words = [program, "run", "boundary-integral", case, "-o", directory, "--until", known.end]
    words += engines.options((*known.settings, *SETTINGS))
    words += ["--certify"] if certify else []
    subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL)
    return json.loads((directory / "run.json").read_text(encoding="utf-8"))


def measured(known, record):
    """(row of the table, whether the time is accurate, whether the certificate holds or None)."""
    budding = record["events"]["budding"]["time_us"]
    accuracy = record["parameters"]["boundary_integral"]["accuracy"]
    off = abs(budding - known.budding)
    accurate = off <= ALLOWED * accuracy * known.budding + known.error
    entry = record.get("certificate", {}).get("values", {}).get("budding_time_us")
    holds = None if entry is None else off <= entry["error"] + known.error
    elements = " → ".join(str(count["elements"]) for count in record["notes"]["elements_from"])
    row = [known.name, elements, f"{budding:.6f}", f"{known.budding:.6f}", f"{off / known.budding:.1e}"]
    row += [f"{record['accuracy']['resolution']['largest']:.1e}", f"{record['cpu_s']:.1f}"]
    row += [] if entry is None else [f"{entry['error'] / known.budding:.1e}", "yes" if holds else "no"]
    return row, accurate, holds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--cases", help="names of the reference's cases, with commas between")
    parser.add_argument("--certify", action="store_true", help="certify each run, and count the certificates that hold")
    options = parser.parse_args()
    wanted = known_cases()
    if options.cases:
        names = options.cases.split(",")
        if unknown := set(names) - {known.name for known in wanted}:
            parser.error(f"--cases: the reference has no {', '.join(sorted(unknown))}")
        wanted = [known for known in wanted if known.name in names]
    head = ["case", "elements", "budding, µs", "converged, µs", "off by", "estimate", "processor time, s"]
    head += ["certified error", "holds"] if options.certify else []
    print("| " + " | ".join(head) + " |\n|" + " --- |" * len(head))
    outcomes = []
    with tempfile.TemporaryDirectory() as scratch:
        for known in wanted:
            record = run(options.program.resolve(), known, Path(scratch) / known.name, options.certify)
            row, *outcome = measured(known, record)
            outcomes.append(outcome)
            print("| " + " | ".join(row) + " |", flush=True)
    inaccurate = sum(not accurate for accurate, _ in outcomes)
    certificates = [holds for _, holds in outcomes if holds is not None]
    print(f"{len(outcomes) - inaccurate} of {len(outcomes)} within {ALLOWED} times the accuracy asked for", end="")
    print(f"; {sum(certificates)} of {len(certificates)} certificates hold" if certificates else "")
    missing = options.certify and len(certificates) < len(outcomes)
    return 1 if inaccurate or missing or sum(certificates) < LEAST_COVERAGE * len(certificates) else 0


if __name__ == "__main__":
    sys.exit(main())
