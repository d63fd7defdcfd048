"""Inference: priors, a run's course, emulator, fit, posterior, calibration, sensitivity, on a model in closed form."""

import unittest

import locations  # noqa: F401
import numpy as np
import stand_in
import synthetic
from scratch import scratch_directory

import endoflow
from comparisons.errors import StudyError
from comparisons.inference import calibration, pipeline, sensitivity
from comparisons.inference.course import BUDDED, Outputs, batch_of, course_of, neck_onset, values_at
from comparisons.inference.best_fit import best_fit
from comparisons.inference.emulator import Region, fitted, points_in
from comparisons.inference.sensitivity import directions
from comparisons.inference.observations import error_column
from comparisons.inference.priors import PriorError, prior_of
from comparisons.inference.results import bands, fit_results, warnings
from comparisons.inference.study_file import VISCOSITIES, Unknown, is_exact_time_scale

TWO_UNKNOWNS = """
[[unknown]]
name = "viscosity"
key = "fluid.viscosity_intracellular"
prior = "log-uniform"
low = 0.005
high = 0.02

[[unknown]]
name = "curvature"
key = "membrane.spontaneous_curvature"
prior = "normal"
mean = 0.07
sd = 0.005
"""

NECK = '\n[[data]]\nfile = "neck.csv"\n'


def warnings_of(results):
    """The warnings of a fit whose runs are all well."""
    return warnings({**results, "runs": {"alarmed": 0}})


class InferTest(unittest.TestCase):
    """Gives each test self.scratch (Path), and studies with data from known parameters."""

    def setUp(self):
        self.scratch = scratch_directory(self)

    def write_neck(self, settings, count=30, error=0.4, seed=3, scale=1.0, offset=0.0):
        """neck.csv with noise from a course with {key: value}; its times are scaled and shifted."""
        batch = batch_of([stand_in.course(settings)])
        own = np.linspace(1.2 * batch.neck_time[0], 0.95 * batch.end[0], count)
        neck = values_at(batch, "neck_radius_nm", own[None, :])[0]
        noisy = neck + error * np.random.default_rng(seed).standard_normal(count)
        rows = [f"{scale * t + offset:.6f},{y:.5f},{error}" for t, y in zip(own, noisy)]
        (self.scratch / "neck.csv").write_text("\n".join(["time_us,neck_radius_nm,neck_radius_error_nm", *rows]))

    def problem(self, text):
        return stand_in.problem_of(self.scratch, text)

    def infer(self, text):
        problem = self.problem(text)
        return problem, pipeline.infer(problem, stand_in.StandIn(problem), lambda _: None)


class Priors(unittest.TestCase):
    def test_coordinates_and_fractions(self):
        for kind, numbers in (
            ("uniform", {"low": -2, "high": 6}),
            ("log-uniform", {"low": 0.1, "high": 10}),
            ("normal", {"mean": 3, "sd": 0.5}),
            ("log-normal", {"median": 2, "factor": 1.5, "high": 3}),
        ):
            with self.subTest(kind):
                prior = prior_of(kind, numbers)
                x = prior.from_fraction(np.array([0, 0.25, 0.5, 1]))
                np.testing.assert_allclose(prior.coordinate(prior.value(x)), x, atol=1e-12)
                self.assertEqual((x[0], x[-1]), (prior.lowest, prior.highest))
                self.assertTrue(np.isneginf(prior.log_density(np.array([prior.highest + 0.01]))[0]))
                # Uniform fractions have the prior's deviation: a million of them to 1e-3.
                sampled = prior.from_fraction((np.arange(100000) + 0.5) / 100000).std()
                self.assertAlmostEqual(sampled, prior.deviation, places=3)
        self.assertAlmostEqual(float(prior_of("log-uniform", {"low": 0.1, "high": 10}).value(0.0)), 1.0)

    def test_refused(self):
        for kind, numbers, message in (
            ("flat", {}, "it is one of"),
            ("uniform", {"low": 1}, "needs high"),
            ("uniform", {"low": 2, "high": 1}, "must be below"),
            ("log-uniform", {"low": 0, "high": 1}, "positive"),
            ("normal", {"mean": 0, "sd": 0}, "greater than 0"),
            ("log-normal", {"median": 1, "factor": 1}, "greater than 1"),
        ):
            with self.subTest(message), self.assertRaisesRegex(PriorError, message):
                prior_of(kind, numbers)


