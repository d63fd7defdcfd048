"""Inference where numbers are missing: runs without a neck or with one of a moment, data that no run has, data far off."""

import unittest
from types import SimpleNamespace

import locations  # noqa: F401
import numpy as np
import stand_in
from scratch import scratch_directory

from comparisons.inference import pipeline
from comparisons.inference.course import FIRST_GRID, NECK, NO_NECK, SECOND_GRID, Course, CourseError, batch_of, course_of, values_at
from comparisons.inference.best_fit import best_fit
from comparisons.inference.results import fit_results, warnings

VISCOSITY = '[[unknown]]\nname = "viscosity"\nkey = "fluid.viscosity_intracellular"\nprior = "log-uniform"\nlow = 0.005\nhigh = 0.02\n'


def data(name, error):
    """A [[data]] of a file."""
    return f'[[data]]\nfile = "{name}"\nerror = {error}\n'


def without_neck(course):
    """A course's run as it would be without a neck, to the same end."""
    grid = np.append(course.neck_time * FIRST_GRID, course.neck_time + (course.end - course.neck_time) * SECOND_GRID[1:])
    height = np.append(course.first["bud_height_nm"], course.second["bud_height_nm"][1:])
    end = 0.65  # us: before any of the runs buds
    return Course(NO_NECK, end, end, {"bud_height_nm": np.interp(end * FIRST_GRID, grid, height)}, {})


def warnings_of(results):
    """The warnings of a fit whose runs are all well."""
    return warnings({**results, "runs": {"alarmed": 0}})


class Courses(unittest.TestCase):
    def history_run(self, time, neck):
        """A run with this history, as course_of needs it."""
        time, neck = np.array(time, dtype=float), np.array(neck, dtype=float)
        history = {"time_us": time, "neck_radius_nm": neck, "bud_diameter_nm": 2 * neck + 1, "bud_height_nm": 10 * time}
        return SimpleNamespace(history=history, event_time=lambda _: None)

    def test_necks_of_a_moment(self):
        """A neck that is born in the last row, or lasts one row, is none: its stage would last no time. Two rows make a stage."""
        nan = np.nan
        for neck, outcome in (
            ([nan, nan, nan, nan, 28], NO_NECK),
            ([nan, nan, 28, nan, nan], NO_NECK),
            ([nan, nan, nan, 28, 27], NECK),
            ([28, 27, nan, nan, nan], NECK),
            ([28, 27, 26, 25, 24], NECK),
        ):
            with self.subTest(neck):
                course = course_of(self.history_run([0, 1, 2, 3, 4], neck), ("neck_radius_nm", "bud_height_nm"))
                self.assertEqual(course.outcome, outcome)
                batch = batch_of([course])
                np.testing.assert_allclose(values_at(batch, "bud_height_nm", np.array([[1.0, 4.0]])), [[10, 40]], rtol=1e-3)
                self.assertEqual(np.isfinite(values_at(batch, "neck_radius_nm", np.array([[4.0]]))).all(), outcome == NECK)

    def test_rows_of_one_time_and_runs_of_one_row(self):
        course = course_of(self.history_run([0, 1, 1, 2], 4 * [np.nan]), ("bud_height_nm",))
        np.testing.assert_allclose(values_at(batch_of([course]), "bud_height_nm", np.array([[0.5, 2.0]])), [[5, 20]], atol=0.01)
        with self.assertRaisesRegex(CourseError, "no two moments"):
            course_of(self.history_run([0], [np.nan]), ("bud_height_nm",))


class Fits(unittest.TestCase):
    """Gives each test self.scratch (Path)."""

    def setUp(self):
        self.scratch = scratch_directory(self)

    def problem(self, text):
        return stand_in.problem_of(self.scratch, text)

    def infer(self, simulator, text):
        problem = self.problem(text)
        return problem, pipeline.infer(problem, simulator(problem), lambda _: None)

    def test_thirty_errors_off_is_no_missing_number(self):
        """One height, 30 errors and more below what any run has: the fit is the slowest run, and the page says that it misses."""
        slowest = stand_in.course({"fluid.viscosity_intracellular": "0.02"})
        height = values_at(batch_of([slowest]), "bud_height_nm", np.array([[0.5]]))[0, 0]
        (self.scratch / "one.csv").write_text(f"time_us,bud_height_nm\n0.5,{height - 30 * 0.05}\n")
        problem, found = self.infer(stand_in.StandIn, VISCOSITY + data("one.csv", 0.05))
        # Within a thousandth of the prior's half width of its limit, where the fit starts at the latest, 0.1 % more viscosity is
        # 0.02 nm, 0.4 errors.
        self.assertAlmostEqual(found.fit.residuals[0], 30, delta=0.5)
        said = " ".join(warnings_of(fit_results(problem, found, {})))
        self.assertIn("misses the data", said)
        self.assertIn("at a limit of its prior: viscosity", said)

    def test_runs_that_lack_numbers_are_no_better(self):
        """Necks 100 errors off everywhere: runs without a neck, which miss nothing, are no fit."""

        class Necks(stand_in.StandIn):
            """Has a neck below a viscosity of 0.012 only."""

            def courses(self, points):
                settings = [self.problem.settings(point) for point in points]
                found = [
                    course if float(own["fluid.viscosity_intracellular"]) < 0.012 else without_neck(course)
                    for own, course in zip(settings, super().courses(points))
                ]
                self.known[-len(found) :] = found
                return found

        batch = batch_of([stand_in.course({})])
        own = np.linspace(0.3, 0.6, 5)
        necks = values_at(batch, "neck_radius_nm", own[None, :])[0] + 10
        (self.scratch / "neck.csv").write_text("time_us,neck_radius_nm\n" + "".join(f"{t},{y}\n" for t, y in zip(own, necks)))
        problem = self.problem(VISCOSITY + data("neck.csv", 0.1))
        fit = best_fit(problem, Necks(problem), pipeline.first_points(problem, 1))
        self.assertTrue(np.isfinite(fit.residuals).all())
        self.assertLess(float(problem.priors[0].value(fit.x[0])), 0.012)

    def test_data_that_no_run_has_say_nothing(self):
        """Heights fix the viscosity though necks were measured and no run has one: they are counted, and nothing hangs."""

        class NoNecks(stand_in.StandIn):
            def courses(self, points):
                found = [without_neck(course) for course in super().courses(points)]
                self.known[-len(found) :] = found
                return found

        truth = batch_of([without_neck(stand_in.course({"fluid.viscosity_intracellular": "0.013"}))])
        own = np.linspace(0.1, 0.6, 10)
        heights = values_at(truth, "bud_height_nm", own[None, :])[0]
        rows = "".join(f"{t},{y},{20 if t > 0.5 else ''}\n" for t, y in zip(own, heights))
        (self.scratch / "both.csv").write_text("time_us,bud_height_nm,neck_radius_nm\n" + rows)
        problem, found = self.infer(NoNecks, VISCOSITY + data("both.csv", 0.2))
        results = fit_results(problem, found, {})
        self.assertEqual((results["fit"]["outside"], results["fit"]["degrees_of_freedom"]), (2, 9))
        self.assertLess(results["fit"]["chi_square"], 1)  # data without noise
        self.assertAlmostEqual(results["unknowns"][0]["median"] / 0.013, 1, delta=0.02)
        self.assertTrue(any("2 of 12 data lie where the best run has no such number" in text for text in warnings_of(results)))


if __name__ == "__main__":
    unittest.main()
