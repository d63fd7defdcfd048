"""Metrics of two runs of a family known in closed form."""

import json
import unittest
from dataclasses import replace

import locations  # noqa: F401
import numpy as np
from scratch import scratch_directory

import endoflow
import synthetic
from comparisons.measures.words import NOT_RECORDED, basis, rounded_up
from comparisons.measures.distances import InterpolationError
from comparisons.measures.metrics import (
    NoCommonTimeError,
    case_differences,
    common_times,
    compare_runs,
    pair,
    patch_area,
)

OFFSET = 0.5
LABELS = ("first", "second")


class ParallelRuns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        a, b = synthetic.write_pair(scratch_directory(cls), OFFSET)
        cls.metrics = compare_runs(endoflow.load(a), endoflow.load(b), LABELS)

    def test_what_the_numbers_rest_on(self):
        resolution = "32 elements, time tolerance 1·10⁻⁴"
        for run in self.metrics["runs"].values():
            self.assertEqual((run["basis"]["curvature convention"], run["basis"]["resolution"]), ("as-printed", resolution))
        self.assertEqual(basis({"parameters": {"membrane": {}}})["resolution"], NOT_RECORDED)

    def test_distances_equal_the_offset_at_every_time(self):
        self.assertEqual(len(self.metrics["times"]), 21)
        for record in self.metrics["times"]:
            self.assertEqual(record["interpolated"], [])
            # 300 points on about 150 nm: interpolation at the curvature jumps errs by 0.2/nm · h²/16 ≈ 3e-3 nm at h = 0.5 nm.
            self.assertAlmostEqual(record["mean_distance_nm"], OFFSET, delta=1e-3)
            self.assertAlmostEqual(record["hausdorff_distance_nm"], OFFSET, delta=4e-3)

    def test_quantities_differ_as_the_family_says(self):
        for record in self.metrics["times"]:
            inner = synthetic.budding_membrane(record["time_us"], 1.0)
            outer = synthetic.budding_membrane(record["time_us"], 1.0, OFFSET)
            self.assertAlmostEqual(record["membrane_area_nm2"]["a"], inner.area, delta=1e-6)
            self.assertAlmostEqual(record["membrane_area_nm2"]["difference"], outer.area - inner.area, delta=1e-6)
            if np.isnan(inner.neck_radius):
                self.assertEqual(
                    record["neck_radius_nm"], {"a": None, "b": None, "difference": None, "relative_difference": None}
                )
            else:
                self.assertAlmostEqual(record["neck_radius_nm"]["difference"], OFFSET, delta=1e-9)
                self.assertAlmostEqual(record["bud_diameter_nm"]["difference"], 2 * OFFSET, delta=1e-9)

    def test_concentration_depends_on_area_alike(self):
        """Both runs carry the same profile of c against area, so only discretisation differs."""
        for record in self.metrics["times"]:
            self.assertLess(record["concentration_l1_relative"], 5e-4)
            self.assertLess(record["concentration_max"], 4e-3)
            self.assertLess(abs(record["patch_area_difference_nm2"]), 1.0)

    def test_budding_times(self):
        neck_at = [
            synthetic.budding_membrane(self.metrics["budding"][key], 1.0, offset).neck_radius
            for key, offset in (("a_us", 0), ("b_us", OFFSET))
        ]
        np.testing.assert_allclose(neck_at, 5.0, atol=1e-9)
        self.assertGreater(self.metrics["budding"]["difference_us"], 0)

    def test_summary(self):
        summary = self.metrics["summary"]
        self.assertAlmostEqual(summary["time_mean_of_mean_distance_nm"], OFFSET, delta=1e-3)
        self.assertEqual(
            summary["max_hausdorff_distance_nm"], max(r["hausdorff_distance_nm"] for r in self.metrics["times"])
        )
        self.assertEqual(self.metrics["case_differences"], [])
        self.assertEqual(self.metrics["warnings"], [])

    def test_is_strict_json(self):
        self.assertEqual(json.loads(json.dumps(self.metrics, allow_nan=False)), self.metrics)