class Courses(InferTest):
    def test_onset_of_a_fold(self):
        """z ↦ r has a fold that opens at t₀: half the distance of its ends grows like (t − t₀)^{3/2}."""
        time = np.linspace(0, 1, 41)
        born, gap = 0.337, np.sqrt(np.maximum(time - 0.337, 0)) ** 3
        neck = np.where(time > born, 28 - 10 * (time - born) - gap, np.nan)
        widest = np.where(time > born, 2 * (28 - 10 * (time - born) + gap), np.nan)
        at, radius = neck_onset(time, neck, widest)
        self.assertAlmostEqual(at, born, places=9)
        self.assertAlmostEqual(radius, 28, places=7)
        self.assertIsNone(neck_onset(time, np.full(41, np.nan), np.full(41, np.nan)))

    def test_a_run_comes_back(self):
        """A course repeats its run's history: the grids resolve it to 0.02 nm, the neck's moment to a thousandth of the run."""
        directory = self.scratch / "run"
        synthetic.write_run(directory, "boundary-integral", lambda t: synthetic.budding_membrane(t, 1.0), [0, 0.5, 1.0])
        run = endoflow.load(directory)
        course = course_of(run, ("neck_radius_nm", "bud_diameter_nm", "bud_height_nm"))
        self.assertEqual(course.outcome, BUDDED)
        self.assertAlmostEqual(course.end, run.event_time("budding"))
        batch = batch_of([course])
        for column in ("neck_radius_nm", "bud_height_nm"):
            time = np.linspace(0.35, 0.99 * course.end, 50)
            np.testing.assert_allclose(
                values_at(batch, column, time[None, :])[0], run.history_at(column, time), atol=0.05, err_msg=column
            )

    def test_contours(self):
        """A circle of 1 nm around the axis of a plane: its highest point lies 1 nm on the left of the plane, its lowest right."""
        (self.scratch / "c.csv").write_text("r_nm,z_nm\n10,1\n20,-1\n30,0\n")
        problem = self.problem(TWO_UNKNOWNS + '\n[[data]]\ncontour = "c.csv"\nerror_nm = 2\nhigh_us = 0.9\n')
        directory = self.scratch / "run"
        flat = synthetic.SphereOnPlane(1e5, 1e-3, 80.0, 1e-9)
        synthetic.write_run(directory, "boundary-integral", lambda t: flat, [0, 1.0])
        course = course_of(endoflow.load(directory), ("bud_height_nm",), problem.contours)
        np.testing.assert_allclose([course.first[f"contour_1_point_{i}"][0] for i in (1, 2, 3)], [1, -1, 0], atol=1e-6)
        self.assertEqual(problem.names[-1], "contour_1_time")
        self.assertEqual(len(problem.data), 3)

    def test_outputs_and_batches(self):
        courses = [stand_in.course({"fluid.viscosity_intracellular": v}) for v in ("0.01", "0.02")]
        outputs = Outputs(courses[0])
        back, batch = outputs.batch(outputs.vectors(courses)), batch_of(courses)
        np.testing.assert_allclose(back.end, batch.end)
        for column in batch.second:
            np.testing.assert_allclose(back.second[column], batch.second[column])


class Emulators(unittest.TestCase):
    def test_order(self):
        """Of a function of degree three the emulator is exact, and leaving runs out shows no error."""
        region = Region(np.array([0.2, -0.1]), np.array([[0.5, 0.1], [0.0, 0.3]]), np.array([[-1, 1], [-1, 1]]))
        points = region.spread(np.random.default_rng(1).random((40, 2)))
        of = lambda x: np.column_stack((x[:, 0] ** 3 - x[:, 0] * x[:, 1], 2 + x[:, 1] ** 2))  # noqa: E731
        emulator = fitted(region, points, of(points))
        self.assertGreaterEqual(emulator.degree, 3)
        other = region.spread(np.random.default_rng(2).random((20, 2)))
        np.testing.assert_allclose(emulator.at(other), of(other), atol=1e-10)
        np.testing.assert_allclose(emulator.left_out, of(points), atol=1e-8)

    def test_left_out_error(self):
        """The error found by leaving runs out is that of fresh points, or up to 2.5 times it: the outermost runs count most."""
        region = Region(np.zeros(2), np.eye(2), np.array([[-1, 1], [-1, 1]]))
        of = lambda x: np.exp(1.2 * x[:, :1] + np.sin(2 * x[:, 1:]))  # noqa: E731
        fresh = region.spread(np.random.default_rng(5).random((2000, 2)))
        for seed in range(4):
            points = points_in(region, 40, seed)
            emulator = fitted(region, points, of(points))
            true = np.sqrt(np.mean((emulator.at(fresh) - of(fresh)) ** 2))
            found = np.sqrt(np.mean((emulator.left_out - of(points)) ** 2))
            self.assertLess(found / true, 2.5)
            self.assertGreater(found / true, 0.8)


