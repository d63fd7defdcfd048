"""A stationary shape (`endoflow statics`) beside a run: it has no time, so it holds at all times of the run."""

from dataclasses import replace

import numpy as np

from endoflow import EndoflowError


class BranchError(EndoflowError):
    """A branch of stationary shapes where one shape is wanted."""

    def __init__(self, run):
        super().__init__(
            f"{run.directory}: holds a branch of {len(run.shapes)} stationary shapes, one is wanted; "
            "repeat `endoflow statics` without --continue-in"
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
