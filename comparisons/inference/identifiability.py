"""Which combinations of unknowns the data fix, and which they cannot separate: singular values of the sensitivities.

With J = d(prediction/error)/dx in the priors' coordinates, a direction v of a singular value s is known to 1/s from the data
alone. Where that is no less than what its prior says, the data say nothing.
"""

from dataclasses import dataclass

import numpy as np

#: Below this fraction of its prior's deviation a direction is fixed by the data, above LOOSE it is not.
FIXED, LOOSE = 1 / 3, 0.9

#: Parts of a direction below this are not named.
NAMED = 0.15


@dataclass(frozen=True)
class Direction:
    """vector (unknowns,) in x; deviation: what the data alone leave of it, in x; shrinkage: posterior over prior deviation;
    verdict: "fixed by the data", "narrowed" or "not separated"; words: the combination."""

    vector: np.ndarray
    deviation: float
    shrinkage: float
    verdict: str
    words: str


def directions(problem, jacobian):
    """Every Direction, best known first, of J (data, unknowns)."""
    _, sizes, rows = np.linalg.svd(jacobian, full_matrices=True)
    sizes = np.concatenate((sizes, np.zeros(len(rows) - len(sizes))))
    variances = np.array([prior.deviation**2 for prior in problem.priors])
    found = []
    for size, vector in zip(sizes, rows):
        prior = float(np.sqrt(vector**2 @ variances))
        deviation = 1 / size if size > 1e-9 else np.inf
        shrinkage = 1 / np.hypot(1, prior / deviation)
        verdict = "fixed by the data" if shrinkage < FIXED else "narrowed" if shrinkage < LOOSE else "not separated"
        found.append(Direction(vector, float(deviation), float(shrinkage), verdict, combination(problem, vector)))
    return found


def combination(problem, vector):
    """A direction in words: a product of powers where all its parts have logarithmic priors, else a sum over prior widths.

    The power of each unknown is relative to the largest one.
    """
    weights = vector / vector[np.argmax(np.abs(vector))]
    named = [i for i in range(len(weights)) if abs(weights[i]) >= NAMED]
    if all(problem.priors[i].logarithmic for i in named):
        powers = weights / np.array([prior.scale for prior in problem.priors])
        powers = powers / powers[max(named, key=lambda i: abs(powers[i]))]
        return " · ".join(problem.names[i] + _power(powers[i]) for i in named)
    terms = [f"{'−' if weights[i] < 0 else '+'} {abs(weights[i]):.2f} {problem.names[i]}" for i in named]
    return " ".join(terms).removeprefix("+ ")


def _power(value):
    return "" if abs(value - 1) < 5e-3 else f"^{value:.2f}".replace("-", "−")
