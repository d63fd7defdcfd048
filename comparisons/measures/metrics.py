"""Numbers that compare two runs.

metrics.json (schema_version 1); every key ends in its unit, null stands for "does not exist" (no neck, no budding):

    schema_version        1
    finding               what the comparison found, in one sentence
    runs                  {"a": …, "b": …}: label, directory, engine, version, git, state, exit_reason, end_us, budding_time_us,
                          alarms [{name, time, value, bound, meaning, remedy}],
                          basis {curvature convention, resolution, alarms} in words
    common_interval_us    [first, last] time both runs have shapes for
    case_differences      [{key, a, b}]: parameters that differ, the engines' own sections left out
    warnings              [text]
    budding               {a_us, b_us, difference_us, relative_difference}
    summary               over the times both runs wrote shapes at, or all times when there are fewer than two of those:
                          {times_compared, includes_interpolated_shapes, interpolation_error_nm (largest), max_hausdorff_distance_nm, max_hausdorff_distance_time_us,
                           time_mean_of_mean_distance_nm, final_mean_distance_nm, final_hausdorff_distance_nm,
                           max_relative_difference: {quantity: number}}
    times                 one record per output time of either run within the common interval:
        time_us
        interpolated              runs ("a", "b") whose shape was interpolated between two output times
        interpolation_error_nm    what the interpolation alone is estimated to add to a distance: 0 without any, null where
                                  a run has fewer than three shapes
        mean_distance_nm          symmetric mean distance between the curves, averaged over arc length
        hausdorff_distance_nm     symmetric Hausdorff distance
        concentration_l1_nm2      ∫ |c_a − c_b| over membrane area from the axis
        concentration_l1_relative the same over the larger ∫ c
        concentration_max         max |c_a − c_b| at equal membrane area from the axis
        patch_area_difference_nm2 b − a of the area inside the ring c = 1/2
        neck_radius_nm, bud_diameter_nm, bud_height_nm, membrane_area_nm2, bending_energy_pN_nm,
        volume_extracellular_nm3  {a, b, difference, relative_difference}, from history.csv, interpolated in time

difference is b − a; relative_difference is that over the mean of |a| and |b|.
"""

import math
from dataclasses import asdict

import numpy as np
from scipy.integrate import trapezoid

from comparisons.errors import StudyError
from comparisons.measures.distances import InterpolationError, curve_distance
from comparisons.measures.quantities import COMPARED
from comparisons.measures.words import basis, finding
from endoflow.curves import area_from_axis, resample
from endoflow.run_state import unfinished

SCHEMA_VERSION = 1

#: Sections of the case file only one engine reads.
ENGINE_SECTIONS = ("phase_field", "boundary_integral")

#: Spacing (nm) at which curves are resampled before their area is integrated, and number of area samples.
PROFILE_SPACING = 0.1
PROFILE_SAMPLES = 4000


class NoCommonTimeError(StudyError):
    """The two runs have no time in common, or nothing but one moment."""


def compare_runs(a, b, labels):
    """All metrics of two endoflow.Run objects; labels is the pair of display names. Raises NoCommonTimeError."""
    times = common_times(a, b)
    require_interval(a, b, times)
    errors = [InterpolationError(run) for run in (a, b)]
    records = [compare_at(a, b, float(time), errors) for time in times]
    differences = case_differences(a.parameters, b.parameters)
    buds, found = budding(a.event_time("budding"), b.event_time("budding")), summary(records)
    return {
        "schema_version": SCHEMA_VERSION,
        "finding": finding(a, b, labels, buds, found),
        "runs": {key: describe(run, label) for key, run, label in zip("ab", (a, b), labels)},
        "common_interval_us": [float(times[0]), float(times[-1])],
        "case_differences": differences,
        "warnings": warnings(a, b, differences) + interpolation_warnings(records),
        "budding": buds,
        "summary": found,
        "times": records,
    }


def common_times(a, b):
    """Union (n,) in µs of both runs' output times within the interval both cover, merged when equal to round-off."""
    first, last = max(a.shape_times[0], b.shape_times[0]), min(a.shape_times[-1], b.shape_times[-1])
    tolerance = 1e-9 * max(1.0, abs(last))
    union = np.unique(np.concatenate((a.shape_times, b.shape_times)))
    union = union[(union >= first - tolerance) & (union <= last + tolerance)]
    if not union.size:
        raise NoCommonTimeError(
            f"no common time: shapes cover {a.shape_times[0]:g} to {a.shape_times[-1]:g} µs in {a.directory} "
            f"and {b.shape_times[0]:g} to {b.shape_times[-1]:g} µs in {b.directory}; run one of them longer"
        )
    return union[np.concatenate(([True], np.diff(union) > tolerance))]


