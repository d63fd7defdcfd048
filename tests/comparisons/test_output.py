"""What `endoflow compare` writes."""

import json
import unittest

import locations  # noqa: F401
import synthetic
from command import CompareTest, compare

PLOTS = ("membranes", "outlines", "concentration", "histories", "distances")


class Output(CompareTest):
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

    def test_one_run_ends_before_the_other_buds(self):
        """The common times end at 0.5 µs, budding is at 0.73 µs, and the longer run's history at 5 µs."""
        long = synthetic.write_run(
            self.scratch / "long",
            "boundary-integral",
            lambda t: synthetic.budding_membrane(min(t, 1.0), 1.0),
            [0.25 * i for i in range(21)],
            100,
        )
        short = synthetic.write_run(
            self.scratch / "short", "phase-field", lambda t: synthetic.budding_membrane(t, 1.0), [0.0, 0.25, 0.5], 100
        )
        process = compare(long, short, "-o", self.scratch / "unequal")
        self.assertEqual((process.returncode, process.stderr), (0, ""))

    def test_differing_cases_warn(self):
        case = synthetic.parameters(molecules__patch_radius=40.0)
        other = synthetic.write_run(
            self.scratch / "other", "phase-field", lambda t: synthetic.budding_membrane(t, 1.0), [0.0, 1.0], 100, case
        )
        process = compare(self.a, other, "-o", self.scratch / "warned")
        self.assertEqual(process.returncode, 0)
        self.assertIn("warning: the cases differ in molecules.patch_radius: 36.0 (A), 40.0 (B)", process.stderr)


if __name__ == "__main__":
    unittest.main()
