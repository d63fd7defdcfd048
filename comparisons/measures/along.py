"""What a result goes along: a run along time; stationary shapes along the parameter of their branch, else along their number.

Beside a run a stationary shape, which has no time, holds at all times of the run.
"""

from dataclasses import replace

import numpy as np

from endoflow import EndoflowError

#: Column of history.csv: the value of the parameter that a branch goes along.
FOLLOWED = "followed_value"


class Along:
    """name, unit and values (rows,) of what an endoflow.Run goes along.

    A run's `time` stays the key of its rows and shapes: of stationary shapes it is their number, from 0.
    """

    def __init__(self, run):
        self.run, self.values = run, run.history["time_us"]
        self.is_time = run.engine != "statics"
        self.name, self.unit = ("time", "µs") if self.is_time else ("shape", "")
        branch = run.record.get("notes", {}).get("branch", {})
        if not self.is_time and branch.get("parameter") and FOLLOWED in run.history:
            self.values, self.name, self.unit = run.history[FOLLOWED], branch["parameter"], branch.get("unit", "")

    @property
    def label(self):
        """Of an axis."""
        return f"{self.name} ({self.unit})" if self.unit else self.name

    def value(self, time):
        """The value at a `time`, between rows by a straight line."""
        return time if self.is_time else float(np.interp(time, self.run.history["time_us"], self.values))

    def quantity(self, time, form=".4g"):
        """The value with its unit, and with its name where it is no time."""
        text = f"{self.value(time):{form}}" + (f" {self.unit}" if self.unit else "")
        return text if self.is_time else f"{self.name} {text}"

    def span(self):
        """From the first shape to the last, in words."""
        first, last = (f"{self.value(time):.4g}" for time in self.run.shape_times[[0, -1]])
        text = f"{first} to {last}" + (f" {self.unit}" if self.unit else "")
        return text if self.is_time else f"{self.name} {text}"


class BranchError(EndoflowError):
    """A branch of stationary shapes where one shape is wanted."""

    def __init__(self, run):
        super().__init__(
            f"{run.directory}: holds a branch of {len(run.shapes)} stationary shapes, one is wanted; "
            "repeat `endoflow statics` without --continue-in or --hold"
        )


def is_stationary(run):
    """Whether an endoflow.Run is the result of `endoflow statics`. Raises BranchError for more than one shape."""
    if run.engine != "statics":
        return False
    if len(run.shapes) > 1:
        raise BranchError(run)
    return True


def side_by_side(a, b):
    """Two endoflow.Run objects; where one of them is a stationary shape, it is held over the other's times."""
    if is_stationary(a) == is_stationary(b):
        return a, b
    return (held(a, b), b) if is_stationary(a) else (a, held(b, a))


def held(stationary, run):
    """The stationary Run with its one shape at every output time of `run` and its one row over run's history."""
    times = run.history["time_us"][[0, -1]]
    history = {column: np.full(2, values[0]) for column, values in stationary.history.items()}
    shapes = [replace(stationary.shapes[0], time=time) for time in run.shape_times]
    return replace(stationary, history={**history, "time_us": times}, shapes=shapes)
