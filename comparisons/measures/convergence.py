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

import numpy as np

from comparisons.measures.fitting import extrapolated, fitted_order
from comparisons.measures.metrics import compare_at, describe, pair
from endoflow import OutOfRangeError, Run
from endoflow.run_state import unfinished

SCHEMA_VERSION = 1

#: What is compared: key, and whether it is a distance, whose sharp value is 0, or a pair of a comparison's record.
DISTANCES = ("mean_distance_nm", "hausdorff_distance_nm")
PAIRS = ("neck_radius_nm", "bud_diameter_nm", "membrane_area_nm2", "volume_extracellular_nm3", "bending_energy_pN_nm")
BUDDING = "budding_time_us"

#: Stated times when none are asked for.
STATED_TIMES = 4


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


def warnings(sharp, diffuse, records, times):
    """Sentences a reader should see first."""
    found = []
    for name, run in [("the sharp run", sharp), *((f"ε = {one.epsilon:g} nm", one.run) for one in diffuse)]:
        if left := unfinished(run.directory, run.record):
            found.append(f"{name} is {left}")
        found += [f"{name}: {alarm}" for alarm in run.alarms]
    for time in times:
        covered = len(at_time(records, time))
        if covered < len(diffuse):
            found.append(f"only {covered} of {len(diffuse)} phase-field runs cover {time:g} µs")
    ratios = [one.cell_size / one.epsilon for one in diffuse if one.cell_size is not None]
    if ratios and max(ratios) > 1.001 * min(ratios):
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
