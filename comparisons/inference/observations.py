"""Measured numbers with their errors: curves against time, times of events, contours."""

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import endoflow

#: Columns of history.csv that may be data.
QUANTITIES = (
    "neck_radius_nm",
    "bud_diameter_nm",
    "bud_height_nm",
    "membrane_area_nm2",
    "volume_extracellular_nm3",
)

#: Quantities that exist only while there is a neck.
WITH_NECK = ("neck_radius_nm", "bud_diameter_nm")

#: Events, by the name of what an event's datum is compared with.
EVENTS = {"budding": "budding_time_us"}


@dataclass(frozen=True)
class Datum:
    """One number. column: what it is, error: its standard deviation; time: µs, nan for an event; time_name: the unknown
    that is its time where none was measured, or ""."""

    column: str
    time: float
    value: float
    error: float
    time_name: str = ""


@dataclass(frozen=True)
class Contour:
    """An outline r, z (points,) in nm, z from the level of the rim, with its error in nm.

    time: µs, or None for one whose time is unknown, between low and high.
    """

    number: int
    r: np.ndarray
    z: np.ndarray
    error: float
    time: float | None
    low: float
    high: float

    @property
    def time_name(self):
        """Name of the unknown that is its time."""
        return f"contour_{self.number + 1}_time"

    @property
    def columns(self):
        """Names of the distances of its points from the membrane."""
        return [f"contour_{self.number + 1}_point_{i + 1}" for i in range(len(self.r))]

    @property
    def data(self):
        """Its points as data: the distances from the membrane are to be zero."""
        time = math.nan if self.time is None else self.time
        name = self.time_name if self.time is None else ""
        return [Datum(column, time, 0.0, self.error, name) for column in self.columns]


def error_column(quantity):
    """Name of the column with a quantity's error: neck_radius_nm has neck_radius_error_nm."""
    stem, _, unit = quantity.rpartition("_")
    return f"{stem}_error_{unit}"


def table(path, needed, allowed):
    """A CSV with a line of heads as {head: (rows,) array}, nan for empty cells. Raises ValueError naming line and column."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: {getattr(error, 'strerror', None) or 'is no text in UTF-8'}") from None
    heads = [head.strip() for head in rows[0]] if rows else []
    missing, unknown = [head for head in needed if head not in heads], [head for head in heads if head not in allowed]
    if missing or unknown:
        what = f"lacks the column {missing[0]}" if missing else f"has an unknown column {unknown[0]!r}"
        raise ValueError(f"{path}: {what}; known: {', '.join(allowed)}")
    columns = {head: [] for head in heads}
    for number, row in enumerate(rows[1:], start=2):
        if len(row) != len(heads):
            raise ValueError(f"{path}: row {number} has {len(row)} cells where the heads are {len(heads)}")
        for head, cell in zip(heads, row):
            try:
                columns[head].append(float(cell) if cell.strip() else math.nan)
            except ValueError:
                raise ValueError(f"{path}: row {number}, column {head}: {cell!r} is no number") from None
    return {head: np.array(values) for head, values in columns.items()}


def history_data(folder, entry):
    """The Data of `file = …`: columns time_us, a quantity or more, and their errors unless `error` gives one for all."""
    path = folder / entry["file"]
    allowed = ("time_us", *(name for quantity in QUANTITIES for name in (quantity, error_column(quantity))))
    columns = table(path, ("time_us",), allowed)
    found = []
    for quantity in (name for name in QUANTITIES if name in columns):
        errors = columns.get(error_column(quantity))
        if errors is None:
            if "error" not in entry:
                raise ValueError(f"{path}: needs a column {error_column(quantity)}, or error = … beside file")
            errors = np.full(len(columns["time_us"]), float(entry["error"]))
        found += _data(quantity, columns["time_us"], columns[quantity], errors, path)
    if not found:
        raise ValueError(f"{path}: holds no number; known columns: {', '.join(allowed)}")
    return found


def run_data(folder, entry):
    """The Data of `run = DIR`: points of a run's curves at equal intervals of time, each with the error `error`."""
    try:
        run = endoflow.load(folder / entry["run"])
    except endoflow.EndoflowError as error:
        raise ValueError(str(error)) from None
    names = entry.get("columns", ["neck_radius_nm"])
    unknown = [name for name in names if name not in QUANTITIES]
    if unknown:
        raise ValueError(f"columns: {unknown[0]!r} is none of {', '.join(QUANTITIES)}")
    if "error" not in entry:
        raise ValueError("needs error = …, the standard deviation of each number in the unit of its column")
    present = np.all([np.isfinite(run.history[name]) for name in names], axis=0)
    if not present.any():
        raise ValueError(f"{run.directory}: never has {' and '.join(names)}")
    span = run.history["time_us"][present]
    end = min(span[-1], run.event_time("budding") or math.inf)
    first, last = max(span[0], entry.get("from", span[0])), min(end, entry.get("to", end))
    times = np.linspace(first, last, int(entry.get("points", 30)))
    errors = np.full(len(times), float(entry["error"]))
    return [datum for name in names for datum in _data(name, times, run.history_at(name, times), errors, run.directory)]


def event(_folder, entry):
    """The Datum of `event = "budding"`."""
    name = entry["event"]
    if name not in EVENTS:
        raise ValueError(f"event = {name!r}: known: {', '.join(EVENTS)}")
    if "time_us" not in entry or "error_us" not in entry:
        raise ValueError("an event needs time_us and error_us")
    return _data(EVENTS[name], [math.nan], [float(entry["time_us"])], [float(entry["error_us"])], f"event {name}")


def contour(path, entry, number):
    """The Contour of `contour = FILE`: columns r_nm, z_nm."""
    columns = table(path, ("r_nm", "z_nm"), ("r_nm", "z_nm"))
    error = float(entry.get("error_nm", 0))
    if not error > 0:
        raise ValueError(f"{path}: needs error_nm, the standard deviation of its points, greater than 0")
    if not len(columns["r_nm"]) or not all(np.isfinite(values).all() for values in columns.values()):
        raise ValueError(f"{path}: needs points, each with r_nm and z_nm")
    time = entry.get("time_us")
    if time is None and not 0 <= entry.get("low_us", 0) < entry.get("high_us", -1):
        raise ValueError(f"{path}: needs time_us, or high_us (and low_us), between which its time is sought")
    limits = float(entry.get("low_us", 0)), float(entry.get("high_us", 0))
    return Contour(number, columns["r_nm"], columns["z_nm"], error, None if time is None else float(time), *limits)


def _data(column, times, values, errors, source):
    """Data of the cells that are not empty."""
    found = []
    for time, value, error in zip(times, values, errors):
        if math.isnan(value):
            continue
        if not error > 0:
            raise ValueError(f"{Path(source).name}: {column} = {value:g} has the error {error:g}; it must be greater than 0")
        found.append(Datum(column, float(time), float(value), float(error)))
    return found
