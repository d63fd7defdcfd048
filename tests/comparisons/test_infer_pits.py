"""Inference from pits that were each seen once: their likelihoods, recovery of what made them, ranks of true values, biases."""

import csv
import unittest

import locations  # noqa: F401
import numpy as np
import stand_in
from scipy.stats import binom, chisquare
from scratch import scratch_directory

import endoflow
from comparisons.inference import pipeline, pits
from comparisons.inference.course import BUDDED, FIRST_GRID, SECOND_GRID, CourseError, Course, batch_of, coat_curves
from comparisons.inference.page import write_fit
from comparisons.inference.problem import Problem
from comparisons.inference.results import bands, fit_results, write_tables
from comparisons.inference.sampling import Density
from comparisons.inference.study_file import read_study
from comparisons.measures.coat import COAT

#: Errors of an angle (°), an area (nm²) and a curvature (1/nm), as of outlines from localisation microscopy.
ERRORS = np.array([5.0, 150.0, 0.002])

#: A case whose coat is a spherical cap that curves by cooperative curvature; its pace is not that of the angle.
CAP = {**stand_in.PARAMETERS, "molecules": {**stand_in.PARAMETERS["molecules"], "maturation_rate": 0.035, "edge_speed": 1.0}}

CURVATURE = '[[unknown]]\nname = "curvature"\nkey = "membrane.spontaneous_curvature"\nprior = "log-uniform"\nlow = 0.04\nhigh = 0.062\n'
RATE = '[[unknown]]\nname = "rate"\nkey = "molecules.maturation_rate"\nprior = "log-uniform"\nlow = 0.02\nhigh = 0.06\n'
PACE = '[[unknown]]\nname = "pace"\nkey = "molecules.edge_speed"\nprior = "uniform"\nlow = 0.4\nhigh = 2.0\n'
PITS = (
    '[[data]]\npits = "pits.csv"\nclosing_angle_error_deg = 5\ncoat_area_error_nm2 = 150\ncoat_curvature_error_per_nm = 0.002\n'
)


def cap_course(settings, contours=()):
    """The Course of {key: text} over CAP: H = H₀ tanh(γθ/H₀) of Mund et al. (2023), θ = 165° t^pace; H₀ = spontaneous_curvature, γ =
    maturation_rate, both 1/nm. The cap's edge lies at z = 0; contours are those of a whole sphere."""

    def value(key):
        section, name = key.split(".")
        return float(settings.get(key, CAP[section][name]))

    last, gamma, pace = (value(key) for key in ("membrane.spontaneous_curvature", "molecules.maturation_rate", "molecules.edge_speed"))

    def columns(time):
        angle = np.maximum(np.radians(165) * time**pace, 1e-3)
        curvature = last * np.tanh(gamma * angle / last)
        coat = dict(zip(COAT, (np.degrees(angle), 2 * np.pi * (1 - np.cos(angle)) / curvature**2, curvature)))
        centre = -np.cos(angle) / curvature
        distances = {
            name: np.hypot(r, z - centre) - 1 / curvature for one in contours for name, r, z in zip(one.columns, one.r, one.z)
        }
        return {"bud_height_nm": (1 - np.cos(angle)) / curvature, **coat, **distances}

    return Course(BUDDED, 0.4, 1.0, columns(0.4 * FIRST_GRID), columns(0.4 + 0.6 * SECOND_GRID))


class Caps(stand_in.StandIn):
    """As simulator.Simulator, of caps."""

    def make(self, settings):
        """The Course of {key: text}."""
        return cap_course(settings, self.problem.contours)


class CapTest(unittest.TestCase):
    """Gives each test self.scratch (Path) and studies of caps."""

    def setUp(self):
        self.scratch = scratch_directory(self)

    def problem(self, text):
        path = self.scratch / "study.toml"
        path.write_text("[study]\nhorizon = 2\n" + text, encoding="utf-8")
        return Problem(read_study(path), CAP)

    def write_pits(self, settings, count, seed, even=False):
        """pits.csv with noise, from random places of a path or, if even, from random times."""
        generator = np.random.default_rng(seed)
        errors = np.tile(ERRORS, (count, 1))
        path = pits.path_of(batch_of([cap_course(settings)]), tuple(COAT), 0.0)
        found = pits.drawn(path, errors, even, generator)[0] + errors * generator.standard_normal((count, 3))
        rows = (",".join(f"{number:.6g}" for number in row) for row in found)
        (self.scratch / "pits.csv").write_text("\n".join([",".join(COAT), *rows]))


