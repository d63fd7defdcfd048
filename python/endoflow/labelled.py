"""A run as a labelled xarray.Dataset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .history import unit_of
from .shapes import FIELDS

if TYPE_CHECKING:
    from .run_directory import Run

#: Units of a shape's arrays.
UNITS = {"s": "nm", "r": "nm", "z": "nm", "c": "1", "lambda": "pN/nm", "kappa": "1/nm", "u_r": "nm/µs", "u_z": "nm/µs"}


def dataset(run: Run, points: int) -> Any:
    """History columns over `time`, shapes over `shape_time` and `fraction` of arc length from the axis, at `points` points."""
    try:
        import xarray
    except ImportError:
        raise ImportError(
            "to_xarray() needs xarray: install the Debian package python3-xarray, or `pip install xarray`"
        ) from None

    fraction = np.linspace(0.0, 1.0, points)
    variables: dict[str, Any] = {
        name: ("time", values, {"units": unit_of(name)}) for name, values in run.history.items() if name != "time_us"
    }
    for field in FIELDS:
        values = [np.interp(fraction, shape.s / shape.s[-1], shape[field]) for shape in run.shapes]
        variables[f"shape_{field}"] = (("shape_time", "fraction"), np.array(values), {"units": UNITS[field]})
    microseconds = {"units": "µs"}
    coordinates = {
        "time": ("time", run.history["time_us"], microseconds),
        "shape_time": ("shape_time", run.shape_times, microseconds),
        "fraction": ("fraction", fraction, {"units": "1"}),
    }
    attributes = {"engine": run.engine, "directory": str(run.directory)}
    budding = run.event_time("budding")
    return xarray.Dataset(
        variables, coordinates, attributes | ({} if budding is None else {"budding_time_us": budding})
    )