def require_interval(a, b, times):
    """Raises NoCommonTimeError for runs whose shapes share one moment only; two stationary shapes have no more."""
    if len(times) == 1 and not a.engine == b.engine == "statics":
        raise NoCommonTimeError(
            f"nothing to compare: shapes of {a.directory} and {b.directory} share only t = {times[0]:g} µs; "
            "run them longer, or write shapes more often (output.shape_interval)"
        )


def compare_at(a, b, time, errors=None):
    """The record of metrics.json at one time (µs); errors: the InterpolationErrors of both runs, made where there are none."""
    errors = errors or [InterpolationError(run) for run in (a, b)]
    shape_a, shape_b = a.shape_at(time), b.shape_at(time)
    own_errors = [error.at(time) for error in errors]
    own = [key for key, error in zip("ab", errors) if not error.written_at(time)]
    distance = curve_distance((shape_a.r, shape_a.z), (shape_b.r, shape_b.z))
    return {
        "time_us": time,
        "interpolated": own,
        "interpolation_error_nm": None if None in own_errors else sum(own_errors),
        "mean_distance_nm": distance.mean,
        "hausdorff_distance_nm": distance.hausdorff,
        **concentration_difference(shape_a, shape_b),
        **{name: pair(float(a.history_at(name, time)), float(b.history_at(name, time))) for name in COMPARED},
    }


def concentration_profile(shape):
    """Membrane area from the axis (n,) in nm² and concentration c (n,) along a Shape, finely resampled."""
    r, z, c = resample(shape.r, shape.z, PROFILE_SPACING, shape.c)
    return area_from_axis(r, z), c


def concentration_difference(shape_a, shape_b):
    """L1 and maximum difference of c at equal membrane area from the axis, over the area both curves have."""
    (area_a, c_a), (area_b, c_b) = concentration_profile(shape_a), concentration_profile(shape_b)
    area = np.linspace(0.0, min(area_a[-1], area_b[-1]), PROFILE_SAMPLES)
    gap = np.abs(np.interp(area, area_a, c_a) - np.interp(area, area_b, c_b))
    l1 = float(trapezoid(gap, area))
    mass = max(trapezoid(c_a, area_a), trapezoid(c_b, area_b))
    return {
        "concentration_l1_nm2": l1,
        "concentration_l1_relative": l1 / mass if mass > 0 else None,
        "concentration_max": float(gap.max()),
        "patch_area_difference_nm2": _subtract(patch_area(area_b, c_b), patch_area(area_a, c_a)),
    }


def patch_area(area, c):
    """Area (nm²) inside the outermost ring where c falls through 1/2; None when c stays on one side."""
    falls = np.nonzero((c[:-1] >= 0.5) & (c[1:] < 0.5))[0]
    if not falls.size:
        return None
    i = falls[-1]
    return float(area[i] + (c[i] - 0.5) / (c[i] - c[i + 1]) * (area[i + 1] - area[i]))


def pair(a, b):
    """{a, b, difference, relative_difference} of two numbers; None where one is missing or not finite."""
    a, b = (None if value is None or not math.isfinite(value) else value for value in (a, b))
    difference = _subtract(b, a)
    scale = None if difference is None else 0.5 * (abs(a) + abs(b))
    relative = None if difference is None else (difference / scale if scale > 0 else 0.0)
    return {"a": a, "b": b, "difference": difference, "relative_difference": relative}


def _subtract(b, a):
    return None if a is None or b is None else b - a


def budding(a, b):
    """The budding entry of metrics.json from both budding times (µs or None)."""
    both = pair(a, b)
    return {
        "a_us": both["a"],
        "b_us": both["b"],
        "difference_us": both["difference"],
        "relative_difference": both["relative_difference"],
    }


def last_budding(metrics):
    """The later budding time (µs) of both runs, or None when no run buds."""
    return max(
        (time for time in (metrics["budding"]["a_us"], metrics["budding"]["b_us"]) if time is not None), default=None
    )