class Recovery(InferTest):
    TRUTH = {"fluid.viscosity_intracellular": "0.0130", "membrane.spontaneous_curvature": "0.0720"}

    def test_two_parameters(self):
        """Both true values lie in the 99.9 % interval, the fit is that of the errors, the posterior that of its linearisation."""
        self.write_neck(self.TRUTH)
        problem, found = self.infer(TWO_UNKNOWNS + NECK)
        results = fit_results(problem, found, {"fluid.viscosity_intracellular": "pN µs/nm²"})
        for entry, truth in zip(results["unknowns"], (0.0130, 0.0720)):
            deviation = (entry["high"] - entry["low"]) / 3.29
            self.assertLess(abs(entry["median"] - truth), 3.3 * deviation, entry)
            self.assertLess(entry["low"], entry["best"])
            linear = entry["linear_high"] - entry["linear_low"]
            # Thirty points narrow both to 1 %: nothing but the ensemble's noise (5 %) separates it from a normal one.
            self.assertAlmostEqual(linear / (entry["high"] - entry["low"]), 1, delta=0.15)
        self.assertGreater(results["fit"]["p_value"], 1e-3)
        self.assertTrue(found.check.accurate)
        self.assertTrue(found.posterior.converged)
        self.assertEqual([one["verdict"] for one in results["directions"]], ["fixed by the data"] * 2)
        self.assertEqual(warnings_of(results), [])
        time, low, median, high = bands(problem, found)["neck_radius_nm"]
        inside = np.isfinite(median)
        self.assertTrue((low[inside] <= high[inside]).all())
        budding = stand_in.course(self.TRUTH).end
        self.assertAlmostEqual(results["posterior"]["budding_time_us"]["median"], budding, delta=0.02 * budding)

    def test_time_fixes_viscosity_over_stiffness_only(self):
        """A course whose pace is viscosity over stiffness: the report names that ratio, and that their product is free."""
        self.write_neck(self.TRUTH)
        text = TWO_UNKNOWNS.replace("curvature", "stiffness").replace("membrane.spontaneous_stiffness", "membrane.bending_stiffness_coated")
        text = text.replace('"normal"\nmean = 0.07\nsd = 0.005', '"log-uniform"\nlow = 600\nhigh = 2400')
        self.write_neck({"fluid.viscosity_intracellular": "0.013"})
        problem, found = self.infer(text + NECK)
        best, worst = directions(problem, found.fit.jacobian)
        self.assertEqual((best.verdict, worst.verdict), ("fixed by the data", "not separated"))
        self.assertRegex(best.words, r"^viscosity · stiffness\^−(1.0\d|0.9\d|1)$|^viscosity\^−(1.0\d|0.9\d) · stiffness$")
        self.assertTrue(any("do not separate" in text for text in warnings_of(fit_results(problem, found, {}))))
        ratio = problem.display(found.posterior.x)
        ratio = ratio[:, 0] / ratio[:, 1] / (0.013 / 1200)
        self.assertLess(abs(np.median(ratio) - 1), 3.3 * ratio.std())
        # The ratio given, the priors leave stiffnesses between 600 and 0.02 · 1200/0.013 = 1846.
        self.assertGreater(np.ptp(problem.display(found.posterior.x)[:, 1]), 1100)

    def test_exact_unknowns_need_no_runs(self):
        """A slowing down and a shift of time act on finished courses, and are found."""
        self.write_neck({}, scale=1.7, offset=0.05)
        text = (
            '[[unknown]]\nname = "slowness"\nscales = ["fluid.viscosity_extracellular", "fluid.viscosity_intracellular"]\n'
            'divides = ["molecules.mobility"]\nprior = "log-uniform"\nlow = 0.5\nhigh = 4\n'
            '[[unknown]]\ntime_offset = true\nprior = "normal"\nmean = 0\nsd = 0.2\n' + NECK
        )
        problem, found = self.infer(text)
        self.assertEqual(problem.engine_count, 0)
        values = problem.display(found.posterior.x)
        for column, truth in zip(values.T, (1.7, 0.05)):
            self.assertLess(abs(np.median(column) - truth), 3.3 * column.std())

    def test_a_coat_that_matures_has_a_clock_of_its_own(self):
        """Viscosities alone do not slow such a run down: the factor needs runs."""
        slowness = Unknown("slowness", prior_of("log-uniform", {"low": 0.5, "high": 4}), scales=tuple(VISCOSITIES), divides=("molecules.mobility",))
        self.assertTrue(is_exact_time_scale(slowness, stand_in.PARAMETERS))
        for clock in ({"maturation": "cooperative"}, {"exchange": "edge"}):
            molecules = {**stand_in.PARAMETERS["molecules"], **clock}
            self.assertFalse(is_exact_time_scale(slowness, {**stand_in.PARAMETERS, "molecules": molecules}))

    def test_a_wrong_model_is_noticed(self):
        """Errors given ten times too small: χ² per datum is 100, and the page says so."""
        self.write_neck(self.TRUTH, error=2.0)
        data = (self.scratch / "neck.csv").read_text().replace(",2.0", ",0.2")
        (self.scratch / "neck.csv").write_text(data)
        problem, found = self.infer(TWO_UNKNOWNS + NECK)
        self.assertTrue(any("misses the data" in text for text in warnings_of(fit_results(problem, found, {}))))

    def test_event(self):
        """Budding alone fixes one unknown of one: its time is proportional to the viscosity, so are their errors."""
        text = TWO_UNKNOWNS.split("[[unknown]]\nname = \"curvature\"")[0]
        problem, found = self.infer(text + '[[data]]\nevent = "budding"\ntime_us = 0.984\nerror_us = 0.01\n')
        values = problem.display(found.posterior.x)[:, 0]
        self.assertAlmostEqual(values.mean() / 0.012, 1, delta=0.002)
        self.assertAlmostEqual(values.std() / values.mean() / (0.01 / 0.984), 1, delta=0.1)


