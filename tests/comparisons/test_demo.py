"""`make demo`: its runs last until both engines' vesicles have budded, and its page names both times."""

import csv
import json
import os
import re
import subprocess
import sys
import tomllib
import unittest

import locations
from command import CompareTest

ROOT = locations.ROOT

#: How much earlier or later than the converged answer the diffuse engine may bud with the case's layer (docs/results/standard-case.md).
LAYER_ERROR = 0.012

#: tools/demo calls BUILD/endoflow: one whose `run` makes the directories of known runs, and whose other commands are the real ones.
PROGRAM = """#!{python}
import subprocess, sys
from pathlib import Path
sys.path[:0] = {path!r}
import synthetic
if sys.argv[1] == "run":
    engine, directory = sys.argv[2], Path(sys.argv[sys.argv.index("-o") + 1])
    offset = 0.5 if engine == "phase-field" else 0.0
    synthetic.write_run(directory, engine, lambda t: synthetic.budding_membrane(t, 1.0, offset), [0.05 * i for i in range(21)], 300)
else:
    sys.exit(subprocess.run([sys.executable, {comparisons!r}, *sys.argv[1:]]).returncode)
"""


class Demo(CompareTest):
    def test_case_lasts_until_both_have_budded(self):
        case = tomllib.loads((ROOT / "cases" / "demo.toml").read_text(encoding="utf-8"))
        with open(ROOT / "tests" / "reference" / "converged_budding.csv", newline="", encoding="utf-8") as file:
            rows = csv.DictReader(line for line in file if not line.startswith("#"))
            budding = next(float(row["budding_us"]) for row in rows if row["case"] == "standard")
        self.assertEqual(set(case), {"case", "time", "output"}, "any other section would make it another problem")
        self.assertGreater(case["time"]["end"], budding * (1 + LAYER_ERROR))

    def demo(self):
        """tools/demo in the scratch directory, with stand-ins for the program and for mpirun; returns the finished process."""
        build = self.scratch / "build"
        build.mkdir()
        path = [str(ROOT / "tests" / "comparisons"), str(ROOT / "python")]
        for name, text in (
            ("endoflow", PROGRAM.format(python=sys.executable, path=path, comparisons=locations.COMPARISONS)),
            ("mpirun", '#!/bin/sh\nshift 2\nexec "$@"\n'),
        ):
            (build / name).write_text(text)
            (build / name).chmod(0o755)
        return subprocess.run(
            [str(ROOT / "tools" / "demo"), str(build), "2", "boundary-integral", "phase-field"],
            cwd=self.scratch,
            env={**os.environ, "PATH": f"{build}:{os.environ['PATH']}", "ENDOFLOW_PYTHON": sys.executable},
            capture_output=True,
            text=True,
            timeout=1200,
        )

    def test_announcement(self):
        """Before anything else it says how long it takes and what it will show."""
        for engines, minutes in ((["boundary-integral"], "a minute or two"), (["boundary-integral", "phase-field"], "about 9 minutes")):
            words = [str(ROOT / "tools" / "demo"), "--announce", "2", *engines]
            told = subprocess.run(words, capture_output=True, text=True, check=True).stdout
            self.assertIn(f"It takes {minutes} on 2 cores", told)
            self.assertEqual("report.html" in told, len(engines) == 2)
        rule = re.search(r"^demo: (.*)$", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M)[1]
        self.assertEqual(rule.split()[0], "announcement")

    def check_pictures(self):
        """Four moments and a film that ends with the later budding, small enough for a README."""
        from PIL import Image

        with Image.open(self.scratch / "out" / "demo" / "hero.png") as still:
            self.assertGreater(min(still.size), 600)
        with Image.open(self.scratch / "out" / "demo" / "hero.webp") as film:
            self.assertGreater(film.n_frames, 50)
        self.assertLess((self.scratch / "out" / "demo" / "hero.webp").stat().st_size, 1.5e6)

    def test_page_names_both_budding_times(self):
        process = self.demo()
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.check_pictures()
        page = (self.scratch / "out" / "demo" / "report.html").read_text(encoding="utf-8")
        self.assertRegex(page, '<p class="finding">Both engines bud: boundary integral at .* µs, phase field at .* µs, .* nm[.]</p>')
        found = re.findall(r'<dt>Budding, (.*?)</dt><dd class="ink-[ab]">([\d.]+) <span class="unit">µs</span>', page)
        self.assertEqual([engine for engine, _ in found], ["boundary integral", "phase field"])
        budding = json.loads((self.scratch / "out" / "demo" / "metrics.json").read_text())["budding"]
        told = re.search(r"budding time +([\d.]+) µs .*, ([\d.]+) µs ", process.stdout).groups()
        for key, (_, shown), said in zip(("a_us", "b_us"), found, told):
            # Four digits are shown and five said: half a unit of the last one.
            self.assertAlmostEqual(float(shown), budding[key], delta=5e-5)
            self.assertAlmostEqual(float(said), budding[key], delta=5e-6)

class Readme(unittest.TestCase):
    def test_pictures_are_those_of_the_demonstration(self):
        """docs/images/hero.* are what `make hero` copies, and the README shows them."""
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        for name in ("hero.png", "hero.webp"):
            self.assertIn(f"docs/images/{name}", text)
            self.assertLess((ROOT / "docs" / "images" / name).stat().st_size, 1.5e6)


if __name__ == "__main__":
    unittest.main()