class DifferentRuns(unittest.TestCase):
    def setUp(self):
        self.scratch = scratch_directory(self)

    def run_with(self, name, times, **changes):
        membrane = lambda t: synthetic.budding_membrane(t, 1.0)  # noqa: E731
        case = synthetic.parameters(**changes)
        return endoflow.load(
            synthetic.write_run(self.scratch / name, "phase-field", membrane, np.array(times), 120, case)
        )

    def test_union_of_output_times_within_the_common_interval(self):
        a = self.run_with("a", [0.0, 0.2, 0.4, 0.6])
        b = self.run_with("b", [0.1, 0.2 + 1e-15, 0.5, 0.9])
        np.testing.assert_allclose(common_times(a, b), [0.1, 0.2, 0.4, 0.5, 0.6])
        records = compare_runs(a, b, LABELS)["times"]
        self.assertEqual([r["interpolated"] for r in records], [["a"], [], ["b"], ["a"], ["b"]])
        # The runs are equal: what is left is the interpolation in time, at most interval²/8 times the acceleration of the apex.
        self.assertLess(max(r["hausdorff_distance_nm"] for r in records), 4.0)
        self.assertLess(records[1]["hausdorff_distance_nm"], 1e-9)
        metrics = compare_runs(a, b, LABELS)
        self.assertTrue(metrics["summary"]["includes_interpolated_shapes"])
        self.assertRegex(metrics["warnings"][0], "distances include an interpolation error estimated as up to .* nm")
        # The estimate is made where the neighbouring shapes lie, the error is met between them.
        for record in records:
            if record["interpolated"]:
                ratio = record["interpolation_error_nm"] / record["hausdorff_distance_nm"]
                self.assertTrue(0.8 < ratio < 8, record["time_us"])
        self.assertEqual(records[1]["interpolation_error_nm"], 0)

    def test_summary_leaves_interpolation_out_where_it_can(self):
        a = self.run_with("a", [0.0, 0.3, 0.6])
        b = self.run_with("b", [0.0, 0.15, 0.3, 0.6])
        metrics = compare_runs(a, b, LABELS)
        self.assertGreater(max(r["hausdorff_distance_nm"] for r in metrics["times"]), 0.1)
        self.assertEqual(metrics["summary"]["max_hausdorff_distance_nm"], 0)
        self.assertFalse(metrics["summary"]["includes_interpolated_shapes"])
        self.assertEqual((metrics["summary"]["interpolation_error_nm"], metrics["warnings"]), (0, []))
        self.assertEqual(metrics["summary"]["times_compared"], 3)

    def test_an_interpolation_error_that_cannot_be_estimated_is_said_to_be_unknown(self):
        a, b = self.run_with("a", [0.0, 0.4]), self.run_with("b", [0.1, 0.3])
        metrics = compare_runs(a, b, LABELS)
        self.assertIsNone(metrics["summary"]["interpolation_error_nm"])
        self.assertRegex(metrics["warnings"][0], "of unknown size")

    def test_interpolation_error_of_an_accelerated_membrane(self):
        """A flat membrane at z = 80 + 3 t² nm: the estimate is the error, 3 (t − t₁)(t₂ − t), at every time."""
        lifted = lambda t: replace(synthetic.budding_membrane(0.0, 1.0), z0=80 + 3 * t * t)  # noqa: E731
        run = endoflow.load(synthetic.write_run(self.scratch / "lifted", "phase-field", lifted, [0.0, 0.2, 0.3, 0.7]))
        estimate = InterpolationError(run)
        for before, time, after in ((0.0, 0.15, 0.2), (0.2, 0.25, 0.3), (0.3, 0.5, 0.7)):
            # The label of material points is exact to about 1e-4 nm on 400 points.
            self.assertAlmostEqual(estimate.at(time), 3 * (time - before) * (after - time), delta=2e-3)
        self.assertEqual(estimate.at(0.3), 0.0)

    def test_no_common_time(self):
        a, b = self.run_with("a", [0.0, 0.2]), self.run_with("b", [0.5, 0.9])
        with self.assertRaisesRegex(
            NoCommonTimeError, "no common time: shapes cover 0 to 0.2 µs in .* run one of them longer"
        ):
            common_times(a, b)

    def test_case_differences_are_warnings(self):
        a = self.run_with("a", [0.0, 0.1])
        b = self.run_with("b", [0.0, 0.1], molecules__patch_radius=40.0, phase_field__epsilon=0.85, time__end=0.3)
        metrics = compare_runs(a, b, LABELS)
        radius, end = metrics["case_differences"]
        self.assertEqual(radius, {"key": "molecules.patch_radius", "a": 36.0, "b": 40.0})
        self.assertEqual((end["key"], end["b"]), ("time.end", 0.3))  # shown among the parameters
        self.assertEqual(metrics["warnings"], ["the cases differ in molecules.patch_radius: 36.0 (A), 40.0 (B)"])

    def test_unfinished_run_is_a_warning(self):
        a, b = self.run_with("a", [0.0, 0.1]), self.run_with("b", [0.0, 0.1])
        b.record["state"] = "running"
        self.assertRegex(compare_runs(a, b, LABELS)["warnings"][0], "run B .* did not finish: running")


