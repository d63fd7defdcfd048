"""A stationary shape beside a run in `endoflow compare`."""

import json
import tempfile
import unittest
from pathlib import Path

import locations  # noqa: F401
import numpy as np

import endoflow
import synthetic
from command import compare
from stationary import side_by_side

DURATION = 1.0
TIMES = np.linspace(0.0, DURATION, 9)


def at_rest(_time):
    """Where the run of `membrane_at` ends."""
    return synthetic.budding_membrane(DURATION, DURATION)


class BesideARun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.scratch = Path(scratch.name)
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
            self.assertTrue(np.all(np.diff(distances) < 0), distances)

    def test_its_history_is_constant(self):
        run, held = side_by_side(endoflow.load(self.moving), endoflow.load(self.statics))
        self.assertEqual(len(held.shapes), len(run.shapes))
        for time in (0.0, 0.3, DURATION):
            self.assertEqual(held.history_at("membrane_area_nm2", time), run.history["membrane_area_nm2"][-1])

    def test_two_stationary_shapes(self):
        metrics = self.metrics_of(self.statics, self.statics)
        self.assertEqual(metrics["summary"]["max_hausdorff_distance_nm"], 0.0)

    def test_a_branch_is_refused(self):
        process = compare(self.moving, self.branch, "-o", self.scratch / "never")
        self.assertEqual(process.returncode, 4)
        self.assertRegex(process.stderr, "branch of 3 stationary shapes.*--continue-in")
        self.assertEqual(process.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
