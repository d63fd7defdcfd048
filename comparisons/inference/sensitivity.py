"""What the data tell of the unknowns, and the unknowns of the results.

Which combinations of unknowns the data fix, and which they cannot separate: with J = d(prediction/error)/dx in the priors'
coordinates, a direction v of a singular value s is known to 1/s from the data alone. Where that is no less than what its prior
says, the data say nothing.

Sobol indices: how much of a result's variance over the priors comes from each unknown, by itself and in all. Jansen's estimators
(Comput. Phys. Commun. 117, 35 (1999)) on an emulator over the whole priors, from several scrambled Sobol sequences; their spread
is the error.
"""

from dataclasses import dataclass

import numpy as np
from scipy.stats import qmc

from comparisons.inference.course import BUDDED, NO_NECK, values_at, within_course

#: Below this fraction of its prior's deviation a direction is fixed by the data, above LOOSE it is not.
FIXED, LOOSE = 1 / 3, 0.9

#: Parts of a direction below this are not named.
NAMED = 0.15

#: Scrambled sequences, and points of each as a power of two.
REPEATS, LOG2_POINTS = 8, 10

#: A result must exist in this fraction of the priors.
LEAST_EXISTING = 0.999

#: Quantities at a fixed time.
AT_TIME = ("neck_radius_nm", "bud_diameter_nm", "bud_height_nm")


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


def results_of(batch, time):
    """{name: (n,)} of the results whose sensitivity is asked; nan where one does not exist. time: µs."""
    found = {}
    if batch.outcome != NO_NECK:
        found["neck forms (µs)"] = batch.neck_time
    if batch.outcome == BUDDED:
        found["budding (µs)"] = batch.end
        found["diameter at budding (nm)"] = batch.second["bud_diameter_nm"][:, -1]
    at = np.full((len(batch.end), 1), time)
    for column in AT_TIME:
        values = np.where(within_course(batch, column, at), values_at(batch, column, at), np.nan)
        title, unit = column.removeprefix("bud_").rsplit("_", 1)
        found[f"{title.replace('_', ' ')} at {time:.3g} µs ({unit})"] = values[:, 0]
    return found


def common_time(batch):
    """A time (µs) at which as many courses as possible have a neck and have not ended: between the latest neck and the first end."""
    latest, first = np.quantile(batch.neck_time, 0.999), np.quantile(batch.end, 0.001)
    return float(0.5 * (latest + first)) if latest < first else float(0.9 * first)


def indices(problem, trained, seed):
    """[{result, mean, deviation, exists, unknowns: [{unknown, first, first_error, total, total_error}]}] over the priors.

    Unknowns that need no run are left out: they shift and scale times alone.
    """
    count = problem.engine_count
    time = common_time(trained.batch(problem.points(np.random.default_rng(seed).random((2000, count)))))
    repeats = [_repeat(problem, trained, time, seed + number) for number in range(REPEATS)]
    found = []
    for name in repeats[0]:
        first, total, mean, deviation, exists = (np.array([repeat[name][i] for repeat in repeats]) for i in range(5))
        entry = {"result": name, "mean": None, "deviation": None, "exists": float(exists.mean()), "unknowns": []}
        if exists.mean() >= LEAST_EXISTING:
            entry |= {"mean": float(mean.mean()), "deviation": float(deviation.mean())}
            entry["unknowns"] = [
                {
                    "unknown": problem.names[i],
                    "first": float(first[:, i].mean()),
                    "first_error": _error(first[:, i]),
                    "total": float(total[:, i].mean()),
                    "total_error": _error(total[:, i]),
                }
                for i in range(count)
            ]
        found.append(entry)
    return found


def _error(values):
    return float(values.std(ddof=1) / np.sqrt(len(values)))


def _repeat(problem, trained, time, seed):
    """{result: (first (d,), total (d,), mean, deviation, fraction that exists)} from one scrambled sequence."""
    count = problem.engine_count
    sequence = qmc.Sobol(2 * count, seed=seed).random_base2(LOG2_POINTS)
    a, b = sequence[:, :count], sequence[:, count:]
    sets = [a, b]
    for i in range(count):
        mixed = a.copy()
        mixed[:, i] = b[:, i]
        sets.append(mixed)
    results = [results_of(trained.batch(problem.points(fractions)), time) for fractions in sets]
    found = {}
    for name in results[0]:
        f = np.array([result[name] for result in results])
        exists = np.isfinite(f).all(axis=0)
        f = f[:, exists]
        if not exists.any():
            found[name] = (np.zeros(count), np.zeros(count), 0.0, 0.0, 0.0)
            continue
        variance = f[:2].var()
        first = [1 - np.mean((f[1] - f[2 + i]) ** 2) / (2 * variance) for i in range(count)]
        total = [np.mean((f[0] - f[2 + i]) ** 2) / (2 * variance) for i in range(count)]
        found[name] = (np.array(first), np.array(total), f[:2].mean(), np.sqrt(variance), exists.mean())
    return found
