"""The best fit: Levenberg–Marquardt within the priors' limits, sensitivities by finite differences of runs."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from comparisons.errors import RUN_FAILED, StudyError
from comparisons.inference.course import batch_of

#: Step of a finite difference in a prior's coordinate, far above the noise of a run's error control.
STEP = 0.02

#: The iteration ends when the sum of squares falls by less than this fraction, or the point moves by less.
TOLERANCE = 1e-4
MOST_EVALUATIONS = 25

#: A number that a run lacks counts as this times all that the start misses the data by, or as LEAST_PENALTY errors at least: a
#: step to a run that lacks more is never taken, however far off the others are.
PENALTY, LEAST_PENALTY = 2.0, 30.0

#: Distance that a start keeps from the limits.
MARGIN = 1e-3

#: Where unknowns that need no run are started: fractions of their priors.
STARTS = (0.5, 0.15, 0.85)


@dataclass(frozen=True)
class Fit:
    """x (unknowns,): coordinates; course: of its run; residuals (data,): in errors, nan where the run has no such number;
    jacobian (data, unknowns): d residual/dx, 0 there; precision (unknowns, unknowns): inverse covariance in x, with the
    priors'; evaluations of the model."""

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
        return float(np.nansum(self.residuals**2))


def best_fit(problem, simulator, starts):
    """The Fit from the best of the starts, engine coordinates (n, engine_count), whose runs are made first."""
    candidates = []
    for point, course in zip(starts, simulator.courses(starts)):
        if course is not None:
            x = settled(problem, course, point)
            candidates.append((*misfit(residuals(problem, course, x)), x))
    if not candidates:
        raise StudyError("no run of the first ones succeeded; narrow the priors", RUN_FAILED)
    missing, size, start = min(candidates, key=lambda entry: entry[:2])
    model, found = _fitted(problem, simulator, start, size)
    if missing:  # beside the penalty, what the others miss by was little
        again = residuals(problem, model.course(found.x), found.x)
        model, found = _fitted(problem, simulator, found.x, misfit(again)[1])
    course = model.course(found.x)
    last = residuals(problem, course, found.x)
    if np.isnan(last).all():
        raise StudyError("no run has what was measured (a neck, budding); check the data's times and the priors", RUN_FAILED)
    jacobian = model.jacobian(found.x)[: len(problem.data)]
    jacobian[np.isnan(last)] = 0
    return Fit(
        found.x,
        course,
        last,
        jacobian,
        jacobian.T @ jacobian + prior_precision(problem),
        found.nfev,
    )


def _fitted(problem, simulator, start, size):
    """(_Model, result of least_squares) from a start whose residuals have the sum of squares `size`."""
    model = _Model(problem, simulator, max(LEAST_PENALTY, PENALTY * np.sqrt(size)))
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
    return model, found


def residuals(problem, course, x):
    """(data,) of one course at coordinates (unknowns,); nan where it has no such number, or there is no course."""
    if course is None:
        return np.full(len(problem.data), np.nan)
    return problem.residuals(batch_of([course]), x[None, :])[0]


def misfit(found):
    """(how many residuals (data,) are missing, sum of squares of the others)."""
    return int(np.isnan(found).sum()), float(np.nansum(found**2))


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
        found = least_squares(
            lambda free: np.nan_to_num(residuals(problem, course, np.append(point, free))), start, bounds=(low, high)
        )
        best = found if best is None or found.cost < best.cost else best
    return np.append(point, best.x)


class _Model:
    """Residuals and Jacobian for least_squares; normal priors count as data, a missing residual as the penalty."""

    def __init__(self, problem, simulator, penalty):
        self.problem, self.simulator, self.penalty = problem, simulator, penalty
        self.normal = np.array([prior.gaussian for prior in problem.priors])

    def course(self, x):
        return self.simulator.courses(x[None, : self.problem.engine_count])[0]

    def residuals(self, x):
        found = residuals(self.problem, self.course(x), x)
        return np.append(np.where(np.isnan(found), self.penalty, found), x[self.normal])

    def jacobian(self, x):
        """Forward differences, backward at an upper limit or where a number is lost; all runs at once."""
        base = residuals(self.problem, self.course(x), x)
        steps = np.where(x + STEP <= self.problem.limits[:, 1], STEP, -STEP)
        moved = self._moved(x, steps)
        lost = np.isnan(moved) & ~np.isnan(base)[:, None]
        if lost.any():
            other = np.where(lost.any(axis=0), -steps, steps)
            moved, steps = np.where(lost, self._moved(x, other), moved), np.where(lost, -steps, steps)
        change = np.where(np.isnan(moved), 0.0, (moved - np.where(np.isnan(base), self.penalty, base)[:, None]) / steps)
        return np.vstack((change, np.eye(len(x))[self.normal]))

    def _moved(self, x, steps):
        """Residuals (data, unknowns) at x with one coordinate moved by its step."""
        count, points = self.problem.engine_count, x + np.diag(steps)
        courses = self.simulator.courses(points[:count, :count]) if count else []
        courses += [self.course(x)] * (len(x) - count)
        return np.column_stack([residuals(self.problem, course, at) for course, at in zip(courses, points)])
