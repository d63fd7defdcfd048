"""The runs behind Figs. 5, 6 and 7: the standard case with patches of different radius."""

from dataclasses import replace

import numpy as np
from scipy.integrate import trapezoid

from comparisons.paper.item import both_engines, end_of, is_run, state_of, value_at
from endoflow.curves import area_from_axis

#: Patch radii (nm), 20 to 60 as in the paper; the phase field's with `--quick`.
RADII = tuple(range(20, 61, 4)) + (38,)
QUICK_RADII = (36, 48)

#: Time (µs) at which the paper calls the shapes stationary.
STATIONARY = 20.0

#: A bud whose underside rises by more than this (nm) towards the neck is a mushroom.
DENT = 1.0

#: Earlier time (µs), soon after most radii have budded, at which necks are compared as well.
EARLY = 1.0


def name_of(radius):
    """Name of the run of a patch radius."""
    return f"patch_radius={radius}"


def wanted(quick, sharp_end=STATIONARY):
    """The run of every radius in both engines; sharp_end: µs, of the boundary-integral ones."""
    runs = []
    for radius in sorted(RADII):
        settings = {} if radius == 36 else {"molecules.patch_radius": str(radius)}
        sharp, diffuse = both_engines(name_of(radius), "standard", settings, STATIONARY, quick)
        runs.append(replace(sharp, end=sharp_end))
        if not quick or radius in QUICK_RADII:
            runs.append(diffuse)
    return runs


def underside(shape, neck):
    """How far (nm) the bud's wall rises again between its lowest part and the neck, of index `neck`: 0 for a sphere."""
    widest = int(np.argmax(shape.r[:neck]))
    z = shape.z[widest : neck + 1]
    return float((z - np.minimum.accumulate(z)).max())


def morphology(shape):
    """ "no neck", "spherical" or "mushroom" (its underside rises by more than DENT), of a Shape."""
    neck = neck_index(shape)
    if neck is None:
        return "no neck"
    return "mushroom" if underside(shape, neck) > DENT else "spherical"


def roundness(shape, neck_index):
    """Volume of the bud above its neck over that of the sphere with the same area: 1 for a sphere."""
    r, z = shape.r[: neck_index + 1], shape.z[: neck_index + 1]
    area = area_from_axis(r, z)[-1] + np.pi * r[-1] ** 2
    volume = abs(trapezoid(np.pi * r**2, z))
    return volume / (area**1.5 / (6 * np.sqrt(np.pi)))


def neck_index(shape):
    """Index of the neck of a Shape: the first local minimum of r after its first local maximum; None without one."""
    rises = np.diff(shape.r) > 0
    tops = np.nonzero(rises[:-1] & ~rises[1:])[0] + 1
    if not tops.size:
        return None
    bottoms = np.nonzero(~rises[tops[0] : -1] & rises[tops[0] + 1 :])[0]
    return int(tops[0] + bottoms[0] + 1) if bottoms.size else None


def table(runs):
    """One row {column: value} for each radius and engine, of what is there at STATIONARY or at the run's end."""
    rows = []
    for radius in sorted(RADII):
        for engine, run in runs[name_of(radius)].items():
            row = {"patch_radius_nm": radius, "engine": engine, "state": state_of(run), "end_us": None, "budding_time_us": None}
            measured = ("neck_radius_nm", "bud_diameter_nm", "bud_height_nm", "roundness", "underside_rise_nm", "shape")
            row |= dict.fromkeys((*measured, "neck_radius_at_1_us_nm", "diameter_at_budding_nm"))
            rows.append(row)
            if not is_run(run):
                continue
            end = end_of(run)
            shape = run.shape_at(min(STATIONARY, float(run.shape_times[-1])))
            row |= {"end_us": end, "budding_time_us": run.event_time("budding")}
            for column in ("neck_radius_nm", "bud_diameter_nm", "bud_height_nm"):
                row[column] = value_at(run, column, min(STATIONARY, end))
            row["neck_radius_at_1_us_nm"] = value_at(run, "neck_radius_nm", EARLY)
            row["shape"], neck = morphology(shape), neck_index(shape)
            if neck is not None:
                row |= {"roundness": float(roundness(shape, neck)), "underside_rise_nm": underside(shape, neck)}
            if row["budding_time_us"] is not None:
                row["diameter_at_budding_nm"] = value_at(run, "bud_diameter_nm", row["budding_time_us"])
    return rows


def of_engine(rows, engine, column):
    """(radii, values) of an engine's rows that have a value."""
    found = [
        (row["patch_radius_nm"], row[column]) for row in rows if row["engine"] == engine and row[column] is not None
    ]
    return np.array(found, dtype=float).reshape(-1, 2).T


def best(x, y):
    """(radius, value) of the smallest of positive values y at radii x, refined by the parabola of log y through its
    neighbours (that of y itself can end below zero).

    None without values; the grid's own point at its ends.
    """
    if not len(x):
        return None
    i = int(np.argmin(y))
    if i in (0, len(x) - 1):
        return float(x[i]), float(y[i])
    a, b, c = np.polyfit(x[i - 1 : i + 2] - x[i], np.log(y[i - 1 : i + 2]), 2)
    return float(x[i] - b / (2 * a)), float(np.exp(c - b * b / (4 * a)))