class Finding(unittest.TestCase):
    """The sentence, whatever the runs did."""

    def setUp(self):
        self.scratch = scratch_directory(self)

    def run_until(self, name, engine, end, offset=0.0, membrane=None):
        membrane = membrane or (lambda t: synthetic.budding_membrane(t, 1.0, offset))
        return endoflow.load(synthetic.write_run(self.scratch / name, engine, membrane, np.linspace(0.0, end, 6), 200))

    def sentence(self, a, b, labels=("boundary integral", "phase field")):
        return compare_runs(a, b, labels)["finding"]

    def test_both_bud(self):
        """The membranes are parallel curves, 0.5 nm apart; test_distances_equal_the_offset_at_every_time has the tolerance."""
        a, b = self.run_until("a", "boundary-integral", 1.0), self.run_until("b", "phase-field", 1.0, 0.5)
        found = self.sentence(a, b)
        self.assertRegex(found, "^Both engines bud: boundary integral at 0[.][0-9]{3,4} µs, phase field at 0[.][0-9]{3,4} µs, "
                                "[0-9.]+ % apart; the membranes never differ by more than 0[.]5[01]* nm[.]$")
        budding = [run.event_time("budding") for run in (a, b)]
        for time in budding:
            self.assertIn(f"at {time:.4g} µs", found)
        relative = 100 * (budding[1] - budding[0]) / np.mean(budding)
        self.assertIn(f"{relative:.2g} % apart", found)
        again = self.run_until("c", "boundary-integral", 1.0)
        self.assertEqual(self.sentence(a, again, ("first", "second")).partition(";")[::2], (
            f"Both runs bud: first at {budding[0]:.4g} µs, second at {budding[0]:.4g} µs, at the same time",
            " the membranes never differ by more than 0 nm."))

    def test_one_buds(self):
        a = self.run_until("a", "boundary-integral", 1.0)
        time = a.event_time("budding")
        short = self.run_until("short", "phase-field", 0.2)
        start = f"Boundary integral buds at {time:.4g} µs, phase field "
        self.assertIn(start + "ends before, at 0.2 µs; the membranes never", self.sentence(a, short))
        open_neck = self.run_until("open", "phase-field", 1.0, membrane=lambda t: synthetic.budding_membrane(t, 1.0, final_angle=2.0))
        self.assertIn(start + "does not until 1 µs; the", self.sentence(a, open_neck))
        self.assertIn(f"Phase field buds at {time:.4g} µs, boundary integral ends before", self.sentence(short, a, ("boundary integral", "phase field")))

    def test_none_buds(self):
        a, b = self.run_until("a", "boundary-integral", 0.2), self.run_until("b", "phase-field", 0.13)
        self.assertRegex(self.sentence(a, b), "^Neither of the engines buds by 0.13 µs; the membranes never differ by more than .* nm, "
                                              "shapes interpolated in time included[.]$")

    def test_rounded_up(self):
        for value, text in ((0.1201, "0.13"), (0.12, "0.12"), (3.01, "3.1"), (0.00099, "0.00099"), (12.3, "13"), (0.0, "0"), (2.1e-7, "2.1·10⁻⁷")):
            self.assertEqual(rounded_up(value), text)


class Pieces(unittest.TestCase):
    def test_pair(self):
        self.assertEqual(pair(1.0, 3.0), {"a": 1.0, "b": 3.0, "difference": 2.0, "relative_difference": 1.0})
        self.assertEqual(pair(0.0, 0.0)["relative_difference"], 0.0)
        self.assertEqual(
            pair(float("nan"), 3.0), {"a": None, "b": 3.0, "difference": None, "relative_difference": None}
        )

    def test_case_differences_see_absent_parameters(self):
        self.assertEqual(case_differences({"time": {"end": 1}}, {"time": {}}), [{"key": "time.end", "a": 1, "b": None}])

    def test_patch_area(self):
        self.assertAlmostEqual(patch_area(np.array([0.0, 100.0, 200.0]), np.array([1.0, 0.75, 0.25])), 150.0)
        self.assertIsNone(patch_area(np.array([0.0, 100.0]), np.array([0.2, 0.1])))


if __name__ == "__main__":
    unittest.main()