class Calibration(InferTest):
    def test_ranks_and_coverage(self):
        """60 cases: coverage and ranks as chance has them (limits of 1 in 10⁴)."""
        self.write_neck({}, count=12)
        problem = self.problem(TWO_UNKNOWNS + NECK)
        simulator = stand_in.StandIn(problem)
        trained = pipeline.over_priors(problem, simulator, lambda _: None)
        truth = calibration.truths(problem, 60, 1)
        courses = simulator.courses(truth)
        cases = [calibration.calibrate(problem, trained, x, c, 50 + i) for i, (x, c) in enumerate(zip(truth, courses))]
        found = calibration.summary(problem, [case for case in cases if case is not None])
        self.assertEqual(found["cases"], 60)
        half, ninety = (entry["held"] for entry in found["coverage"])
        self.assertLess(abs(half - 0.5), 0.25)
        self.assertGreater(ninety, 0.76)
        for entry in found["ranks"]:
            self.assertGreater(entry["p_value"], 1e-4, entry)


    def test_a_run_says_what_is_true(self):
        """The parameters of a run are coordinates that give them back; what they do not say is refused by name."""
        self.write_neck({}, count=12)
        problem = self.problem(TWO_UNKNOWNS + NECK)
        x = problem.coordinates(stand_in.PARAMETERS)
        np.testing.assert_allclose(problem.display(x[None, :])[0], (0.01, 0.07), rtol=1e-14)
        far = {**stand_in.PARAMETERS, "membrane": {**stand_in.PARAMETERS["membrane"], "spontaneous_curvature": 0.2}}
        with self.assertRaisesRegex(StudyError, "spontaneous_curvature = 0.2 is outside of what its prior allows"):
            problem.coordinates(far)
        shifted = '[[unknown]]\ntime_offset = true\nprior = "uniform"\nlow = -0.1\nhigh = 0.1\n'
        with self.assertRaisesRegex(StudyError, "unknown time_offset is no parameter's value"):
            self.problem(TWO_UNKNOWNS + shifted + NECK).coordinates(stand_in.PARAMETERS)


class Sensitivity(InferTest):
    def test_indices_of_a_product(self):
        """Budding ∝ v·C⁻²: of its logarithm's variance the parts are known; the emulator and 8 sequences give them to 0.02."""
        text = TWO_UNKNOWNS.replace("low = 0.005\nhigh = 0.02", "low = 0.0098\nhigh = 0.0102")
        problem = self.problem(text.replace("sd = 0.005", "sd = 0.0005"))
        trained = pipeline.over_priors(problem, stand_in.StandIn(problem), lambda _: None)
        entry = next(e for e in sensitivity.indices(problem, trained, 1) if e["result"].startswith("budding"))
        parts = np.array([np.log(0.0102 / 0.0098) ** 2 / 12, (2 * 0.0005 / 0.07) ** 2])
        parts /= parts.sum()
        for one, part in zip(entry["unknowns"], parts):
            self.assertAlmostEqual(one["first"], part, delta=0.02)
            self.assertAlmostEqual(one["total"], part, delta=0.02)


class Fit(InferTest):
    def test_missing_numbers_lead_back(self):
        """From a start where most data lie after budding, the fit still finds the slow course."""
        self.write_neck({"fluid.viscosity_intracellular": "0.018"})
        problem = self.problem(TWO_UNKNOWNS + NECK)
        start = np.array([[problem.priors[0].coordinate(0.006), 0.0]])
        fit = best_fit(problem, stand_in.StandIn(problem), start)
        self.assertAlmostEqual(float(problem.priors[0].value(fit.x[0])) / 0.018, 1, delta=0.05)

    def test_error_columns(self):
        self.assertEqual(error_column("membrane_area_nm2"), "membrane_area_error_nm2")


if __name__ == "__main__":
    unittest.main()
