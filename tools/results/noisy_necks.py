"""python3 tools/results/noisy_necks.py RUN -o DIR

Writes what `endoflow infer` is tried with: thirty.csv, neck radii of a run (directory) with normal noise, and study.toml, the
study that docs/results/inference.md shows.
"""

import argparse
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve()
sys.path[0] = str(HERE.parents[1])
sys.path[1:1] = [str(HERE.parents[2]), str(HERE.parents[2] / "python")]

import numpy as np  # noqa: E402

import endoflow  # noqa: E402
from results.places import DOCS  # noqa: E402

#: Times (µs) of the data, their error (nm), and the seed of the noise.
FIRST, LAST, COUNT, ERROR, SEED = 0.2, 0.6, 30, 0.4, 7

#: The block of the page that holds the study.
STUDY = re.compile(r"<!-- file: study\.toml -->\n```text\n(.*?)```", re.S)


def main():
    """Write both files; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path, help="directory of a run")
    parser.add_argument("-o", dest="output", type=Path, required=True, help="directory of the files")
    options = parser.parse_args()
    times = np.linspace(FIRST, LAST, COUNT)
    necks = endoflow.load(options.run).history_at("neck_radius_nm", times) + ERROR * np.random.default_rng(SEED).normal(size=COUNT)
    lines = [f"{time:.10g},{neck:.10g},{ERROR:g}" for time, neck in zip(times, necks)]
    options.output.mkdir(parents=True, exist_ok=True)
    head = "time_us,neck_radius_nm,neck_radius_error_nm"
    (options.output / "thirty.csv").write_text("\n".join([head, *lines]) + "\n", "utf-8")
    page = (DOCS / "results" / "inference.md").read_text("utf-8")
    (options.output / "study.toml").write_text(STUDY.search(page)[1], "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
