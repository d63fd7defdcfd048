"""Measured numbers with their errors: curves against time, times of events, contours, pits that were each seen once."""

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

import endoflow
from comparisons.inference.csv_table import Layout, read_table
from comparisons.inference.study_keys import MEASURABLE, error_column
from comparisons.measures.coat import COAT
from comparisons.measures.quantities import BUDDING, columns

#: Quantities that exist only while there is a neck.
WITH_NECK = columns("of_neck")

#: Columns of a point.
POINT = ("r_nm", "z_nm")

#: Most points of a file of outlines: the sampler's time is proportional to their number.
MOST_POINTS = 500

#: Closing angles (degrees) and sizes of curvatures (1/nm) that a coat can have, with the errors of measurement.
ANGLES, SHARPEST = (-90.0, 270.0), 1.0

#: What may be negative; the others are sizes.
SIGNED = columns("signed")

#: Events, by the name of what an event's datum is compared with.
EVENTS = {"budding": BUDDING}


@dataclass(frozen=True)
class Datum:
    """One number. column: what it is, error: its standard deviation; time: µs, nan for an event; time_name: the unknown
    that is its time where none was measured, or ""; place: where it was read, for messages."""

    column: str
    time: float
    value: float
    error: float
    time_name: str = ""
    place: str = ""


@dataclass(frozen=True)
class Moments:
    """What is known of the time at which a pit was seen: not before `start` (µs of the run) and, if even, as likely at any time from
    there to the run's end."""

    even: bool
    start: float


@dataclass(frozen=True)
class Pit:
    """A pit that was seen once, with one time for all its Data; moments: what is known of that."""

    data: tuple
    moments: Moments

    @property
    def columns(self):
        """What was measured, each of it once."""
        return tuple(datum.column for datum in self.data)

    @property
    def place(self):
        """Where it was read."""
        return self.data[0].place


@dataclass(frozen=True)
class Contour:
    """An outline r, z (points,) in nm with its error in nm, z from the level of the rim or, from_floor, from the box's floor.

    time: µs, or None for one whose time is unknown: an unknown between low and high or, with `moments`, summed over; places: where
    each point was read, for messages.
    """

    number: int
    r: np.ndarray
    z: np.ndarray
    from_floor: bool
    error: float
    time: float | None
    low: float
    high: float
    places: tuple
    moments: Moments | None = None

    @property
    def time_name(self):
        """Name of the unknown that is its time."""
        return f"contour_{self.number + 1}_time"

    @property
    def is_dated_by_unknown(self):
        """Whether its time is one of the unknowns."""
        return self.time is None and self.moments is None

    @property
    def columns(self):
        """Names of the distances of its points from the membrane."""
        return [f"contour_{self.number + 1}_point_{i + 1}" for i in range(len(self.r))]

    @property
    def data(self):
        """Its points as data: the distances from the membrane are to be zero."""
        time = math.nan if self.time is None else self.time
        name = self.time_name if self.is_dated_by_unknown else ""
        return [Datum(column, time, 0.0, self.error, name, place) for column, place in zip(self.columns, self.places)]


def layout_of(keys, where):
    """The Layout that the keys of a [[data]] (dict) say. Raises ValueError."""
    names = {field.name for field in dataclasses.fields(Layout)}
    found = Layout(where=where, **{name: value for name, value in keys.items() if name in names})
    if (found.length_unit == "pixel") != (found.pixel_nm is not None):
        raise ValueError('pixel_nm and length_unit = "pixel" need each other')
    return found


def history_data(folder, keys, where):
    """The Data of `file = …`: columns time_us, a quantity or more, and their errors unless `error` gives one for all."""
    path = folder / keys["file"]
    allowed = ("time_us", *with_errors(MEASURABLE))
    table = read_table(path, ("time_us",), allowed, layout_of(keys, where))
    found = []
    for quantity in MEASURABLE:
        errors = _errors(table, quantity, keys, "error", "file")
        if errors is not None:
            found += _curve(table, quantity, errors)
    if not found:
        raise ValueError(f"{path}: holds no number; known columns: {', '.join(allowed)}")
    return found


def with_errors(quantities):
    """Columns of quantities and of their errors."""
    return tuple(name for quantity in quantities for name in (quantity, error_column(quantity)))


