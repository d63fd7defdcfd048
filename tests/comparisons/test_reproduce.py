"""`endoflow reproduce` with a program that writes runs in closed form: what is run, shared, refused, and written."""

import csv
import json
import re
import unittest
from dataclasses import replace
from pathlib import Path

import locations  # noqa: F401
import numpy as np
import endoflow
import synthetic
from endoflow.shapes import Shape
from comparisons.paper import NAMES, fig6, patch_sweep
from comparisons.paper.fig4 import pinch_off_time
from command import unnamed_basis
from studies import StudyTest

#: Keys of cases/*.toml and of the items' settings that synthetic.parameters lacks, and their values.
OTHER_KEYS = {
    "fluid": {"normal_mobility": 5.345},
    "membrane": {"constitutive_law": "linear", "inextensible": True},
    "molecules": {"diffusivity": 16.0, "mobility": 64e3},
    "phase_field": {
        "scheme": "paper",
        "cell_size": 0.0,
        "far_refinements": 3.0,
        "degree": 3.0,
        "velocity_degree": 3.0,
        "tension_degree": 2.0,
        "surface_degree": 3.0,
        "paper": {
            "mobility": 0.0064,
            "tension_extension": 0.39,
            "stretching_relaxation": 0.05,
            "profile_mobility": 600.0,
            "advection_centering": 0.5,
            "force_centering": 1.0,
            "bending_unknown": "moment",
            "force_sign": "plus",
            "step_rule": "guarded",
            "ramp_steps": 10.0,
            "max_step": 0.002,
        },
    },
    "boundary_integral": {"mesh_relaxation_time": 0.002},
    "time": {"initial_step": 0.0},
    "output": {"field_interval": 0.5},
}


