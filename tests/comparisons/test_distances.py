"""Distances between curves against values known in closed form."""

import unittest

import locations  # noqa: F401
import numpy as np
from scipy.integrate import trapezoid

import synthetic
from comparisons.measures.distances import SPACING, curve_distance, distance_to_polyline


def cap(height, rim=80.0, points=400):
    """r, z of the spherical cap of a height (nm) through the circle r = rim, z = 0, and its sphere's radius and centre height."""
    radius = (rim**2 + height**2) / (2 * height)
    angle = np.linspace(0, np.arcsin(rim / radius), points)
    return radius * np.sin(angle), radius * np.cos(angle) + height - radius, radius, height - radius


class PointToPolyline(unittest.TestCase):
    def test_foot_inside_a_segment(self):
        vertices = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]])
        self.assertAlmostEqual(distance_to_polyline(np.array([[0.5, 0.3]]), vertices)[0], 0.3, places=14)

    def test_beyond_the_end(self):
        vertices = np.array([[0.0, 0.0], [1.0, 0.0]])
        self.assertAlmostEqual(distance_to_polyline(np.array([[4.0, 4.0]]), vertices)[0], 5.0, places=14)

    def test_equals_a_search_of_all_segments(self):
        r, z, _ = synthetic.budding_membrane(0.8, 1.0).curve(3000)
        vertices = np.column_stack((r, z))
        points = np.random.default_rng(1).uniform([0, 70], [80, 140], (300, 2))
        start, along = vertices[:-1], np.diff(vertices, axis=0)
        foot = np.clip(((points[:, None] - start) * along).sum(2) / (along**2).sum(1), 0, 1)
        exact = np.linalg.norm(points[:, None] - start - foot[..., None] * along, axis=2).min(1)
        np.testing.assert_allclose(distance_to_polyline(points, vertices), exact, atol=1e-6)


class CurveDistance(unittest.TestCase):
    def test_same_curve_sampled_differently(self):
        membrane = synthetic.budding_membrane(0.7, 1.0)
        distance = curve_distance(membrane.curve(400)[:2], membrane.curve(731)[:2])
        # The curvature jumps by 1/a + 1/rho ≈ 0.18/nm where the arcs meet; interpolation there errs by jump·h²/16 ≤ 2e-3 nm at h = 0.4 nm.
        self.assertLess(distance.hausdorff, 2e-3)
        self.assertLess(distance.mean, 1e-4)

    def test_flat_membranes(self):
        r = np.linspace(0, 80, 30)
        distance = curve_distance((r, np.full(30, 80.0)), (r, np.full(30, 82.5)))
        self.assertAlmostEqual(distance.mean, 2.5, places=12)
        self.assertAlmostEqual(distance.hausdorff, 2.5, places=12)

    def test_parallel_curves_with_a_neck(self):
        for offset in (0.1, 0.8, 3.0):
            inner, outer = synthetic.budding_membrane(0.7, 1.0), synthetic.budding_membrane(0.7, 1.0, offset)
            distance = curve_distance(inner.curve(500)[:2], outer.curve(500)[:2])
            self.assertAlmostEqual(distance.mean, offset, delta=1e-4)
            self.assertAlmostEqual(distance.hausdorff, offset, delta=2e-3)  # the curvature jumps, as above

    def test_caps_through_one_rim(self):
        low, high = cap(30.0), cap(33.0)
        distance = curve_distance(low[:2], high[:2])
        # The nearest point lies on the ray from the other sphere's centre: distance | |p − centre| − radius |, largest at the apex.
        averages = []
        for (r, z, *_), (*_, radius, centre) in ((cap(30.0, points=20000), high), (cap(33.0, points=20000), low)):
            averages.append(trapezoid(np.abs(np.hypot(r, z - centre) - radius)) / (len(r) - 1))
        self.assertAlmostEqual(distance.hausdorff, 3.0, delta=1e-6)
        # Chords of the samples stay within SPACING²/(8 radius) of the arc.
        self.assertAlmostEqual(distance.mean, 0.5 * sum(averages), delta=SPACING**2 / (8 * high[2]) + 1e-6)

    def test_symmetric(self):
        a, b = cap(20.0)[:2], cap(45.0, points=77)[:2]
        forth, back = curve_distance(a, b), curve_distance(b, a)
        self.assertAlmostEqual(forth.mean, back.mean, places=12)
        self.assertAlmostEqual(forth.hausdorff, back.hausdorff, places=12)

    def test_hausdorff_sees_a_bump_on_either_curve(self):
        r = np.linspace(0, 80, 801)
        flat, bump = np.full(801, 80.0), 80 + 6 * np.exp(-(((r - 40) / 3) ** 2))
        for pair in (((r, flat), (r, bump)), ((r, bump), (r, flat))):
            self.assertAlmostEqual(curve_distance(*pair).hausdorff, 6.0, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