def _errors(table, quantity, keys, key, kind):
    """Errors (rows,) of a quantity of a Table, of its own column or one for all, keys[key] beside `kind = FILE`; None without the quantity."""
    name = error_column(quantity)
    if quantity not in table.columns:
        if name in table.columns:
            raise ValueError(f"{table.path}: has {name} without {quantity}")
        return None
    if name in table.columns:
        return table.columns[name]
    if keys[key] is None:
        raise ValueError(f"{table.path}: needs a column {name}, or {key} = … beside {kind}")
    return np.full(len(table.lines), keys[key])


def _curve(table, quantity, errors):
    """Data of the rows of a Table that have a quantity."""
    found = []
    for row, (time, value, error) in enumerate(zip(table.columns["time_us"], table.columns[quantity], errors)):
        if math.isnan(value):
            continue
        place = table.place(row)
        if math.isnan(time):
            raise ValueError(f"{place}: time_us is empty, though {quantity} = {value:g}; leave both empty or none")
        _require_number(place, quantity, value, error)
        found.append(Datum(quantity, float(time), float(value), float(error), place=place))
    return found


def _require_number(place, quantity, value, error):
    """Refuses an error that is no standard deviation, and a size that is not positive."""
    if not 0 < error < math.inf:
        what = "is empty" if math.isnan(error) else f"= {error:g}"
        raise ValueError(f"{place}: {error_column(quantity)} {what}; it must be greater than 0, a standard deviation")
    if value <= 0 and quantity not in SIGNED:
        raise ValueError(f"{place}: {quantity} = {value:g} must be greater than 0; leave the cell empty where there is none")


def pits(folder, keys, where):
    """The Pits of `pits = FILE`: one in each row with columns of COAT and their errors, unless keys give errors for all."""
    path, moments = folder / keys["pits"], moments_of(keys)
    allowed = with_errors(COAT)
    table = read_table(path, (), allowed, layout_of(keys, where))
    errors = {quantity: _errors(table, quantity, keys, error_column(quantity), "pits") for quantity in COAT}
    found = [_pit(table, row, errors, moments) for row in range(0, len(table.lines), keys["every"])]
    if not found:
        raise ValueError(f"{path}: holds no pit; known columns: {', '.join(allowed)}")
    return found


def _pit(table, row, errors, moments):
    """The Pit of a row of a Table. errors: {quantity: errors (rows,), None without it}."""
    place, data = table.place(row), []
    for quantity in (name for name in COAT if errors[name] is not None):
        value, error = table.columns[quantity][row], errors[quantity][row]
        if math.isnan(value):
            continue
        _require_number(place, quantity, value, error)
        _require_coat(place, quantity, value)
        data.append(Datum(quantity, math.nan, float(value), float(error), place=place))
    if len(data) < (1 if moments.even else 2):
        what = f"{data[0].column} alone" if data else "no number"
        remedy = 'a pit of unknown time needs two; leave the row out, or say moments = "even" if it is known how pits were chosen'
        raise ValueError(f"{place}: holds {what}; {remedy if data else 'leave the row out'}")
    return Pit(tuple(data), moments)


def _require_coat(place, quantity, value):
    """Refuses what no coat has: it is in another unit."""
    if quantity == "closing_angle_deg" and not ANGLES[0] <= value <= ANGLES[1]:
        raise ValueError(f"{place}: {quantity} = {value:g} is no closing angle; it is in degrees, 0 for a flat coat, 180 for a sphere")
    if quantity == "coat_curvature_per_nm" and abs(value) > SHARPEST:
        raise ValueError(f"{place}: {quantity} = {value:g} is a radius of {1 / abs(value):.2g} nm; say length_unit = … if it is in another unit")


def moments_of(keys):
    """The Moments that the keys of a [[data]] (dict) say."""
    return Moments(keys["moments"] == "even", keys["from_us"])