class Likelihoods(unittest.TestCase):
    PATH = pits.path_of(batch_of([cap_course({}), cap_course({"molecules.maturation_rate": "0.05"})]), tuple(COAT), 0.1)

    def test_against_a_sum_over_times(self):
        """A sum over 4000 midpoints of each piece, as short as 1e-3 of an error, is the integral to 1e-6; the largest is the maximum."""
        values = np.array([[60.0, 2400.0, 0.03], [150.0, 4500.0, 0.05], [-3.0, 2500.0, 0.0]])
        errors = np.array([ERRORS, 2 * ERRORS, [5.0, 400.0, 0.001]])
        fraction = ((np.arange(4000) + 0.5) / 4000)[:, None, None]
        for even in (False, True):
            found = pits.log_likelihoods(self.PATH, values, errors, even)
            middles = pits.times(self.PATH, values, errors, even, np.full(found.shape, 0.5))
            for n in range(2):
                start, end = self.PATH.start[:, n].T, self.PATH.end[:, n].T
                lasting = self.PATH.until[n] - self.PATH.since[n]
                for p, (value, error) in enumerate(zip(values, errors)):
                    distance = np.sum(((start + fraction * (end - start) - value) / error) ** 2, axis=2)
                    weight = lasting / lasting.sum() if even else np.linalg.norm((end - start) / error, axis=1)
                    parts = np.exp(-distance / 2) * np.where(lasting > 0, weight, 0) / len(fraction) / np.sqrt(2 * np.pi)
                    # Samples miss the maximum by half their spacing, 6e-4 errors, at a slope of 11 errors at most.
                    expected, places = (np.log(parts.sum()), 6) if even else (-distance[:, lasting > 0].min() / 2, 2)
                    self.assertAlmostEqual(found[n, p], expected, places=places)
                    time = self.PATH.since[n] + fraction[..., 0] * lasting
                    below = parts[time < middles[n, p]].sum() / parts.sum()
                    self.assertAlmostEqual(below, 0.5, delta=1e-3)

    def test_nearest_point(self):
        """No point of a fine sampling of the path is nearer, and the nearest of them lies within its spacing, 0.01 of an error."""
        value = np.array([[80.0, 2500.0, 0.03]])
        found = pits.nearest(self.PATH, value, ERRORS[None])[:, 0]
        fraction = np.linspace(0, 1, 1001)[:, None, None]
        for n in range(2):
            points = (self.PATH.start[:, n].T + fraction * (self.PATH.end - self.PATH.start)[:, n].T).reshape(-1, 3)
            least = np.linalg.norm((points - value) / ERRORS, axis=1).min()
            own = np.linalg.norm((found[n] - value[0]) / ERRORS)
            self.assertLessEqual(own, least + 1e-9)
            self.assertAlmostEqual(own, least, delta=0.01)

    def test_before_a_time_no_pit_was_seen(self):
        """The path begins at `since`: a flat pit is nearest to its first point, and one that ends before has no points."""
        flat = np.array([[0.0, 2400.0, 0.0]])
        found = pits.nearest(self.PATH, flat, ERRORS[None])[0, 0]
        self.assertAlmostEqual(found[0], 16.5, delta=0.2)  # 165° · 0.1, on chords of a straight line
        batch = batch_of([cap_course({})])
        self.assertTrue(np.isnan(pits.nearest(pits.path_of(batch, tuple(COAT), 1.5), flat, ERRORS[None])).all())
        self.assertEqual(pits.log_likelihoods(pits.path_of(batch, tuple(COAT), 1.5), flat, ERRORS[None], True)[0, 0], -np.inf)
        self.assertIsNone(pits.path_of(batch, ("neck_radius_nm",), 0.0))