def compared(records):
    """The records that summary and pictures are made of: without interpolation if there are two or more, else all."""
    written = [record for record in records if not record["interpolated"]]
    return written if len(written) > 1 else records


def summary(records):
    """The summary entry of metrics.json."""
    records = compared(records)
    errors = [record["interpolation_error_nm"] for record in records]
    times = np.array([record["time_us"] for record in records])
    mean = np.array([record["mean_distance_nm"] for record in records])
    hausdorff = np.array([record["hausdorff_distance_nm"] for record in records])
    worst = int(np.argmax(hausdorff))
    span = times[-1] - times[0]
    return {
        "times_compared": len(records),
        "includes_interpolated_shapes": any(record["interpolated"] for record in records),
        "interpolation_error_nm": None if None in errors else max(errors),
        "max_hausdorff_distance_nm": float(hausdorff[worst]),
        "max_hausdorff_distance_time_us": float(times[worst]),
        "time_mean_of_mean_distance_nm": float(trapezoid(mean, times) / span) if span > 0 else float(mean[0]),
        "final_mean_distance_nm": float(mean[-1]),
        "final_hausdorff_distance_nm": float(hausdorff[-1]),
        "max_relative_difference": {name: _largest_relative(records, name) for name in COMPARED},
    }


def _largest_relative(records, name):
    """Largest |relative difference| of a quantity over all times; None when it never exists in both runs."""
    found = [abs(r[name]["relative_difference"]) for r in records if r[name]["relative_difference"] is not None]
    return max(found, default=None)


def flattened(tree, prefix=""):
    """{"a.b": value} of nested dicts, as of parameters by section; of a list of dicts "a.0.b", any other list becomes text."""
    flat = {}
    for key, value in tree.items():
        if isinstance(value, list) and value and all(isinstance(one, dict) for one in value):
            value = {str(i): one for i, one in enumerate(value)}
        if isinstance(value, dict):
            flat.update(flattened(value, f"{prefix}{key}."))
        else:
            flat[prefix + key] = ", ".join(map(str, value)) if isinstance(value, list) else value
    return flat


def case_differences(a, b):
    """[{key, a, b}] for every parameter that differs, the engines' own sections left out; None where a run lacks it."""
    flat_a, flat_b = flattened(a), flattened(b)
    keys = [key for key in dict.fromkeys([*flat_a, *flat_b]) if key.split(".")[0] not in ENGINE_SECTIONS]
    return [
        {"key": key, "a": flat_a.get(key), "b": flat_b.get(key)} for key in keys if flat_a.get(key) != flat_b.get(key)
    ]


def warnings(a, b, differences):
    """Sentences a reader must see before trusting the comparison; not where a run ends or what it writes."""
    found = [
        f"the cases differ in {d['key']}: {d['a']} (A), {d['b']} (B)"
        for d in differences
        if d["key"] != "time.end" and d["key"].split(".")[0] not in ("case", "output")
    ]
    for letter, run in zip("AB", (a, b)):
        if left := unfinished(run.directory, run.record):
            found.append(f"run {letter} ({run.directory}) did not finish: {left}")
        found += [f"run {letter} ({run.directory}): {alarm}" for alarm in run.alarms]
    return found


def interpolation_warnings(records):
    """A sentence about what interpolation adds to the distances where they cannot do without it."""
    found = summary(records)
    if not found["includes_interpolated_shapes"]:
        return []
    error = found["interpolation_error_nm"]
    size = "of unknown size (fewer than three shapes)" if error is None else f"estimated as up to {error:.2g} nm"
    return [
        "the runs wrote shapes at different times: the distances include an interpolation error "
        f"{size}; write shapes at equal times (output.shape_interval)"
    ]


def describe(run, label):
    """The runs entry of metrics.json for one run."""
    record = run.record
    return {
        "label": label,
        "directory": str(run.directory),
        "engine": run.engine,
        "version": record["provenance"].get("version"),
        "git": record["provenance"].get("git"),
        "state": record.get("state"),
        "exit_reason": record.get("exit_reason"),
        "end_us": float(run.history["time_us"][-1]),
        "budding_time_us": run.event_time("budding"),
        "alarms": [asdict(alarm) for alarm in run.alarms],
        "basis": basis(record),
    }
