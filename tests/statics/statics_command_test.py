"""`endoflow statics` as a script sees it.

    python3 statics_command_test.py PATH/TO/endoflow
"""

import csv
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1]))

from command_lines import CommandLineTest  # noqa: E402
from scratch import scratch_directory  # noqa: E402

PROGRAM = None


def endoflow(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=1200)


class Statics(CommandLineTest):
    def setUp(self):
        self.root = scratch_directory(self)
        self.output = self.root / "statics"
        self.case = self.root / "case.toml"
        self.case.write_text("[molecules]\npatch_radius = 22\n")

    def rows(self):
        with open(self.output / "history.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_help(self):
        result = endoflow("statics", "--help")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("--continue-in", result.stdout)

    def test_a_state_is_a_complete_run(self):
        result = endoflow("statics", self.case, "-o", self.output, "--disc-mass")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("µs", result.stdout)  # a stationary shape has no progress in time to tell
        record = json.loads((self.output / "run.json").read_text())
        self.assertEqual((record["engine"], record["state"], record["exit_reason"]), ("statics", "finished", "done"))
        self.assertAlmostEqual(record["notes"]["stationary_state"]["curve_length_nm"], 106.46513, delta=1e-4)
        (row,) = self.rows()
        self.assertAlmostEqual(float(row["neck_radius_nm"]), 13.383641, delta=1e-5)
        self.assertEqual(float(row["time_us"]), 0)
        with h5py.File(self.output / "shapes.h5") as file:
            (shape,) = file["shapes"].values()
            self.assertEqual(shape.attrs["time"], 0)
            self.assertTrue((np.diff(shape["s"][:]) > 0).all())
            self.assertEqual(np.abs(shape["u_r"][:]).max(), 0)
        self.assertEqual(endoflow("summary", self.output).returncode, 0)

    def test_a_branch(self):
        result = endoflow("statics", self.case, "-o", self.output, "--set", "molecules.transport=advection",
                          "--continue-in", "molecules.patch_radius=20")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.rows()
        radii = [float(row["patch_radius_nm"]) for row in rows]
        self.assertEqual((radii[0], radii[-1]), (22, 20))
        self.assertEqual(radii, sorted(radii, reverse=True))
        with h5py.File(self.output / "shapes.h5") as file:
            self.assertEqual(len(file["shapes"]), len(rows))
        branch = json.loads((self.output / "run.json").read_text())["notes"]["branch"]
        self.assertEqual((branch["parameter"], branch["end"], branch["folds"]), ("molecules.patch_radius", 20, []))

    def test_a_tube(self):
        self.case.write_text(
            "[domain]\nheight = 300\n"
            "[membrane]\nbending_stiffness = 200\nbending_stiffness_coated = 200\nspontaneous_curvature = 0\n"
            'rim_tension = 0.1\n[molecules]\ntransport = "advection"\n'
        )
        result = endoflow("statics", self.case, "-o", self.output, "--continue-in", "membrane.pole_force=100")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("the membrane reaches the top of the box", result.stdout)
        branch = json.loads((self.output / "run.json").read_text())["notes"]["branch"]
        overshoot = branch["folds"][0]
        self.assertEqual(overshoot["parameter"], "membrane.pole_force")
        self.assertGreater(overshoot["value"], 1.1 * 2 * np.pi * np.sqrt(2 * 100 * 0.1))
        rows = self.rows()
        self.assertGreater(max(float(row["pole_force_pN"]) for row in rows), 33)
        self.assertGreater(float(rows[-1]["pole_extension_nm"]), 200)

    def test_a_mirrored_state(self):
        """Out of the cell: the opposite height, all else the same, to the last digits that are written."""
        rows = []
        for curvature in (0.0709219858, -0.0709219858):
            result = endoflow("statics", self.case, "-o", self.output, "--set", f"membrane.spontaneous_curvature={curvature}")
            self.assertEqual(result.returncode, 0, result.stderr)
            rows.append({key: float(value) for key, value in self.rows()[0].items() if value})
        into, out_of = rows
        self.assertGreater(into["bud_height_nm"], 10)
        for key in ("bud_height_nm", "apex_height_nm", "volume_extracellular_nm3"):
            self.assertAlmostEqual(out_of[key] / into[key], -1, delta=1e-8)
        for key in ("neck_radius_nm", "bud_diameter_nm", "membrane_area_nm2", "bending_energy_pN_nm", "molecule_mass_nm2"):
            self.assertAlmostEqual(out_of[key] / into[key], 1, delta=1e-8)

    def test_a_tube_out_of_the_cell(self):
        self.case.write_text(
            "[domain]\nheight = 160\nmembrane_height = 120\n"
            "[membrane]\nbending_stiffness = 200\nbending_stiffness_coated = 200\nspontaneous_curvature = 0\n"
            'rim_tension = 0.1\n[molecules]\ntransport = "advection"\n'
        )
        result = endoflow("statics", self.case, "-o", self.output, "--continue-in", "membrane.pole_force=-100")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("the membrane reaches the bottom of the box", result.stdout)
        self.assertLess(float(self.rows()[-1]["bud_height_nm"]), -100)

    def test_a_held_neck(self):
        """The force is the potential's derivative, also between the rows."""
        result = endoflow("statics", self.case, "-o", self.output, "--set", "molecules.transport=advection",
                          "--set", "membrane.gaussian_stiffness=-100", "--hold", "neck_radius=12:10")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("barrier_kT", result.stdout)
        rows = self.rows()
        radii, force, work, potential = (
            np.array([float(row[name]) for row in rows])
            for name in ("followed_value", "neck_force_pN", "neck_work_pN_nm", "potential_pN_nm")
        )
        self.assertEqual((radii[0], radii[-1]), (12, 10))
        for row, radius in zip(rows, radii):
            self.assertAlmostEqual(float(row["neck_radius_nm"]), radius, delta=1e-6)  # of a spline through 1001 points
        self.assertLess(np.abs(work - (potential - potential[0])).max(), 1e-4)  # the work is of fourth order in the steps
        self.assertTrue((force < 0).all())
        notes = json.loads((self.output / "run.json").read_text())["notes"]
        self.assertEqual((notes["branch"]["parameter"], notes["branch"]["end"]), ("neck_radius", 10))
        self.assertAlmostEqual(notes["held_neck"]["barrier_kT"] * 4.11, potential[-1] - potential[0], delta=1e-4)
        self.assertAlmostEqual(notes["held_neck"]["scission_energy_pN_nm"], -400 * np.pi, delta=1e-9)
        self.assertEqual(endoflow("summary", self.output).returncode, 0)

    def test_a_neck_too_wide_to_be_held(self):
        result = endoflow("statics", self.case, "-o", self.output, "--set", "molecules.transport=advection",
                          "--hold", "neck_radius=10:20")
        self.assert_refused(result, 3, "held-neck-opens", "a neck of 20 nm is not reached")
        self.assertGreater(len(self.rows()), 5)  # what was found stays

    def test_bad_holds_write_nothing(self):
        for hold, words in (("nonsense", "it must be neck_radius=R1:R2"), ("neck_radius=8", "neck_radius=R1:R2"),
                            ("neck_radius=8:0.5", "'0.5' must be a radius between 1 nm"),
                            ("neck_radius=nan:3", "'nan' must be a radius"), ("neck_radius=90:3", "domain.radius = 80 nm"),
                            ("neck_radius=8:8", "must differ"), ("neck_radius=8:open", "'open' must be a radius")):
            with self.subTest(hold):
                self.assert_refused(endoflow("statics", self.case, "-o", self.output, "--hold", hold), 2, words)
                self.assertFalse(self.output.exists())
        result = endoflow("statics", self.case, "-o", self.output, "--hold", "neck_radius=8:3",
                          "--continue-in", "molecules.patch_radius=20")
        self.assert_refused(result, 2, "exclude each other")

    def test_elements(self):
        """A state's relative_error is what twice the elements change."""
        errors = {}
        for elements in (16, 32):
            result = endoflow("statics", self.case, "-o", self.output, "--elements", elements)
            self.assertEqual(result.returncode, 0, result.stderr)
            notes = json.loads((self.output / "run.json").read_text())["notes"]
            self.assertEqual(notes["elements"], 2 * elements)
            errors[elements] = notes["relative_error"]
        self.assertLess(errors[32], errors[16] / 2**8)  # order 10 at the mesh points
        for elements in (4, 1000000):
            result = endoflow("statics", self.case, "-o", self.output, "--elements", elements)
            self.assert_refused(result, 2, f"--elements {elements}: it must be between 8 and 10000")

    def test_a_case_beyond_the_fold(self):
        result = endoflow("statics", self.case, "-o", self.output, "--set", "molecules.patch_radius=26.5")
        self.assert_refused(result, 3, "no-stationary-state", "molecules.patch_radius = 25.594")
        self.assertEqual(json.loads((self.output / "run.json").read_text())["state"], "failed")

    def test_bad_requests_write_nothing(self):
        for request, words in (("molecules.patch_radius", "END"), ("molecules.patch_radius=x", "number"),
                               ("molecules.patch_radius=90", "domain.radius"), ("molecules.patch_radius=22", "already"),
                               ("molecules.patch_radios=30", "did you mean"), ("time.end=3", "can be continued in"),
                               ("membrane.rim_tension=-0.2", "where the flat membrane buckles"),
                               ("membrane.pole_forse=3", "did you mean 'membrane.pole_force'"),
                               ("molecules.line_energy=30", "can be continued in")):
            with self.subTest(request):
                result = endoflow("statics", self.case, "-o", self.output, "--continue-in", request)
                self.assert_refused(result, 2, words)
                self.assertFalse(self.output.exists())

    def vesicle(self, *arguments):
        self.case.write_text(
            '[domain]\nkind = "free-space"\n[molecules]\npatch_radius = 1e4\n'
            "[membrane]\nbending_stiffness_coated = 100\nspontaneous_curvature = 0\n"
        )
        return endoflow("statics", self.case, "-o", self.output, *arguments)

    def test_a_vesicle(self):
        result = self.vesicle()
        self.assertEqual(result.returncode, 0, result.stderr)
        (row,) = self.rows()
        # A spheroid with axes of 60 and 40 nm.
        self.assertAlmostEqual(float(row["volume_extracellular_nm3"]) / (4 / 3 * np.pi * 40**2 * 60), 1, delta=1e-8)
        self.assertAlmostEqual(float(row["reduced_energy"]) * 8 * np.pi * 50 / float(row["bending_energy_pN_nm"]), 1,
                               delta=1e-8)  # the state's own integral, and the one over the written curve
        self.assertEqual(row["neck_radius_nm"], "")
        with h5py.File(self.output / "shapes.h5") as file:
            (shape,) = file["shapes"].values()
            self.assertEqual((shape["r"][0], shape["r"][-1]), (0, 0))
            self.assertAlmostEqual(shape["z"][0] + shape["z"][-1], 2 * 80, delta=1e-9)
            self.assertEqual(np.ptp(shape["lambda"][:]), 0)
            self.assertLess(shape["kappa"][500], shape["kappa"][0])  # a prolate is more curved at its poles

    def test_a_branch_of_vesicles(self):
        result = self.vesicle("--continue-in", "domain.spheroid_polar_axis=120")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.rows()
        volumes = [float(row["reduced_volume"]) for row in rows]
        self.assertEqual(volumes, sorted(volumes, reverse=True))
        energies = [float(row["reduced_energy"]) for row in rows]
        self.assertEqual(energies, sorted(energies))

    def test_the_followed_value_stands_in_the_table(self):
        """A branch in C goes from the case's 0 to what was asked for; its unit stands beside it."""
        result = self.vesicle("--continue-in", "membrane.spontaneous_curvature=0.002")
        self.assertEqual(result.returncode, 0, result.stderr)
        values = [float(row["followed_value"]) for row in self.rows()]
        self.assertEqual(values[0], 0)
        self.assertAlmostEqual(values[-1], 0.002, delta=1e-12)  # round-off of the last step
        self.assertEqual(values, sorted(values))
        branch = json.loads((self.output / "run.json").read_text())["notes"]["branch"]
        self.assertEqual((branch["parameter"], branch["unit"]), ("membrane.spontaneous_curvature", "1/nm"))

    def test_a_stomatocyte(self):
        result = self.vesicle("--family", "stomatocyte", "--set", "domain.spheroid_polar_axis=11")
        self.assertEqual(result.returncode, 0, result.stderr)
        (row,) = self.rows()
        self.assertLess(float(row["reduced_volume"]), 0.66)
        self.assertAlmostEqual(float(row["reduced_energy"]), 1.98, delta=0.02)  # docs/statics.md

    def test_bad_vesicles_write_nothing(self):
        for arguments, word in ((("--set", "molecules.patch_radius=36", "--set", "membrane.spontaneous_curvature=0.07"),
                                 "patch_radius"),
                                (("--set", "domain.spheroid_polar_axis=40"), "sphere"),
                                (("--family", "pear"), "prolate, oblate or stomatocyte"),
                                (("--disc-mass",), "--disc-mass"),
                                (("--hold", "neck_radius=8:3"), "--hold does not go with a vesicle"),
                                (("--continue-in", "molecules.patch_radius=30"), "can be continued in")):
            with self.subTest(arguments):
                self.assert_refused(self.vesicle(*arguments), 2, word)
                self.assertFalse(self.output.exists())
        self.case.write_text("")
        self.assert_refused(endoflow("statics", self.case, "-o", self.output, "--family", "oblate"), 2, "free-space")

    def test_an_extensible_membrane_is_refused(self):
        result = endoflow("statics", self.case, "-o", self.output, "--set", "membrane.inextensible=false")
        self.assert_refused(result, 2, "membrane.inextensible")
        self.assertFalse(self.output.exists())


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
