"""The best fit: Levenberg–Marquardt within the priors' limits, sensitivities by finite differences of runs."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from comparisons.errors import RUN_FAILED, StudyError
from comparisons.inference.batch import batch_of
from comparisons.inference.problem import MISSING

#: Step of a finite difference in a prior's coordinate, far above the noise of a run's error control.
STEP = 0.02

#: The iteration ends when the sum of squares falls by less than this fraction, or the point moves by less.
TOLERANCE = 1e-4
MOST_EVALUATIONS = 25

#: Distance that a start keeps from the limits.
MARGIN = 1e-3

#: Where unknowns that need no run are started: fractions of their priors.
STARTS = (0.5, 0.15, 0.85)


@dataclass(frozen=True)
class Fit:
    """x (unknowns,): coordinates; course: of its run; residuals (data,): in errors; jacobian (data, unknowns): d residual/dx;
    precision (unknowns, unknowns): inverse covariance in x, with the priors'; evaluations of the model."""

    x: np.ndarray
    course: object
    residuals: np.ndarray
    jacobian: np.ndarray
    precision: np.ndarray
    evaluations: int

    @property
    def covariance(self):
        """Of the linearised posterior, in x."""
        return np.linalg.inv(self.precision)

    @property
    def chi_square(self):
        """Sum of squares of the residuals."""
        return float(np.sum(self.residuals**2))


def best_fit(problem, simulator, starts):
    """The Fit from the best of the starts, engine coordinates (n, engine_count), whose runs are made first."""
    candidates = []
    for point, course in zip(starts, simulator.courses(starts)):
        if course is not None:
            x = settled(problem, course, point)
            candidates.append((np.sum(residuals(problem, course, x) ** 2), x))
    if not candidates:
        raise StudyError("no run of the first ones succeeded; narrow the priors", RUN_FAILED)
    start = min(candidates, key=lambda entry: entry[0])[1]
    model = _Model(problem, simulator)
    low, high = problem.limits.T
    found = least_squares(
        model.residuals,
        np.clip(start, low + MARGIN, high - MARGIN),
        jac=model.jacobian,
        bounds=(low, high),
        ftol=TOLERANCE,
        xtol=TOLERANCE,
        gtol=TOLERANCE,
        max_nfev=MOST_EVALUATIONS,
    )
    course = model.course(found.x)
    if course is None or np.all(residuals(problem, course, found.x) >= MISSING):
        raise StudyError("no run has what was measured (a neck, budding); check the data's times and the priors", RUN_FAILED)
    jacobian = model.jacobian(found.x)[: len(problem.data)]
    return Fit(
        found.x,
        course,
        residuals(problem, course, found.x),
        jacobian,
        jacobian.T @ jacobian + prior_precision(problem),
        found.nfev,
    )


def residuals(problem, course, x):
    """(data,) of one course at coordinates (unknowns,)."""
    if course is None:
        return np.full(len(problem.data), MISSING)
    return problem.residuals(batch_of([course]), x[None, :])[0]


def prior_precision(problem):
    """Diagonal matrix of the priors' inverse variances in x; a flat one counts with its variance."""
    return np.diag([1 / prior.deviation**2 for prior in problem.priors])


def settled(problem, course, point):
    """Coordinates (unknowns,) with the unknowns that need no run at their best for a course."""
    count = problem.engine_count
    if count == len(problem.unknowns):
        return np.array(point, dtype=float)
    low, high = problem.limits[count:].T
    best = None
    for fraction in STARTS:
        start = np.array([prior.from_fraction(fraction) for prior in problem.priors[count:]])
        found = least_squares(lambda free: residuals(problem, course, np.append(point, free)), start, bounds=(low, high))
        best = found if best is None or found.cost < best.cost else best
    return np.append(point, best.x)


class _Model:
    """Residuals and Jacobian for least_squares; normal priors count as data."""

    def __init__(self, problem, simulator):
        self.problem, self.simulator = problem, simulator
        self.normal = np.array([prior.gaussian for prior in problem.priors])

    def course(self, x):
        return self.simulator.courses(x[None, : self.problem.engine_count])[0]

    def residuals(self, x):
        return np.append(residuals(self.problem, self.course(x), x), x[self.normal])

    def jacobian(self, x):
        """Forward differences, backward at an upper limit; all runs at once."""
        count, base = self.problem.engine_count, residuals(self.problem, self.course(x), x)
        steps = np.where(x + STEP <= self.problem.limits[:, 1], STEP, -STEP)
        moved = x + np.diag(steps)
        courses = self.simulator.courses(moved[:count, :count]) if count else []
        courses += [self.course(x)] * (len(x) - count)
        columns = [(residuals(self.problem, c, at) - base) / h for c, at, h in zip(courses, moved, steps)]
        return np.vstack((np.column_stack(columns), np.eye(len(x))[self.normal]))
