"""A whole run directory."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from .alarms import Alarm, alarms_of, is_alarm
from .arrays import Array
from .errors import RERUN, OutOfRangeError, RunDirectoryError
from .fields import Fields, field_files, read_fields
from .history import interpolated, read_history, unit_of
from .results import what_else
from .run_state import current_record
from .shapes import Shape, between, read_shapes

if TYPE_CHECKING:
    import xarray


#: How often the files of a run at work are tried, and seconds between two tries: writing a shape takes milliseconds.
TRIES, PAUSE = 5, 0.05


@dataclass(frozen=True)
class Run:
    """One run. Units: nm, µs, pN.

    record:     run.json as a dict (engine, versions, host, wall times, events, …); its `state` is "killed" where the file says
                "running" and nobody runs
    parameters: resolved parameters by section, parameters["molecules"]["patch_radius"]
    history:    {column: array (steps,)}, nan where a cell is empty; history_units: {column: unit}
    shapes:     list of Shape in order of time
    """

    directory: Path
    record: dict[str, Any]
    parameters: dict[str, Any]
    history: dict[str, Array] = field(repr=False)
    shapes: list[Shape] = field(repr=False)

    @property
    def engine(self) -> str:
        """Name of the engine: "boundary-integral" or "phase-field"."""
        return str(self.record["engine"])

    @property
    def columns(self) -> dict[str, str]:
        """{column of the history: what it is} in the words of run.json; empty where it does not say."""
        return dict(self.record.get("columns", {}))

    @property
    def history_units(self) -> dict[str, str]:
        """{column: unit}, read off the column names."""
        return {column: unit_of(column) for column in self.history}

    @property
    def shape_times(self) -> Array:
        """Times (µs) of the shapes, shape (number of shapes,)."""
        return np.array([shape.time for shape in self.shapes])

    @property
    def field_times(self) -> Array:
        """Times (µs) of the fields for ParaView, shape (number of files,)."""
        return np.array([time for time, _ in field_files(self.directory)])

    def fields_at(self, time: float) -> Fields | None:
        """The Fields nearest to `time` (µs); None when the run wrote none."""
        files = field_files(self.directory)
        return read_fields(*min(files, key=lambda entry: abs(entry[0] - time))) if files else None

    def event_time(self, name: str) -> float | None:
        """Time (µs) of the event called `name` (e.g. "budding"), or None."""
        event = self.record.get("events", {}).get(name)
        return None if event is None else float(event["time_us"])

    @property
    def alarms(self) -> list[Alarm]:
        """What left the bounds of an accurate run, a list of Alarm; empty for a run that may be trusted."""
        return alarms_of(self.record)

    def until(self, time: float) -> Run:
        """The run as it would be had it ended at `time` (µs): rows, shapes and events up to then."""
        latest = time + 1e-9 * max(1.0, abs(time))
        kept = self.history["time_us"] <= latest
        alarms = [alarm for alarm in self.record.get("alarms") or [] if alarm["time_us"] <= latest]
        events = {name: event for name, event in self.record["events"].items() if event["time_us"] <= latest}
        return replace(
            self,
            record={**self.record, "events": events, "alarms": alarms},
            history={column: values[kept] for column, values in self.history.items()},
            shapes=[shape for shape in self.shapes if shape.time <= latest],
        )

    def to_xarray(self, points: int = 200) -> xarray.Dataset:
        """The run as an xarray.Dataset: every history column over `time`, and the shapes at `points` points each, with units."""
        from .labelled import dataset

        return dataset(self, points)

    def history_at(self, column: str, time: float | Array) -> Any:
        """A history column at `time` (µs; number or array), between rows by a cubic; nan outside and beside gaps."""
        return interpolated(self.history["time_us"], self.history[column], time)

    def shape_at(self, time: float) -> Shape:
        """The membrane at `time` (µs), interpolated between the neighbouring shapes at fixed material points.

        Raises OutOfRangeError before the first or after the last shape.
        """
        times = self.shape_times
        tolerance = 1e-9 * max(1.0, abs(times[-1]))
        nearest = int(np.argmin(np.abs(times - time)))
        if abs(times[nearest] - time) <= tolerance:
            return self.shapes[nearest]
        if not times[0] < time < times[-1]:
            raise OutOfRangeError(
                f"{self.directory}: no shape at {time:g} µs; shapes cover {times[0]:g} to {times[-1]:g} µs"
            )
        after = int(np.searchsorted(times, time))
        return between(self.shapes[after - 1], self.shapes[after], float(time))


def load(directory: Union[str, Path]) -> Run:
    """Read a run directory (path) into a Run. Raises RunDirectoryError when something is missing or damaged.

    Files of a run at work may be met while a row or a shape is written: they are read again.
    """
    directory = Path(directory)
    if not directory.is_dir():
        raise RunDirectoryError(directory, "no such directory", "give the directory that `endoflow run -o` wrote")
    record = _read_record(directory)
    for left in range(TRIES, 0, -1):
        try:
            history = read_history(directory / "history.csv", ("time_us", *record.get("columns", ())))
            shapes = read_shapes(directory / "shapes.h5")
            break
        except RunDirectoryError:
            if record.get("state") != "running" or left == 1:
                raise
            time.sleep(PAUSE)
    return Run(directory=directory, record=record, parameters=record["parameters"], history=history, shapes=shapes)


def _read_record(directory: Path) -> dict[str, Any]:
    """run.json as a dict with at least `engine` and `parameters`."""
    path = directory / "run.json"
    try:
        record = current_record(directory)
    except FileNotFoundError:
        raise RunDirectoryError(path, "the file is missing", what_else(directory)) from None
    except (OSError, ValueError) as error:
        raise RunDirectoryError(path, f"cannot be read as JSON ({error})", RERUN) from None
    for key, kind in (("engine", str), ("parameters", dict), ("provenance", dict), ("events", dict)):
        if not isinstance(record.get(key), kind):
            raise RunDirectoryError(path, f"has no `{key}`", "is this a directory of `endoflow run`?")
    damage = damage_of(record)
    if damage:
        raise RunDirectoryError(path, damage, RERUN)
    return record


def damage_of(record: dict[str, Any]) -> str | None:
    """What is wrong with the times, events and alarms of a run.json (dict), as text; None when all is well."""
    if not _is_number(record["parameters"].get("time", {}), "end"):
        return "has no `parameters.time.end`"
    if record.get("time_us") is not None and not _is_number(record, "time_us"):
        return "`time_us` is not a number"
    events, alarms = record.get("events", {}), record.get("alarms") or []
    if not isinstance(events, dict):
        return "`events` is not an object"
    for name, event in events.items():
        if not _is_number(event, "time_us"):
            return f"event `{name}` has no `time_us`"
    if not isinstance(alarms, list) or not all(map(is_alarm, alarms)):
        return "an entry of `alarms` lacks name, time_us, value or bound"
    return None


def _is_number(entry: Any, key: str) -> bool:
    """Whether something read from JSON is an object with a number under this key."""
    value = entry.get(key) if isinstance(entry, dict) else None
    return isinstance(value, (int, float)) and not isinstance(value, bool)