class Recovery(CapTest):
    TRUTH = {"membrane.spontaneous_curvature": "0.052", "molecules.maturation_rate": "0.036"}

    def test_curvature_and_rate(self):
        """Forty pits of unknown time give back both numbers of the published fit, and each pit its time."""
        self.write_pits(self.TRUTH, 40, 5)
        problem = self.problem(CURVATURE + RATE + PITS)
        inference = pipeline.infer(problem, Caps(problem), lambda _: None)
        results = fit_results(problem, inference, {})
        self.assertEqual(results["fit"]["degrees_of_freedom"], 120 - 40 - 2)
        self.assertGreater(results["fit"]["p_value"], 1e-3)
        for entry, truth in zip(results["unknowns"], map(float, self.TRUTH.values())):
            deviation = (entry["high"] - entry["low"]) / 3.29
            self.assertLess(abs(entry["median"] - truth), 3.3 * deviation, entry)  # 1 in 1000
            self.assertLess(deviation / truth, 0.03, entry)  # one pit says some 10 %, forty some 2 %
            # Both are of one likelihood, nearly a normal one: the emulator's errors and the sampler's, 5 %, are between them.
            self.assertLess(abs(entry["best"] - entry["median"]), 0.2 * deviation, entry)
            linear = (entry["linear_high"] - entry["linear_low"]) / (entry["high"] - entry["low"])
            self.assertAlmostEqual(linear, 1, delta=0.15)
        write_tables(problem, inference, bands(problem, inference), self.scratch)
        with open(self.scratch / "pits.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([set(rows[0]), len(rows)], [{"place", "low_us", "median_us", "high_us", "misfit"}, 40])
        self.assertIn("pits.csv:2", rows[0]["place"])
        self.assertAlmostEqual(sum(float(row["misfit"]) ** 2 for row in rows) / results["fit"]["chi_square"], 1, places=6)
        drawn = write_fit(problem, inference, results, {}, self.scratch)
        self.assertIn("infer_pits", drawn)

    def test_outlines(self):
        """Twenty outlines of unknown time, ten points each with 2 nm of noise, give back the last curvature."""
        generator, lines = np.random.default_rng(9), ["pit,r_nm,z_nm"]
        for pit in range(20):
            angle = np.radians(generator.uniform(20, 165))
            curvature = 0.052 * np.tanh(0.035 * angle / 0.052)
            along = np.linspace(0, angle, 10)
            r, z = np.sin(along) / curvature, (np.cos(along) - np.cos(angle)) / curvature
            r, z = (part + 2 * generator.standard_normal(10) for part in (r, z))
            lines += [f"{pit},{x:.6g},{y:.6g}" for x, y in zip(np.abs(r), z)]
        (self.scratch / "outlines.csv").write_text("\n".join(lines))
        problem = self.problem(CURVATURE + '[[data]]\noutlines = "outlines.csv"\nerror_nm = 2\n')
        self.assertEqual((problem.names, len(problem.pits), len(problem.data)), (["curvature"], 20, 200))
        trained = pipeline.over_priors(problem, Caps(problem), lambda _: None)
        x = np.linspace(*problem.limits[0], 121)[:, None]
        value, density = problem.display(x)[:, 0], Density(problem, trained)(x)
        weight = np.exp(density - density.max())
        mean = np.average(value, weights=weight)
        deviation = np.sqrt(np.average((value - mean) ** 2, weights=weight))
        self.assertLess(abs(mean - 0.052), 3.3 * deviation)
        self.assertLess(deviation, 0.02 * 0.052)  # 2 nm, 200 times, of radii of 20 to 60 nm: 0.5 %, of heights that say the times, too
        residuals = problem.residuals(batch_of([cap_course({"membrane.spontaneous_curvature": "0.052"}, problem.contours)]), x[:1])
        self.assertLess(abs(np.sum(residuals**2) - 180), 3.3 * np.sqrt(2 * 180))  # 200 points, 20 times: χ² with 180 degrees

    def test_times_of_pits(self):
        """Of 200 pits from known times, 90 % intervals hold 82 to 96 %: the binomial distribution's limits of 1 in 1000."""
        self.write_pits({}, 200, 6)
        problem = self.problem(CURVATURE + PITS)
        trained = pipeline.over_priors(problem, Caps(problem), lambda _: None)
        batch, generator = batch_of([cap_course({})]), np.random.default_rng(7)
        true = generator.random(200)
        path = pits.path_of(batch, tuple(COAT), 0.0)
        piece = np.argmax(path.until[0] > true[:, None], axis=1)
        part = (true - path.since[0, piece]) / (path.until - path.since)[0, piece]
        exact = (path.start[:, 0, piece] + part * (path.end - path.start)[:, 0, piece]).T
        problem.values = (exact + ERRORS * generator.standard_normal((200, 3))).ravel()
        low, high = (problem.pit_times(batch, problem.errors, np.full((1, 200), at))[0] for at in (0.05, 0.95))
        held = np.mean((low <= true) & (true <= high))
        limits = binom.ppf((1e-3, 1 - 1e-3), 200, 0.9) / 200
        self.assertGreaterEqual(held, limits[0])
        self.assertLessEqual(held, limits[1])
        self.assertEqual(len(trained.errors), 600)

    def test_ranks_of_true_values(self):
        """100 true values from the prior, 30 pits each: regions hold the truth and its ranks are even, as chance has them (1 in 10⁴)."""
        for moments, key in (("any", CURVATURE), ("even", PACE)):
            with self.subTest(moments):
                self.write_pits({}, 30, 3)
                problem = self.problem(key + PITS + f'moments = "{moments}"\n')
                trained = pipeline.over_priors(problem, Caps(problem), lambda _: None)
                grid = np.linspace(*problem.limits[0], 101)[:, None]
                ranks, generator = [], np.random.default_rng(11)
                for truth in problem.points(generator.random((100, 1))):
                    batch = batch_of([cap_course(problem.settings(truth))])
                    values = problem.drawn(batch, truth[None], generator)[0] + problem.errors * generator.standard_normal(90)
                    density = Density(problem, trained, values)(grid)
                    weights = np.exp(density - density.max())
                    ranks.append(float(weights[grid[:, 0] < truth].sum() / weights.sum()))
                held = np.mean(np.abs(np.array(ranks) - 0.5) < 0.45)
                limits = binom.ppf((1e-4, 1 - 1e-4), 100, 0.9) / 100
                self.assertGreaterEqual(held, limits[0])
                self.assertLessEqual(held, limits[1])
                self.assertGreater(chisquare(np.histogram(ranks, bins=10, range=(0, 1))[0]).pvalue, 1e-4)

    def test_bias_on_a_path_that_bends(self):
        """On an arc whose radius R is 8 errors nearest points give a radius that is 1/(2R) errors too large, even times the true one."""
        radius, count, generator = 8.0, 6000, np.random.default_rng(12)
        angle = generator.uniform(0, np.pi, count)
        values = radius * np.column_stack((np.cos(angle), np.sin(angle))) + generator.standard_normal((count, 2))
        inside = values[:, 1] > 0  # pits beyond the ends of the arc
        radii = radius + np.linspace(-0.2, 0.2, 41)
        found = {False: [], True: []}
        for one in radii:
            at = np.linspace(0, np.pi, 201)
            points = one * np.stack((np.cos(at), np.sin(at)))[:, None]
            path = pits.Path(points[..., :-1], points[..., 1:], at[None, :-1], at[None, 1:])
            for even, likelihoods in found.items():
                chosen = values if even else values[inside]
                likelihoods.append(pits.log_likelihoods(path, chosen, np.ones_like(chosen), even).sum())
        # One radius is known to 1 error, 6000 to 0.013.
        for even, bias in ((False, 1 / (2 * radius)), (True, 0.0)):
            best = np.polynomial.Polynomial.fit(radii, found[even], 2).deriv().roots()[0]
            self.assertAlmostEqual(best, radius + bias, delta=3.3 * 0.013)

    def test_pace_is_seen_only_where_times_are_even(self):
        """With `any` the pace of the path says nothing, with `even` it is found: 60 times of a distribution t^(1/pace)."""
        self.write_pits({"molecules.edge_speed": "0.7"}, 60, 8, even=True)
        paces = np.linspace(0.4, 2, 81)
        batches = [batch_of([cap_course({"molecules.edge_speed": f"{pace}"})]) for pace in paces]
        found = {}
        for moments in ("any", "even"):
            problem = self.problem(PACE + PITS + f'moments = "{moments}"\n')
            found[moments] = np.array([problem.log_likelihoods(one, problem.values, problem.errors).sum() for one in batches])
        self.assertLess(np.ptp(found["any"]), 0.3)  # by the vertices of the polyline, which lie elsewhere
        weight = np.exp(found["even"] - found["even"].max())
        mean = np.average(paces, weights=weight)
        deviation = np.sqrt(np.average((paces - mean) ** 2, weights=weight))
        self.assertLess(abs(mean - 0.7), 3.3 * deviation)
        self.assertLess(deviation, 0.2)  # an exponent from 60 times: 0.7/√60 = 0.09


class Runs(unittest.TestCase):
    def test_a_coat_without_an_edge(self):
        """Shapes before the coat is there are left out; a coat that is lost is an error with its time."""
        from test_maturing import cap, run_of

        shapes = [cap(time, angle) for time, angle in ((0.0, 10), (1.0, 60), (2.0, 90))]
        bare = endoflow.shapes.Shape(0.0, *(getattr(shapes[0], name) for name in "srz"), *(5 * [0 * shapes[0].c]))
        times, values = coat_curves(run_of([bare, *shapes[1:]]), ["bud_height_nm", "closing_angle_deg"])["closing_angle_deg"]
        np.testing.assert_array_equal(times, [1, 2])
        np.testing.assert_allclose(values, [60, 90], atol=1e-3)
        self.assertEqual(coat_curves(run_of(shapes), ["bud_height_nm"]), {})
        lost = endoflow.shapes.Shape(3.0, *(getattr(shapes[0], name) for name in "srz"), *(5 * [0 * shapes[0].c]))
        with self.assertRaisesRegex(CourseError, "no coat's edge, c = ½, .* at t = 3 µs"):
            coat_curves(run_of([*shapes, lost]), list(COAT))


if __name__ == "__main__":
    unittest.main()
