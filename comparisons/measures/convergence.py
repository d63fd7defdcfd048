"""Numbers of the ε → 0 study: phase-field runs with several ε against one boundary-integral run of the same case.

metrics.json (schema_version 1); keys end in their unit, null stands for "does not exist":

    study          "converge"
    sharp          the boundary-integral run: label, directory, state, budding_time_us, … (as in a comparison)
    runs           the same for each phase-field run, with epsilon_nm, cell_size_nm, wall_s
    times_us       the stated times
    records        for each stated time and ε: epsilon_nm, a comparison's record (metrics.py), a: sharp, b: diffuse
    orders         for each quantity and stated time (null for the budding time): quantity, time_us, order, low, high
                   (95 % interval), factor, local (orders between neighbouring ε): |error| = factor ε^order
    limits         for each quantity and stated time: quantity, time_us, value, error (v0 and its error), order,
                   coefficient of v0 + a ε^p fitted to the phase-field values; sharp, difference (value − sharp);
                   reason when there is no limit
    warnings       [text]
"""

import re
from dataclasses import asdict, dataclass
from typing import Optional

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.stats import t as student

from comparisons.measures.metrics import compare_at, describe, pair
from comparisons.measures.quantities import BUDDING, DISTANCES, columns
from endoflow import OutOfRangeError, Run
from endoflow.run_state import unfinished

#: Probability of the confidence intervals.
CONFIDENCE = 0.95

#: Orders searched by extrapolated().
LEAST_ORDER, LARGEST_ORDER = 0.2, 8.0

#: Sum of squares, relative to that of the values about their mean, above which v0 + a ε^p is no description of them.
LARGEST_MISFIT = 0.05

#: Cells are in proportion when their sizes over ε differ by this part at most.
IN_PROPORTION = 0.01
SCHEMA_VERSION = 1

#: What is compared beside DISTANCES, whose sharp value is 0: pairs of a comparison's record.
PAIRS = columns("converging")

#: Stated times when none are asked for.
STATED_TIMES = 4


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


@dataclass(frozen=True)
class DiffuseRun:
    """A phase-field run (endoflow.Run) and its ε in nm."""

    epsilon: float
    run: Run

    @property
    def cell_size(self):
        """The cell size in nm: the case's, or what run.json notes that the scheme chose; None where neither says it."""
        return self.run.parameters["phase_field"]["cell_size"] or self.run.record.get("notes", {}).get("cell_size_nm")


def study_metrics(sharp, diffuse, wanted_times=()):
    """All metrics of a sharp endoflow.Run and DiffuseRuns in order of decreasing ε; wanted_times in µs."""
    times = list(wanted_times) or stated_times(sharp, diffuse)
    records = [record for time in times for one in diffuse for record in record_at(sharp, one, time)]
    budding = [(one.epsilon, one.run.event_time("budding")) for one in diffuse]
    sharp_budding = sharp.event_time("budding")
    return {
        "schema_version": SCHEMA_VERSION,
        "study": "converge",
        "sharp": {"wall_s": sharp.record.get("wall_s"), **describe(sharp, "boundary integral")},
        "runs": [described(one) for one in diffuse],
        "times_us": times,
        "records": records,
        "orders": orders(records, times, budding, sharp_budding),
        "limits": limits(records, times, budding, sharp_budding),
        "warnings": warnings(sharp, diffuse, records, times),
    }


def described(one):
    """The entry of a DiffuseRun in `runs`."""
    own = {"epsilon_nm": one.epsilon, "cell_size_nm": one.cell_size, "wall_s": one.run.record.get("wall_s")}
    return {**own, **describe(one.run, f"ε = {one.epsilon:g} nm")}


def stated_times(sharp, diffuse):
    """At most STATED_TIMES output times (µs) of the sharp run, evenly chosen up to its budding.

    Or, when that is earlier, up to the last time all finished runs cover.
    """
    finished = [one.run for one in diffuse if one.run.record.get("state") == "finished"]
    last = min(run.shape_times[-1] for run in [sharp, *(finished or [one.run for one in diffuse])])
    wanted = np.linspace(0.0, min(last, sharp.event_time("budding") or last), STATED_TIMES + 1)[1:]
    offered = sharp.shape_times[sharp.shape_times <= last * (1 + 1e-9)]
    chosen = offered[np.unique(np.argmin(np.abs(offered[:, None] - wanted), axis=0))]
    return [float(time) for time in chosen if time > 0 or len(chosen) == 1]


def record_at(sharp, one, time):
    """A list with the record of a DiffuseRun at a time (µs); empty when a run does not cover it."""
    try:
        return [{"epsilon_nm": one.epsilon, "cell_size_nm": one.cell_size, **compare_at(sharp, one.run, time)}]
    except OutOfRangeError:
        return []


