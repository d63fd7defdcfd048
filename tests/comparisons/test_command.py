"""The command `compare`: its files, exit codes and messages."""

import json
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import locations
import synthetic

PLOTS = ("membranes", "outlines", "histories", "distances")


def compare(*arguments):
    """Run compare.py; returns the finished process with its text."""
    return subprocess.run(
        [sys.executable, str(locations.COMPARE), *map(str, arguments)], capture_output=True, text=True, timeout=60
    )


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.scratch = Path(scratch.name)
        cls.a, cls.b = synthetic.write_pair(cls.scratch, count=9)

    def assert_one_line(self, process, code, pattern):
        self.assertEqual(process.returncode, code, process.stderr)
        self.assertRegex(process.stderr, pattern)
        self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
        self.assertEqual(process.stdout, "")

    def test_writes_everything(self):
        output = self.scratch / "deep" / "out"
        process = compare(self.a, self.b, "-o", output)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertIn(str(output / "report.html"), process.stdout)
        self.assertEqual(json.loads((output / "metrics.json").read_text())["schema_version"], 1)
        for name in PLOTS:
            self.assertEqual((output / f"{name}.png").read_bytes()[:4], b"\x89PNG")
            self.assertIn("<svg", (output / f"{name}.svg").read_text())
        self.assertLess((output / "report.html").stat().st_size, 5e6)

    def test_run_against_itself(self):
        output = self.scratch / "itself"
        process = compare(self.a, self.a, "-o", output)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        metrics = json.loads((output / "metrics.json").read_text())
        self.assertEqual(metrics["summary"]["max_hausdorff_distance_nm"], 0)
        self.assertNotEqual(metrics["runs"]["a"]["label"], metrics["runs"]["b"]["label"])

    def test_runs_without_a_bud_and_a_single_shape(self):
        flat = synthetic.write_run(
            self.scratch / "flat", "phase-field", lambda t: synthetic.budding_membrane(0.05 * t, 1.0), [0.0]
        )
        process = compare(flat, self.a, "-o", self.scratch / "single")
        self.assertEqual((process.returncode, process.stderr), (0, ""))

    def test_bad_command_line(self):
        for arguments in ((), (self.a,), (self.a, self.b, "--nonsense"), (self.a, self.b, "-o")):
            process = compare(*arguments)
            self.assertEqual(process.returncode, 2)
            self.assertIn("usage: endoflow compare", process.stderr)

    def test_missing_run(self):
        self.assert_one_line(
            compare(self.a, self.scratch / "absent"),
            4,
            "endoflow compare: .*absent: no such directory; give the directory",
        )

    def test_damaged_run(self):
        broken = self.scratch / "broken"
        broken.mkdir()
        for name in ("run.json", "history.csv"):
            (broken / name).write_bytes((self.b / name).read_bytes())
        self.assert_one_line(compare(self.a, broken), 4, "shapes.h5: the file is missing; repeat the run")

    def test_no_common_time(self):
        late = synthetic.write_run(
            self.scratch / "late", "phase-field", lambda t: synthetic.budding_membrane(1.0, 1.0), [2.0, 3.0]
        )
        self.assert_one_line(compare(self.a, late), 4, "no common time")

    def test_output_cannot_be_written(self):
        (self.scratch / "file").write_text("")
        process = compare(self.a, self.b, "-o", self.scratch / "file" / "out")
        self.assert_one_line(process, 4, "file.*: Not a directory; choose another directory with -o")

    def test_differing_cases_warn(self):
        case = synthetic.parameters(molecules__patch_radius=40.0)
        other = synthetic.write_run(
            self.scratch / "other", "phase-field", lambda t: synthetic.budding_membrane(t, 1.0), [0.0, 1.0], 100, case
        )
        process = compare(self.a, other, "-o", self.scratch / "warned")
        self.assertEqual(process.returncode, 0)
        self.assertIn("warning: the cases differ in molecules.patch_radius: 36.0 (A), 40.0 (B)", process.stderr)

    def test_interrupted(self):
        output = self.scratch / "interrupted"
        process = subprocess.Popen(
            [sys.executable, str(locations.COMPARE), str(self.a), str(self.b), "-o", str(output)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        while not (output / "metrics.json").exists() and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)
        self.assertNotIn("Traceback", errors)


if __name__ == "__main__":
    unittest.main()
