"""The recipes of docs/extending.md for comparisons/, carried out on a copy: a quantity and a study touch one file and one row."""

import json
import shutil
import subprocess
import sys
import unittest

import locations
import synthetic
from scratch import scratch_directory
from studies import StudyTest

STUDY = '''
from pathlib import Path

from comparisons.files import write_table
from comparisons.studies.members import checked_member, load_run
from comparisons.studies.study import Study


class Twice(Study):
    command = "twice"

    def members(self):
        case, ends = self.options.case, ("0.5", "1")
        self.all = [checked_member(end, case, self.output / end, "boundary-integral", [f"time.end={end}"]) for end in ends]
        return self.all

    def evaluate(self, outcomes):
        return [{"end_us": member.name, "height_nm": float(load_run(member).history["bud_height_nm"][-1])} for member in self.all]

    def page(self, rows):
        write_table(self.output / "twice.csv", rows)
        return [f"{len(rows)} rows"]


def run(options):
    return Twice(options, Path("out/twice")).conduct()
'''


class Extending(StudyTest):
    """Each test changes self.copy, which lies where the program's own sources lie."""

    def setUp(self):
        super().setUp()
        self.copy = scratch_directory(self) / "sources"
        for folder in ("comparisons", "python", "cases"):
            shutil.copytree(locations.ROOT / folder, self.copy / folder, ignore=shutil.ignore_patterns("__pycache__"))

    def insert(self, file, before, text):
        """Put a text before the first place of another in a file of the copy."""
        path = self.copy / "comparisons" / file
        head, mark, tail = path.read_text(encoding="utf-8").partition(before)
        path.write_text(head + text + mark + tail, encoding="utf-8")

    def call(self, *arguments):
        """What a command of the copy prints."""
        command = [sys.executable, str(self.copy / "comparisons"), *map(str, arguments)]
        process = subprocess.run(command, capture_output=True, text=True, timeout=600, cwd=self.scratch, env=self.environment())
        self.assertEqual(process.returncode, 0, process.stderr)
        return process.stdout

    def test_a_quantity(self):
        row = '    Quantity("molecule_mass_nm2", "Molecules", "nm²", "all on the membrane", "compared drawn swept"),\n'
        self.insert("measures/quantities.py", '    Quantity(\n        "area_strain_max"', row)
        a, b = synthetic.write_pair(self.scratch, count=3)
        self.call("compare", a, b, "-o", "c")
        metrics = json.loads((self.scratch / "c" / "metrics.json").read_text(encoding="utf-8"))
        self.assertGreater(metrics["times"][-1]["molecule_mass_nm2"]["a"], 0)
        self.assertIn("Molecules (nm²)", (self.scratch / "c" / "report.html").read_text(encoding="utf-8"))
        self.call("sweep", "case.toml", "--vary", "molecules.patch_radius=20,40", "--engine", "boundary-integral", "-o", "s")
        head, *rows = (self.scratch / "s" / "sweep.csv").read_text(encoding="utf-8").splitlines()
        place = head.split(",").index("molecule_mass_nm2")
        self.assertTrue(all(float(line.split(",")[place]) > 0 for line in rows))

    def test_a_study(self):
        (self.copy / "comparisons" / "commands" / "twice.py").write_text(STUDY, encoding="utf-8")
        row = '    "twice": Command("Run twice.", lambda parser: runs_of_a_case(parser, "twice"), "twice.run"),\n'
        self.insert("commands/options.py", '    "certify": Command(', row)
        self.assertIn("2 rows", self.call("twice", "case.toml"))
        self.assertEqual(self.runs(), ["out/twice/0.5 fresh", "out/twice/1 fresh"])
        self.assertIn("2 finished before", self.call("twice", "case.toml"))
        self.assertEqual(self.runs(), [])
        lines = (self.scratch / "out" / "twice" / "twice.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual([line.split(",")[0] for line in lines], ["end_us", "0.5", "1"])


if __name__ == "__main__":
    unittest.main()
