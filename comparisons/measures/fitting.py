"""Orders of convergence and limits for ε → 0, fitted to a few values. Pure functions of arrays."""

from dataclasses import dataclass
from typing import Optional

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.stats import t as student

#: Probability of the confidence intervals.
CONFIDENCE = 0.95

#: Orders searched by extrapolated().
LEAST_ORDER, LARGEST_ORDER = 0.2, 8.0

#: Sum of squares, relative to that of the values about their mean, above which v0 + a ε^p is no description of them.
LARGEST_MISFIT = 0.05


@dataclass(frozen=True)
class Order:
    """error = factor ε^order by least squares in log-log; low…high is the 95 % interval, None for fewer than 3 points.

    local: orders between neighbouring ε, from the largest to the smallest.
    """

    order: float
    low: Optional[float]
    high: Optional[float]
    factor: float
    local: tuple


@dataclass(frozen=True)
class Limit:
    """v(ε) = value + coefficient ε^order; value ± error is the limit ε → 0 in the unit of the values.

    order is None when the values do not depend on ε.
    error: with 4 or more values the larger of the fit's 95 % half width and the change when the largest ε is left out;
    with 3 values, which leave no redundancy, the whole distance from the value at the smallest ε to the limit.
    """

    value: float
    error: float
    order: Optional[float]
    coefficient: float


def fitted_order(epsilon, error):
    """Order of positive errors (n,) at epsilon (n,). Returns None with fewer than 2 finite positive errors."""
    epsilon, error = _usable(epsilon, error)
    epsilon, error = epsilon[error > 0], error[error > 0]
    if len(epsilon) < 2:
        return None
    x, y = np.log(epsilon), np.log(error)
    spread = np.sum((x - x.mean()) ** 2)
    slope = np.sum((x - x.mean()) * (y - y.mean())) / spread
    offset = y.mean() - slope * x.mean()
    low = high = None
    if len(x) > 2:
        freedom = len(x) - 2
        variance = np.sum((y - offset - slope * x) ** 2) / freedom
        half = student.ppf(0.5 + 0.5 * CONFIDENCE, freedom) * np.sqrt(variance / spread)
        low, high = float(slope - half), float(slope + half)
    local = tuple(float(v) for v in np.diff(y) / np.diff(x))
    return Order(float(slope), low, high, float(np.exp(offset)), local)


def extrapolated(epsilon, values):
    """Limit of values (n,) at epsilon (n,), n >= 3, for ε → 0.

    Returns (Limit, None), or (None, reason) when the values do not settle like v0 + a ε^p.
    """
    epsilon, values = _usable(epsilon, values)
    if len(epsilon) < 3:
        return None, f"{len(epsilon)} value(s), 3 are needed"
    if np.ptp(values) <= 1e-13 * np.abs(values).max():
        return Limit(float(values[-1]), 0.0, None, 0.0), None
    fit, reason = _power_law(epsilon, values)
    if fit is None:
        return None, reason
    limit, coefficient, order = fit
    if len(epsilon) == 3:
        error = abs(limit - values[-1])
    else:
        error = _half_width(epsilon, values, fit)
        shorter, _ = _power_law(epsilon[1:], values[1:])
        error = max(error, abs(limit - (values[-1] if shorter is None else shorter[0])))
    return Limit(float(limit), float(error), float(order), float(coefficient)), None


def _usable(epsilon, values):
    """Finite pairs as arrays, in order of decreasing epsilon; None counts as missing."""
    epsilon, values = (np.array([np.nan if v is None else v for v in data], dtype=float) for data in (epsilon, values))
    keep = np.isfinite(values)
    order = np.argsort(-epsilon[keep], kind="stable")
    return epsilon[keep][order], values[keep][order]


def _linear_fit(epsilon, values, order):
    """Least squares (v0, a) and the sum of squares of v0 + a ε^order, with ε in units of its largest value."""
    matrix = np.column_stack((np.ones_like(epsilon), (epsilon / epsilon[0]) ** order))
    solution, *_ = np.linalg.lstsq(matrix, values, rcond=None)
    return solution, float(np.sum((matrix @ solution - values) ** 2))


def _power_law(epsilon, values):
    """((v0, a, p), None) of the least squares fit v0 + a ε^p, or (None, reason)."""
    if np.any(np.diff(values) * np.sign(values[-1] - values[0]) <= 0):
        return None, "the values do not change monotonically with ε"
    candidates = np.linspace(LEAST_ORDER, LARGEST_ORDER, 157)
    misfits = [_linear_fit(epsilon, values, order)[1] for order in candidates]
    best = int(np.argmin(misfits))
    if best in (0, len(candidates) - 1):
        return None, f"the fitted order leaves the range from {LEAST_ORDER:g} to {LARGEST_ORDER:g}"
    bounds = candidates[best - 1], candidates[best + 1]
    order = minimize_scalar(
        lambda p: _linear_fit(epsilon, values, p)[1], bounds=bounds, method="bounded", options={"xatol": 1e-10}
    ).x
    (limit, coefficient), misfit = _linear_fit(epsilon, values, order)
    if misfit > LARGEST_MISFIT * np.sum((values - values.mean()) ** 2):
        return None, "the values do not follow v0 + a ε^p"
    return (limit, coefficient / epsilon[0] ** order, order), None


def _half_width(epsilon, values, fit):
    """Half the 95 % interval of v0 from the fit's covariance; needs 4 or more values."""
    limit, coefficient, order = fit
    power = coefficient * epsilon**order
    scaled = np.column_stack((np.ones_like(epsilon), (epsilon / epsilon[0]) ** order, power * np.log(epsilon)))
    freedom = len(epsilon) - 3
    variance = np.sum((limit + power - values) ** 2) / freedom
    covariance = variance * np.linalg.pinv(scaled.T @ scaled)
    return student.ppf(0.5 + 0.5 * CONFIDENCE, freedom) * np.sqrt(covariance[0, 0])
