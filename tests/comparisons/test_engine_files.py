"""The reader's names against the files the engines write: both say what a run's directory holds.

    ENDOFLOW_PROGRAM=build/endoflow python3 tests/comparisons/test_engine_files.py
"""

import unittest

import locations  # noqa: F401
import h5py
import numpy as np

import endoflow
from endoflow.shapes import FIELDS
from engines import tiny_run


class EngineFiles(unittest.TestCase):
    def check(self, name):
        directory = tiny_run(self, name, "time.end=1e-4", "output.field_interval=0", "output.shape_interval=5e-5")
        with h5py.File(directory / "shapes.h5") as file:
            self.assertEqual(set(file["shapes/000000"]), set(FIELDS))
        run = endoflow.load(directory)
        self.assertEqual(list(run.history), list(run.columns))
        self.assertTrue(run.columns["bud_height_nm"].startswith("z of the point farthest from the rim's plane"))
        self.assertNotIn("", run.columns.values())
        self.assertEqual(run.engine, name.split(",")[0])
        # An interval of 5e-5 µs is halved towards the start.
        early = [5e-5 / 2**k for k in range(8, 0, -1)]
        np.testing.assert_allclose(run.shape_times, [0, *early, 5e-5, 1e-4], rtol=1e-9)
        self.assertNotIn(None, run.history_units.values())
        self.assertEqual(run.parameters["molecules"]["patch_radius"], 36.0)
        # What history.csv and shapes.h5 say of the same moment agrees: the apex to the last digits written.
        height = run.shapes[-1].z.max() - run.shapes[-1].z[-1]
        self.assertAlmostEqual(run.history["bud_height_nm"][-1], height, delta=1e-3)

    def test_boundary_integral(self):
        self.check("boundary-integral")

    def test_phase_field(self):
        self.check("phase-field")

    def test_phase_field_scheme_paper(self):
        self.check("phase-field,paper")


if __name__ == "__main__":
    unittest.main()
