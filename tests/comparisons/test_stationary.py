"""A stationary shape beside a run in `endoflow compare`."""

import json
import unittest
from dataclasses import dataclass

import locations  # noqa: F401
import numpy as np
from scratch import scratch_directory

import endoflow
import synthetic
from command import compare
from endoflow.curves import area_from_axis
from comparisons.measures.along import side_by_side

DURATION = 1.0
TIMES = np.linspace(0.0, DURATION, 9)


def at_rest(_time):
    """Where the run of `membrane_at` ends."""
    return synthetic.budding_membrane(DURATION, DURATION)


@dataclass(frozen=True)
class Spheroid:
    """A closed membrane around z = 80 nm, from pole to pole; axes in nm."""

    polar: float
    equatorial: float = 40.0
    z0: float = 80.0
    neck_radius: float = np.nan
    bud_diameter: float = np.nan

    @property
    def bud_height(self):
        return 2 * self.polar

    @property
    def area(self):
        r, z, _ = self.curve(2000)
        return area_from_axis(r, z)[-1]

    def curve(self, points):
        angle = np.linspace(0, np.pi, points)
        r, z = self.equatorial * np.sin(angle), self.z0 + self.polar * np.cos(angle)
        r[-1] = 0.0
        return r, z, 0 * r + 2 / self.equatorial


class BesideARun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = scratch_directory(cls)
        cls.moving = synthetic.write_run(
            cls.scratch / "run", "boundary-integral", lambda t: synthetic.budding_membrane(t, DURATION), TIMES
        )
        cls.statics = synthetic.write_run(cls.scratch / "statics", "statics", at_rest, [0.0])
        cls.branch = synthetic.write_run(cls.scratch / "branch", "statics", at_rest, [0.0, 1.0, 2.0])

    def metrics_of(self, a, b):
        process = compare(a, b, "-o", self.scratch / "comparison")
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertTrue((self.scratch / "comparison" / "report.html").exists())
        return json.loads((self.scratch / "comparison" / "metrics.json").read_text())

    def test_it_holds_at_all_times_of_the_run(self):
        for pair in ((self.moving, self.statics), (self.statics, self.moving)):
            metrics = self.metrics_of(*pair)
            self.assertEqual([record["time_us"] for record in metrics["times"]], list(TIMES))
            self.assertTrue(all(record["interpolated"] == [] for record in metrics["times"]))
            # The run ends in this very shape and is further from it the earlier it is.
            distances = [record["mean_distance_nm"] for record in metrics["times"]]
            self.assertEqual(metrics["summary"]["final_hausdorff_distance_nm"], 0.0)
            self.assertEqual(metrics["times"][-1]["membrane_area_nm2"]["difference"], 0.0)
            self.assertEqual(metrics["finding"], f"At {DURATION:g} µs the boundary integral run is within 0 nm of the stationary shape.")
            self.assertTrue(np.all(np.diff(distances) < 0), distances)

    def test_its_history_is_constant(self):
        run, held = side_by_side(endoflow.load(self.moving), endoflow.load(self.statics))
        self.assertEqual(len(held.shapes), len(run.shapes))
        for time in (0.0, 0.3, DURATION):
            self.assertEqual(held.history_at("membrane_area_nm2", time), run.history["membrane_area_nm2"][-1])

    def test_two_stationary_shapes(self):
        metrics = self.metrics_of(self.statics, self.statics)
        self.assertEqual(metrics["finding"], "The two stationary shapes differ by at most 0 nm.")
        self.assertEqual(metrics["summary"]["max_hausdorff_distance_nm"], 0.0)

    def test_a_vesicle(self):
        run = synthetic.write_run(
            self.scratch / "vesicle", "boundary-integral", lambda t: Spheroid(60.0 - 2 * t), TIMES
        )
        at_rest = synthetic.write_run(self.scratch / "vesicle_statics", "statics", lambda _: Spheroid(58.0), [0.0])
        other = synthetic.write_run(self.scratch / "other", "phase-field", lambda t: Spheroid(60.0 - t), TIMES)
        self.assertRegex(self.metrics_of(run, other)["finding"], "^Two closed membranes, compared until .* µs: the membranes never differ by")
        summary = self.metrics_of(run, at_rest)["summary"]
        self.assertAlmostEqual(summary["max_hausdorff_distance_nm"], 2.0, delta=1e-3)  # between the poles
        self.assertAlmostEqual(summary["final_hausdorff_distance_nm"], 0.0, delta=1e-9)

    def test_a_branch_is_refused(self):
        process = compare(self.moving, self.branch, "-o", self.scratch / "never")
        self.assertEqual(process.returncode, 4)
        self.assertRegex(process.stderr, "branch of 3 stationary shapes.*--continue-in")
        self.assertEqual(process.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