def run_data(folder, keys, where):
    """The Data of `run = DIR`: points of a run's curves at equal intervals of time, each with the error `error`."""
    try:
        run = endoflow.load(folder / keys["run"])
    except endoflow.EndoflowError as error:
        raise ValueError(str(error)) from None
    names, error = keys["columns"], keys["error"]
    lacking = [name for name in names if name not in run.history]
    if lacking:
        raise ValueError(f"columns: {run.directory} has no {lacking[0]}")
    present = np.all([np.isfinite(run.history[name]) for name in names], axis=0)
    if not present.any():
        raise ValueError(f"columns: {run.directory} never has {' and '.join(names)}")
    span = run.history["time_us"][present]
    budding = run.event_time("budding")
    end = span[-1] if budding is None else min(span[-1], budding)
    first = span[0] if keys["from"] is None else max(span[0], keys["from"])
    last = end if keys["to"] is None else min(end, keys["to"])
    if not first <= last:
        allowed = f"{run.directory} has {' and '.join(names)} from {span[0]:g} to {end:g} µs"
        key = "from" if keys["to"] is None or keys["to"] > span[0] else "to"
        raise ValueError(f"{key} = {keys[key]:g}: leaves no time; {allowed}")
    times = np.linspace(first, last, keys["points"])
    return [
        Datum(name, float(time), float(value), error, place=f"{where}: {run.directory}")
        for name in names
        for time, value in zip(times, run.history_at(name, times))
        if np.isfinite(value)
    ]


def event(_folder, keys, where):
    """The Datum of `event = "budding"`."""
    return [Datum(EVENTS[keys["event"]], math.nan, keys["time_us"], keys["error_us"], place=f"{where}: event")]


def contour(folder, keys, where, number):
    """The Contour of `contour = FILE`: columns r_nm, z_nm."""
    path, time = folder / keys["contour"], keys["time_us"]
    if time is None and keys["high_us"] is None:
        raise ValueError("needs time_us, or high_us (and low_us), between which its time is sought")
    if time is not None and keys["high_us"] is not None:
        raise ValueError("has time_us and high_us; leave out high_us where its time is known")
    if time is None and not keys["low_us"] < keys["high_us"]:
        raise ValueError(f"low_us = {keys['low_us']:g} must be below high_us = {keys['high_us']:g}")
    table = read_table(path, POINT, POINT, layout_of(keys, where))
    r, z, rows = _points(table, keys, where)
    places = tuple(table.place(row) for row in rows)
    limits = keys["low_us"], 0.0 if keys["high_us"] is None else keys["high_us"]
    return Contour(number, r, z, keys["z_from"] == "floor", keys["error_nm"], time, *limits, places)


def outlines(folder, keys, where, number):
    """The Contours, numbered from `number` on, of `outlines = FILE`: columns pit, r_nm, z_nm; those with one pit are an outline."""
    names, moments = ("pit", *POINT), moments_of(keys)
    table = read_table(folder / keys["outlines"], names, names, layout_of(keys, where))
    r, z, rows = _points(table, keys, where)
    labels = table.columns["pit"][rows]
    for row, label in zip(rows, labels):
        if label != np.floor(label):  # nan, too
            what = "is empty" if math.isnan(label) else f"= {label:g}"
            raise ValueError(f"{table.place(row)}: pit {what}; it is a whole number, the same for all points of an outline")
    found = []
    for label in dict.fromkeys(labels):
        own = np.nonzero(labels == label)[0]
        if len(own) < 2:
            raise ValueError(f"{table.place(rows[own[0]])}: is the only point of pit {label:g}; an outline of unknown time needs two")
        places = tuple(table.place(rows[i]) for i in own)
        floor, error = keys["z_from"] == "floor", keys["error_nm"]
        found.append(Contour(number + len(found), r[own], z[own], floor, error, None, 0.0, 0.0, places, moments))
    return found


def _points(table, keys, where):
    """(r, z, their rows) of a Table's points that count, r on the right. Raises ValueError."""
    r, z = (table.columns[name] for name in POINT)
    if not len(r):
        raise ValueError(f"{table.path}: holds no point")
    rows = range(0, len(r), keys["every"])
    if len(rows) > MOST_POINTS:
        every = math.ceil(len(r) / MOST_POINTS)
        raise ValueError(f"{table.path}: has {len(rows)} points, more than {MOST_POINTS}; say every = {every} in {where}")
    for row in range(len(r)):
        empty = [name for name in POINT if math.isnan(table.columns[name][row])]
        if empty:
            raise ValueError(f"{table.place(row)}: {empty[0]} is empty; a point needs r_nm and z_nm")
    if keys["half_planes"] == "both":
        r = np.abs(r)
    negative = np.nonzero(r < 0)[0]
    if negative.size:
        what = f"r_nm = {r[negative[0]]:g} is left of the axis"
        raise ValueError(f'{table.place(negative[0])}: {what}; say half_planes = "both", which mirrors such points, in {where}')
    return r[rows], z[rows], rows