class Reproduce(StudyTest):
    def setUp(self):
        super().setUp()
        file = self.scratch / "defaults.json"
        defaults = json.loads(file.read_text())
        for section, values in OTHER_KEYS.items():
            defaults.setdefault(section, {}).update(values)
        file.write_text(json.dumps(defaults))

    def reproduce(self, *arguments):
        return self.call("reproduce", *arguments, "-o", "p")

    def rows(self, item):
        with open(self.scratch / f"p/{item}/{item}.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def page(self, item):
        """The page's text without embedded pictures."""
        return re.sub(r"data:image[^\"]*", "", (self.scratch / f"p/{item}/report.html").read_text())

    def test_items_share_runs_and_finished_ones_are_not_repeated(self):
        process = self.reproduce("fig7", "--engine", "boundary-integral", "--until", "1")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        first = self.runs()
        self.assertEqual(len(first), len(patch_sweep.RADII))
        self.assertIn("p/runs/standard,patch_radius=38/boundary-integral fresh", first)
        process = self.reproduce("fig6", "fig7", "--engine", "boundary-integral", "--until", "0.5")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertEqual(self.runs(), [], "runs that went on longer serve as well")
        self.assertNotIn("phase-field rows", self.page("fig7"), "there are none")
        self.assertEqual(unnamed_basis(self.page("fig7")), [])
        self.reproduce("figA2", "--until", "1")
        left = [
            f"p/runs/standard,constitutive_law={law}/boundary-integral fresh" for law in ("coarse-grained", "lumped")
        ]
        self.assertEqual(self.runs(), left, "the linear law is the standard case")

    def test_table_of_fig7(self):
        self.reproduce("fig7", "--quick", "--until", "1")
        rows = self.rows("fig7")
        of = {(float(row["patch_radius_nm"]), row["engine"]): row for row in rows}
        self.assertEqual(len(of), len(patch_sweep.RADII) + len(patch_sweep.QUICK_RADII))
        # The synthetic membrane buds at 0.7346 µs whatever the patch.
        self.assertAlmostEqual(float(of[36, "boundary-integral"]["budding_time_us"]), 0.7346, places=3)
        self.assertEqual(of[36, "phase-field"]["budding_time_us"], "", "quick phase-field runs end at 0.5 µs")
        for name in ("fig7.png", "fig7.svg"):
            self.assertGreater((self.scratch / "p/fig7" / name).stat().st_size, 1000)
        page = self.page("fig7")
        for words in ("fastest patch", ">36<", "experiment 41.1 ± 0.1", "What differs, and why"):
            self.assertIn(words, page)
        self.assertIn("fig7/report.html", (self.scratch / "p/index.html").read_text())

    def test_a_refused_run_is_reported_not_fatal(self):
        process = self.reproduce("fig4", "--quick", "--until", "1")
        self.assertEqual(process.returncode, 0)
        self.assertEqual(
            process.stderr,
            'endoflow reproduce: geometric/boundary-integral: not run: fluid.dynamics: the boundary-integral engine offers "flow"\n',
        )
        self.assertIn("not run: fluid.dynamics", self.page("fig4"))
        states = {(row["dynamics"], row["engine"]): row["state"] for row in self.rows("fig4")}
        self.assertRegex(states["geometric", "boundary-integral"], "not run: fluid.dynamics")
        self.assertEqual(states["geometric", "phase-field"], "done")

    def test_unknown_parameters_are_a_reason_too(self):
        process = self.reproduce("table2", "--set", "phase_field.no_such=1")
        self.assertEqual(process.returncode, 3)
        self.assertIn("unknown key phase_field.no_such", process.stderr)
        self.assertIn("not run", self.page("table2"))

    def test_every_item_is_written(self):
        process = self.reproduce("all", "--quick", "--until", "0.2")
        self.assertEqual(process.returncode, 0, process.stderr)
        for item in NAMES:
            self.assertTrue(self.rows(item), item)
            self.assertIn("The paper beside this", self.page(item))
            self.assertTrue((self.scratch / f"p/{item}/{item}.png").exists(), item)

    def test_pages_of_the_runs_there_are(self):
        process = self.reproduce("fig7", "--engine", "boundary-integral", "--until", "1", "--pages-only")
        self.assertEqual((process.returncode, self.runs()), (3, []))
        self.assertIn("not run yet, about", process.stderr)
        self.reproduce("figA2", "--until", "1")
        process = self.reproduce("figA2", "fig7", "--engine", "boundary-integral", "--until", "1", "--pages-only")
        self.assertEqual(process.returncode, 0)
        with open(self.scratch / "p/runs.csv", newline="", encoding="utf-8") as file:
            rows = {row["run"]: row for row in csv.DictReader(file)}
        self.assertEqual(rows["standard/boundary-integral"]["left_s"], "0")
        self.assertEqual(rows["standard,patch_radius=60/boundary-integral"]["state"], "not run")
        self.assertGreater(float(rows["standard,patch_radius=60/boundary-integral"]["left_s"]), 0)

    def test_relative_changes_of_table2(self):
        self.reproduce("table2", "--quick")
        rows = {(row["parameter"], row["printed_value"]): row for row in self.rows("table2")}
        self.assertEqual(rows["ε", "2.4"]["paper_change_percent"], "8.53")
        self.assertEqual(rows["ε", "1.2"]["change_percent"], "0")
        areas = [float(rows["ε", value]["area_nm2"]) for value in ("2.4", "1.2")]
        self.assertAlmostEqual(
            float(rows["ε", "2.4"]["change_percent"]), 100 * abs(areas[0] - areas[1]) / areas[1], places=6
        )

    def test_bad_command_lines(self):
        self.assertEqual(self.reproduce("fig2").returncode, 2)
        self.assertEqual(self.reproduce("fig3", "--quick", "--full").returncode, 2)
        self.assert_one_line(
            self.reproduce("fig3", "--set", "epsilon=1"), 2, "--set epsilon: it must read section.key=value"
        )


class PinchOff(unittest.TestCase):
    """When a neck has closed, from a run's history."""

    def run_with(self, neck, budding, reason="done"):
        history = {"time_us": np.arange(len(neck), dtype=float), "neck_radius_nm": np.array(neck)}
        events = {} if budding is None else {"budding": {"time_us": budding}}
        return endoflow.Run(Path("."), {"events": events, "exit_reason": reason}, {}, history, [])

    def test_times(self):
        nan = np.nan
        for neck, budding, reason, wanted in (
            ([nan, 9, 6, 4, 2, nan, nan], 2.5, "done", 5.0),  # the run went on with the membrane that is left
            ([nan, 9, 6, 4, 2], 2.5, "neck-closed", 4.0),
            ([nan, 9, 6, 4, 2], 2.5, "done", None),  # still open
            ([nan, 9, nan, nan], None, "done", None),  # the bud went back
        ):
            with self.subTest(neck=neck, reason=reason):
                self.assertEqual(pinch_off_time(self.run_with(neck, budding, reason)), wanted)


class Morphology(unittest.TestCase):
    def shape(self, alpha):
        membrane = synthetic.SphereOnPlane(20.0, 8.0, 80.0, alpha)
        r, z, kappa = membrane.curve(2000)
        s = synthetic.arc_length(r, z)
        return membrane, Shape(0.0, s, r, z, 0 * s, 0 * s, kappa, 0 * s, 0 * s)

    def test_a_sphere_is_round(self):
        membrane, shape = self.shape(2.9)
        index = patch_sweep.neck_index(shape)
        self.assertAlmostEqual(shape.r[index], membrane.neck_radius, delta=0.05)
        # A sphere without a cap of 180° − 2.9 rad: nearly round; the fillet above the neck adds a little area.
        self.assertAlmostEqual(patch_sweep.roundness(shape, index), 1, delta=0.05)
        self.assertEqual(patch_sweep.underside(shape, index), 0)
        self.assertEqual(patch_sweep.morphology(shape), "spherical")

    def test_an_underside_that_rises_makes_a_mushroom(self):
        _, shape = self.shape(2.9)
        index = patch_sweep.neck_index(shape)
        lifted = np.exp(-(((np.arange(len(shape)) - index + 60) / 30) ** 2)) * (np.arange(len(shape)) <= index)
        for height, kind in ((0.2, "spherical"), (8.0, "mushroom")):
            raised = replace(shape, z=shape.z + height * lifted)
            self.assertEqual(patch_sweep.morphology(raised), kind)

    def test_no_neck(self):
        _, shape = self.shape(1.2)
        self.assertIsNone(patch_sweep.neck_index(shape))
        self.assertEqual(patch_sweep.morphology(shape), "no neck")

    def test_parabola_through_the_lowest_points(self):
        x = np.array([20.0, 30.0, 40.0, 50.0])
        self.assertEqual(np.round(patch_sweep.best(x, np.exp(((x - 37) / 9) ** 2) * 2), 9).tolist(), [37.0, 2.0])
        self.assertEqual(patch_sweep.best(x, x), (20.0, 20.0))
        self.assertIsNone(patch_sweep.best(x[:0], x[:0]))

    def test_necks_that_closed_are_the_smallest(self):
        columns = ("patch_radius_nm", "engine", "state", "neck_radius_nm", "neck_radius_at_1_us_nm")
        values = ((24, "done", 10.0, 11.0), (28, "neck-closed", 0.5, 6.0), (32, "neck-closed", 0.5, 4.0))
        rows = [dict(zip(columns, (radius, "sharp", *rest))) for radius, *rest in values]
        self.assertEqual(fig6.neck_minimum(rows, "sharp", "neck_radius_nm"), "28, 32 (closed)")
        self.assertEqual(fig6.neck_minimum(rows, "sharp", "neck_radius_at_1_us_nm"), "32 (neck 4 nm)")


if __name__ == "__main__":
    unittest.main()
