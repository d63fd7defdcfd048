"""Orders, intervals and limits against data that follow the law exactly, and against data that do not."""

import unittest

import locations  # noqa: F401
import numpy as np

from comparisons.measures.convergence import extrapolated, fitted_order

EPSILON = np.array([2.4, 1.7, 1.2, 0.85])


class FittedOrder(unittest.TestCase):
    def test_exact(self):
        for order in (0.7, 1.0, 2.0, 3.3):
            fit = fitted_order(EPSILON, 0.3 * EPSILON**order)
            self.assertAlmostEqual(fit.order, order, places=12)
            self.assertAlmostEqual(fit.factor, 0.3, places=12)
            self.assertAlmostEqual(fit.high - fit.low, 0, places=10)
            np.testing.assert_allclose(fit.local, order)

    def test_interval_is_that_of_students_distribution(self):
        # log errors 0, 1, 1 at log ε 0, 1, 2: slope 1/2, residuals −1/6, 1/3, −1/6, variance 1/6, spread 2;
        # t(0.975; 1) = 12.7062.
        fit = fitted_order(np.exp([0.0, 1.0, 2.0]), np.exp([0.0, 1.0, 1.0]))
        self.assertAlmostEqual(fit.order, 0.5, places=12)
        self.assertAlmostEqual(fit.high - 0.5, 12.7062 * np.sqrt(1 / 12), places=4)
        self.assertAlmostEqual(fit.high + fit.low, 1.0, places=12)

    def test_interval_holds_the_true_order_as_often_as_it_says(self):
        noise = np.random.default_rng(1).normal(0, 0.05, (400, len(EPSILON)))
        fits = [fitted_order(EPSILON, EPSILON**2 * np.exp(row)) for row in noise]
        hits = np.mean([fit.low <= 2 <= fit.high for fit in fits])
        self.assertAlmostEqual(hits, 0.95, delta=0.03)

    def test_order_of_the_points_does_not_matter(self):
        mixed = [2, 0, 3, 1]
        self.assertEqual(fitted_order(EPSILON[mixed], EPSILON[mixed] ** 2), fitted_order(EPSILON, EPSILON**2))

    def test_few_points(self):
        self.assertIsNone(fitted_order([1.0], [1.0]))
        self.assertIsNone(fitted_order(EPSILON, [0.0, 1.0, None, float("nan")]))
        two = fitted_order(EPSILON[:2], EPSILON[:2] ** 2)
        self.assertAlmostEqual(two.order, 2)
        self.assertIsNone(two.low)


class Extrapolated(unittest.TestCase):
    def test_exact(self):
        for v0, a, p in ((5.0, -2.0, 1.5), (0.0, 0.3, 2.0), (-1e4, 7.0, 1.0), (1e-3, 1e-5, 3.0)):
            for count in (3, 4):
                epsilon = EPSILON[:count]
                limit, reason = extrapolated(epsilon, v0 + a * epsilon**p)
                self.assertIsNone(reason)
                self.assertAlmostEqual(limit.value, v0, delta=1e-5 * abs(a))
                self.assertAlmostEqual(limit.order, p, delta=1e-4)
                self.assertAlmostEqual(limit.coefficient, a, delta=1e-4 * abs(a))

    def test_error_of_three_values_is_the_distance_to_the_last(self):
        epsilon = EPSILON[1:]
        limit, _ = extrapolated(epsilon, 5 - 2 * epsilon**2)
        self.assertAlmostEqual(limit.error, 2 * 0.85**2, places=5)

    def test_error_covers_a_second_power(self):
        for c in (-0.02, 0.02):
            limit, _ = extrapolated(EPSILON, 3 + EPSILON**2 + c * EPSILON**4)
            self.assertGreater(abs(limit.value - 3), 1e-6)
            self.assertLess(abs(limit.value - 3), limit.error)

    def test_error_covers_noise(self):
        noise = np.random.default_rng(2).normal(0, 0.01, (200, len(EPSILON)))
        limits = [extrapolated(EPSILON, 3 + EPSILON**2 + row)[0] for row in noise]
        self.assertGreater(np.mean([abs(limit.value - 3) <= limit.error for limit in limits if limit]), 0.9)

    def test_values_that_do_not_settle(self):
        for values, reason in (
            ([1.0, 2.0, 1.0, 2.0], "monotonically"),
            ([1.0, 2.0, 3.0, 9.0], "order leaves"),
            ([1.0, 2.0, None, None], "2 value"),
        ):
            limit, found = extrapolated(EPSILON, values)
            self.assertIsNone(limit)
            self.assertIn(reason, found)

    def test_constant(self):
        limit, _ = extrapolated(EPSILON, [7.0] * 4)
        self.assertEqual((limit.value, limit.error, limit.coefficient), (7.0, 0.0, 0.0))


if __name__ == "__main__":
    unittest.main()
