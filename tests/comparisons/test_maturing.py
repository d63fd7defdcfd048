"""The item on coats that mature, mund2023: what is read off shapes that are known, and the published fit."""

import unittest
from pathlib import Path

import locations  # noqa: F401
import endoflow
import numpy as np
from comparisons.errors import StudyError
from comparisons.measures.coat import coat_of
from comparisons.paper import mund2023
from comparisons.paper.item import BOUNDARY_INTEGRAL, NotRun
from endoflow.shapes import Shape

RADIUS = 20.0  # of the cap, nm


def cap(time, angle, points=2001):
    """A spherical cap of RADIUS with this closing angle (degrees), coated to a narrow edge, on a collar of the same sphere."""
    theta = np.linspace(0, np.radians(angle) + 0.1, points)
    r, z = RADIUS * np.sin(theta), RADIUS * np.cos(theta)
    c = 1 / (1 + np.exp((theta - np.radians(angle)) / 1e-3))
    nothing = np.zeros(points)
    return Shape(time, RADIUS * theta, r, z, c, nothing, np.full(points, 2 / RADIUS), nothing, nothing)


def run_of(shapes):
    """A run that has only shapes."""
    history = {"time_us": np.array([shape.time for shape in shapes])}
    return endoflow.Run(Path("."), {"events": {}, "exit_reason": "budded"}, {}, history, shapes)


class ReadOff(unittest.TestCase):
    def test_angle_area_and_curvature_of_a_cap(self):
        for angle in (30, 90, 150):
            shape = cap(0, angle)
            closing_angle, area, curvature = coat_of(shape).values()
            self.assertAlmostEqual(closing_angle, angle, places=3)
            # The edge is 1e-3 wide: a part of 2e-5 of the smallest cap's area; the polyline's error is smaller.
            expected = 2 * np.pi * RADIUS**2 * (1 - np.cos(np.radians(angle)))
            self.assertAlmostEqual(area / expected, 1, delta=1e-4)
            self.assertAlmostEqual(curvature, 1 / RADIUS, places=12)

    def test_no_edge_no_angle(self):
        shape = cap(0, 90)
        for c in (np.zeros_like(shape.c), np.ones_like(shape.c)):
            self.assertIsNone(coat_of(Shape(0, shape.s, shape.r, shape.z, c, c, c, c, c)))

    def test_the_published_fit(self):
        """Half of the area is flat, and curvature obeys dH/dθ = γ (1 − H²/H₀²)."""
        self.assertAlmostEqual(float(mund2023.fitted(0.1)[0]), mund2023.FLAT_PART, places=5)  # θ² of it
        self.assertAlmostEqual(float(mund2023.fitted(180)[0]), 1, places=12)
        gamma, step = mund2023.cooperativity(), 1e-3
        last = np.tanh(np.pi * gamma)
        for angle in (30.0, 90.0, 150.0):
            _, (before, here, after) = mund2023.fitted(np.array([angle - step, angle, angle + step]))
            slope = last * (after - before) / np.radians(2 * step)
            self.assertAlmostEqual(slope, gamma * (1 - (last * here) ** 2), places=6)

    def test_where_an_angle_is_reached(self):
        angle, values = np.array([10.0, 50.0, 40.0, 90.0]), np.array([0.0, 1.0, 2.0, 3.0])
        self.assertAlmostEqual(mund2023.at_angle(angle, values, 30), 0.5)
        self.assertIsNone(mund2023.at_angle(angle, values, 5))
        self.assertIsNone(mund2023.at_angle(angle, values, 100))


class Page(unittest.TestCase):
    def test_the_runs_it_wants(self):
        wanted = mund2023.wanted(False)
        self.assertEqual([one.name for one in wanted], list(mund2023.WAYS))
        self.assertNotIn("molecules.maturation", wanted[0].settings)
        self.assertNotIn("molecules.exchange", wanted[1].settings)
        self.assertEqual(mund2023.wanted(True)[2].settings["boundary_integral.accuracy"], "1e-2")

    def test_a_row_for_each_shape_and_a_word_for_each_way(self):
        run = run_of([cap(time, angle) for time, angle in ((0.0, 10), (5.0, 60), (6.0, 90), (7.0, 140))])
        runs = {name: {BOUNDARY_INTEGRAL: run} for name in list(mund2023.WAYS)[:2]}
        runs["growth and maturation"] = {BOUNDARY_INTEGRAL: NotRun("no time")}
        result = mund2023.result(runs, True)
        self.assertEqual(len(result.rows), 6)
        at_90 = {one.what: one for one in result.printed}["area at 90°, of the last"]
        # (1 − cos 90°)/(1 − cos 140°) = 0.57; the fit's is tanh² (π γ)/(2 tanh² (π γ/2)) with γ/H₀ = 0.69.
        self.assertEqual(at_90.ours[""], "constant curvature 0.57, constant area 0.57")
        self.assertEqual(at_90.paper, "0.75")
        self.assertIn("140° at", result.printed[-1].ours[""])
        with self.assertRaises(StudyError):
            mund2023.result({"constant area": {BOUNDARY_INTEGRAL: NotRun("no time")}}, True)


if __name__ == "__main__":
    unittest.main()
