"""What a result goes along: a run along time; stationary shapes along the parameter of their branch, else along their number."""

import numpy as np

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