def error_of(record, quantity):
    """Size of a quantity's error in a record; None when it does not exist."""
    if quantity in DISTANCES:
        return record[quantity]
    difference = record[quantity]["difference"]
    return None if difference is None else abs(difference)


def value_of(record, quantity):
    """A quantity's value in the phase-field run."""
    return record[quantity] if quantity in DISTANCES else record[quantity]["b"]


def sharp_value_of(record, quantity):
    """A quantity's value in the sharp run."""
    return 0.0 if quantity in DISTANCES else record[quantity]["a"]


def at_time(records, time):
    """The records of one time (µs)."""
    return [record for record in records if record["time_us"] == time]


def orders(records, times, budding, sharp_budding):
    """The entry `orders`; budding: [(ε, budding time or None)] of the phase-field runs."""
    found = []
    for quantity in (*DISTANCES, *PAIRS):
        for time in times:
            own = at_time(records, time)
            found.append(_order(quantity, time, [r["epsilon_nm"] for r in own], [error_of(r, quantity) for r in own]))
    errors = [None if None in (time, sharp_budding) else abs(time - sharp_budding) for _, time in budding]
    found.append(_order(BUDDING, None, [epsilon for epsilon, _ in budding], errors))
    return [entry for entry in found if entry is not None]


def _order(quantity, time, epsilon, errors):
    fit = fitted_order(epsilon, errors)
    return None if fit is None else {"quantity": quantity, "time_us": time, **asdict(fit), "local": list(fit.local)}


def limits(records, times, budding, sharp_budding):
    """The entry `limits`; budding: [(ε, budding time or None)] of the phase-field runs."""
    found = []
    for quantity in (*DISTANCES, *PAIRS):
        for time in times:
            own = at_time(records, time)
            values = [value_of(r, quantity) for r in own]
            sharp = sharp_value_of(own[0], quantity) if own else None
            found.append(_limit(quantity, time, [r["epsilon_nm"] for r in own], values, sharp))
    found.append(_limit(BUDDING, None, *map(list, zip(*budding)), sharp_budding))
    return [entry for entry in found if entry is not None]


def _limit(quantity, time, epsilon, values, sharp):
    """One entry of `limits`; None when the quantity exists in no run."""
    if all(value is None for value in values):
        return None
    fit, reason = extrapolated(epsilon, values)
    numbers = asdict(fit) if fit else dict.fromkeys(("value", "error", "order", "coefficient"))
    difference = pair(sharp, numbers["value"])["difference"]
    where = {"quantity": quantity, "time_us": time}
    return {**where, **numbers, "sharp": sharp, "difference": difference, "reason": reason}


#: The alarm of a thick layer, whose error is what the study measures.
MEASURED = "layer-at-neck"


def warnings(sharp, diffuse, records, times):
    """Sentences a reader should see first."""
    found = []
    for name, run in [("the sharp run", sharp), *((f"ε = {one.epsilon:g} nm", one.run) for one in diffuse)]:
        if left := unfinished(run.directory, run.record):
            found.append(f"{name} is {left}")
        found += [f"{name}: {alarm}" for alarm in run.alarms if alarm.name != MEASURED]
    for time in times:
        covered = len(at_time(records, time))
        if covered < len(diffuse):
            found.append(f"only {covered} of {len(diffuse)} phase-field runs cover {time:g} µs")
    ratios = [one.cell_size / one.epsilon for one in diffuse if one.cell_size is not None]
    if ratios and max(ratios) > (1 + IN_PROPORTION) * min(ratios):
        found.append("cell_size/ε is not the same in all runs: the errors mix the layer's width and the mesh")
    return found


def table(metrics):
    """The rows of converge.csv, one for each record: list of {column: value}."""
    budding = {run["epsilon_nm"]: run["budding_time_us"] for run in metrics["runs"]}
    rows = []
    for record in metrics["records"]:
        row = {key: record[key] for key in ("epsilon_nm", "cell_size_nm", "time_us", *DISTANCES)}
        for quantity in PAIRS:
            entry = record[quantity]
            stem, unit = re.fullmatch(r"(.*?)((?:_pN)?_nm\d?)", quantity).groups()
            row |= {quantity: entry["b"], f"{stem}_sharp{unit}": entry["a"], f"{stem}_error{unit}": entry["difference"]}
        row |= {BUDDING: budding[record["epsilon_nm"]], "budding_time_sharp_us": metrics["sharp"]["budding_time_us"]}
        rows.append(row)
    return rows
