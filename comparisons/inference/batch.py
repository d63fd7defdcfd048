"""Many courses at once as arrays, and what they say at the data's times."""

from dataclasses import dataclass

import numpy as np

from comparisons.inference.course import BUDDED, NO_NECK, SECOND_GRID, STAGE_POINTS
from comparisons.inference.observations import WITH_NECK

#: The slope with which a neck is continued to times before it forms, and all to times after the end, is that between these
#: points of the second stage and its ends. The continuation exists to lead a fit back; it is no result.
EARLY_POINT, LATE_POINT = STAGE_POINTS // 2, STAGE_POINTS - 4


@dataclass(frozen=True)
class Batch:
    """n courses of one outcome. neck_time, end: (n,) µs; first, second: {column: (n, STAGE_POINTS)}."""

    outcome: str
    neck_time: np.ndarray
    end: np.ndarray
    first: dict
    second: dict


def batch_of(courses):
    """The Batch of some Courses, all of one outcome."""
    first = {name: np.stack([course.first[name] for course in courses]) for name in courses[0].first}
    second = {name: np.stack([course.second[name] for course in courses]) for name in courses[0].second}
    times = np.array([(course.neck_time, course.end) for course in courses])
    return Batch(courses[0].outcome, times[:, 0], times[:, 1], first, second)


def values_at(batch, column, time):
    """A column (n, m) at times (n, m) in µs; nan where the outcome has no such quantity."""
    if column not in batch.first and column not in batch.second:
        return np.full(time.shape, np.nan)
    neck, end = batch.neck_time[:, None], batch.end[:, None]
    early = None
    if column in batch.first:
        early = _on_grid(batch.first[column], np.cbrt(np.clip(time / neck, 0, 1)))
    if batch.outcome == NO_NECK:
        return early
    second, span = batch.second[column], end - neck
    late = _on_grid(second, np.sqrt(np.clip((time - neck) / span, 0, 1)))
    last = (second[:, -1:] - second[:, LATE_POINT : LATE_POINT + 1]) / (1 - SECOND_GRID[LATE_POINT]) / span
    late += np.where(time > end, last * (time - end), 0)
    if early is None:
        slope = (second[:, EARLY_POINT : EARLY_POINT + 1] - second[:, :1]) / SECOND_GRID[EARLY_POINT] / span
        early = second[:, :1] + slope * (time - neck)
    return np.where(time < neck, early, late)


def _on_grid(values, place):
    """Values (n, STAGE_POINTS) at places (n, m), 0 … 1, of an evenly spaced grid, linearly."""
    place = place * (STAGE_POINTS - 1)
    index = np.minimum(place.astype(int), STAGE_POINTS - 2)
    left = np.take_along_axis(values, index, axis=1)
    return left + (place - index) * (np.take_along_axis(values, index + 1, axis=1) - left)


class Outputs:
    """The order in which a course of one outcome becomes a vector of numbers, and the way back."""

    def __init__(self, course):
        self.outcome, self.end = course.outcome, course.end
        self.stages = [(stage, name) for stage in ("first", "second") for name in getattr(course, stage)]
        self.landmarks = {NO_NECK: 0, BUDDED: 2}.get(course.outcome, 1)

    def vectors(self, courses):
        """(n, outputs) of Courses: logarithms of the moments that depend on parameters, then the curves."""
        batch = batch_of(courses)
        moments = np.log(np.column_stack((batch.neck_time, batch.end)))[:, : self.landmarks]
        return np.hstack([moments, *(getattr(batch, stage)[name] for stage, name in self.stages)])

    def batch(self, vectors):
        """The Batch of vectors (n, outputs)."""
        count = len(vectors)
        end = np.exp(vectors[:, 1]) if self.outcome == BUDDED else np.full(count, self.end)
        neck_time = end if self.outcome == NO_NECK else np.minimum(np.exp(vectors[:, 0]), 0.999 * end)
        stages = {"first": {}, "second": {}}
        for number, (stage, name) in enumerate(self.stages):
            at = self.landmarks + number * STAGE_POINTS
            stages[stage][name] = vectors[:, at : at + STAGE_POINTS]
        return Batch(self.outcome, neck_time, end, stages["first"], stages["second"])


def within_course(batch, column, time):
    """Whether a column exists at times (n, m): not continued beyond what the courses hold."""
    after_neck = time >= batch.neck_time[:, None] if column in WITH_NECK else time >= 0
    exists = column in batch.second or column in batch.first
    return after_neck & (time <= batch.end[:, None] * (1 + 1e-9)) & exists
