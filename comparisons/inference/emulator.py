"""Courses as polynomials of parameters around a point, fitted to runs, with the error that leaving out one run at a time shows."""

import functools
import itertools
import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre
from scipy.stats import qmc

#: Degrees that are tried, and runs for each coefficient that a degree needs at least.
DEGREES = (1, 2, 3, 4, 5, 6)
RUNS_PER_COEFFICIENT = 1.4


@dataclass(frozen=True)
class Region:
    """Points x = centre + axes·ξ with |ξ_i| ≤ 1, within the priors' limits (n, 2)."""

    centre: np.ndarray
    axes: np.ndarray
    limits: np.ndarray

    @functools.cached_property
    def _inverse(self):
        return np.linalg.inv(self.axes).T

    def local(self, x):
        """ξ (n, d) of points (n, d)."""
        return (x - self.centre) @ self._inverse

    def holds(self, x):
        """Whether each point (n, d) belongs to the region."""
        within = np.all((x >= self.limits[:, 0] - 1e-9) & (x <= self.limits[:, 1] + 1e-9), axis=1)
        return within & np.all(np.abs(self.local(x)) <= 1 + 1e-9, axis=1)

    def spread(self, fractions):
        """Those of the points with ξ = 2·fractions − 1, fractions (n, d), that the region holds."""
        points = self.centre + (2 * fractions - 1) @ self.axes.T
        return points[self.holds(points)]


def coefficients(dimension, degree):
    """Number of coefficients of a polynomial of a total degree."""
    return math.comb(dimension + degree, degree)


def exponents(dimension, degree):
    """Degrees in each variable (coefficients, d) of all products up to a total degree, lowest first."""
    found = [e for e in itertools.product(range(degree + 1), repeat=dimension) if sum(e) <= degree]
    return np.array(sorted(found, key=sum))


def basis(xi, powers):
    """Products of Legendre polynomials (n, coefficients) at ξ (n, d)."""
    if not xi.shape[1]:
        return np.ones((len(xi), 1))
    single = [legendre.legvander(xi[:, i], powers.max()) for i in range(xi.shape[1])]
    return np.prod([single[i][:, powers[:, i]] for i in range(xi.shape[1])], axis=0)


@dataclass(frozen=True)
class Emulator:
    """Outputs (n, outputs) as polynomials over a Region. left_out: what each run's outputs are when it is left out."""

    region: Region
    degree: int
    powers: np.ndarray
    weights: np.ndarray
    points: np.ndarray
    left_out: np.ndarray

    def at(self, x):
        """Outputs (n, outputs) at points (n, d)."""
        return basis(self.region.local(x), self.powers) @ self.weights


def fitted(region, points, outputs):
    """The Emulator of the runs at points (n, d) with outputs (n, m), of the degree with the least left-out error."""
    xi = region.local(points)
    spread = outputs.std(axis=0) + 1e-12
    best = None
    for degree in DEGREES:
        powers = exponents(points.shape[1], degree)
        if len(points) < RUNS_PER_COEFFICIENT * len(powers) and best is not None:
            break
        matrix = basis(xi, powers)
        inverse = np.linalg.pinv(matrix)
        weights = inverse @ outputs
        leverage = np.minimum(np.sum(matrix * inverse.T, axis=1), 1 - 1e-6)
        misses = (outputs - matrix @ weights) / (1 - leverage)[:, None]
        size = float(np.sqrt(np.mean((misses / spread) ** 2)))
        if best is None or size < best[0]:
            best = (size, Emulator(region, degree, powers, weights, points, outputs - misses))
    return best[1]


def design(dimension, count, seed):
    """`count` fractions (count, d) between 0 and 1, evenly spread (Sobol's sequence, scrambled by the seed)."""
    if dimension == 0:
        return np.empty((1, 0))
    return qmc.Sobol(dimension, seed=seed).random_base2(math.ceil(math.log2(max(count, 2))))[:count]
