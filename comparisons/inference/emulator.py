"""Courses as polynomials of parameters over a region, fitted to runs, with the error that leaving out one run at a time shows."""

import functools
import itertools
import math
from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre
from scipy.stats import qmc

from comparisons.errors import RUN_FAILED, StudyError
from comparisons.inference.course import Outputs

#: Degrees that are tried, and runs for each coefficient that a degree needs at least.
DEGREES = (1, 2, 3, 4, 5, 6)
RUNS_PER_COEFFICIENT = 1.4

#: Runs that a region gets: this many for each coefficient of a polynomial of third degree, or of fourth over whole priors.
LOCAL_RUNS = 1.7
GLOBAL_RUNS = 2.2

#: Step of a central difference of an emulator, which has no noise.
STEP = 1e-3

#: A region reaches this many standard deviations of the linearised posterior.
REACH = 3.5


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


@dataclass(frozen=True)
class Trained:
    """emulator, outputs: what it was made from; errors (data,): its error in units of the data; excluded: {outcome: runs}."""

    emulator: object
    outputs: Outputs
    errors: np.ndarray
    excluded: dict

    def batch(self, x):
        """The Batch of engine coordinates (n, engine_count)."""
        return self.outputs.batch(self.emulator.at(x))


def region_of(problem, fit, factor=1.0):
    """The Region around a Fit, along the principal axes of its covariance; factor on its size."""
    count = problem.engine_count
    spreads, axes = np.linalg.eigh(fit.covariance[:count, :count])
    return Region(fit.x[:count], axes * (factor * REACH * np.sqrt(spreads)), problem.limits[:count])


def whole_region(problem):
    """The Region of all that the priors allow."""
    limits = problem.limits[: problem.engine_count]
    return Region(limits.mean(axis=1), np.diag(0.5 * np.ptp(limits, axis=1)), limits)


def local_runs(dimension):
    """Number of runs of a region around a fit."""
    return int(np.ceil(LOCAL_RUNS * coefficients(dimension, 3)))


def global_runs(dimension):
    """Number of runs over whole priors."""
    return int(np.ceil(GLOBAL_RUNS * coefficients(dimension, 4)))


def points_in(region, count, seed):
    """`count` points (count, d) evenly spread over a Region."""
    dimension, wanted = len(region.centre), count
    while True:
        points = region.spread(design(dimension, wanted, seed))
        if len(points) >= count or dimension == 0 or wanted > 1000 * count:
            return points[:count]
        wanted *= 2


def train(problem, points, courses, region, outcome=None):
    """The Trained of runs, points (n, engine_count) with their Courses (None where one failed), within a Region.

    outcome: whose runs are used, the most frequent one if None. Raises StudyError when too few are left.
    """
    inside = region.holds(points)
    kept = [(point, course) for point, course, held in zip(points, courses, inside) if course is not None and held]
    counts = Counter(course.outcome for _, course in kept)
    outcome = outcome or (counts.most_common(1)[0][0] if counts else "")
    used = [(point, course) for point, course in kept if course.outcome == outcome]
    if len(used) < coefficients(problem.engine_count, 1) + 1 and problem.engine_count:
        raise StudyError(
            f"only {len(used)} of {len(points)} runs around the fit end as it does ({outcome or 'none'}); narrow the priors",
            RUN_FAILED,
        )
    outputs = Outputs(used[0][1])
    used_points = np.array([point for point, _ in used])
    vectors = outputs.vectors([course for _, course in used])
    emulator = fitted(region, used_points, vectors)
    failed = sum(course is None for course in courses)
    excluded = {name: count for name, count in counts.items() if name != outcome} | ({"failed": failed} if failed else {})
    return Trained(emulator, outputs, left_out_errors(problem, outputs, emulator, used_points, vectors), excluded)


def slopes(problem, trained, x):
    """d(prediction/error)/dx (data, unknowns) at coordinates x (unknowns,), from differences of the emulator."""
    inner = np.clip(x, problem.limits[:, 0] + STEP, problem.limits[:, 1] - STEP)
    points = np.vstack((inner + STEP * np.eye(len(x)), inner - STEP * np.eye(len(x))))
    predicted = problem.predictions(trained.batch(points[:, : problem.engine_count]), points) / problem.errors
    return np.nan_to_num((predicted[: len(x)] - predicted[len(x) :]) / (2 * STEP)).T


def left_out_errors(problem, outputs, emulator, points, vectors):
    """Root mean square (data,) of what leaving a run out does to its predictions of the data, in the data's units."""
    if not problem.data:
        return np.empty(0)
    rest = np.array([prior.from_fraction(0.5) for prior in problem.priors[problem.engine_count :]])
    x = np.hstack((points, np.tile(rest, (len(points), 1))))
    guess, truth = (problem.predictions(outputs.batch(v), x) for v in (emulator.left_out, vectors))
    return np.sqrt(np.nan_to_num(np.mean((guess - truth) ** 2, axis=0)))
