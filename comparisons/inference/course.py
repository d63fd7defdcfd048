"""A run's course in stages, so that runs of different speed are alike: numbers that depend smoothly on parameters.

The first stage leads from the start to the moment a neck forms, the second from there to the end: budding, or the last
time asked for. Within a stage quantities stand at fixed fractions of its duration. A batch is many courses as arrays.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from comparisons.inference.observations import WITH_NECK
from comparisons.measures.coat import COAT, coat_of
from comparisons.measures.distances import signed_distances

#: Points of a stage, close together at its start, where curves bend most.
STAGE_POINTS = 61
FIRST_GRID = np.linspace(0, 1, STAGE_POINTS) ** 3
SECOND_GRID = np.linspace(0, 1, STAGE_POINTS) ** 2

#: How a run ended.
NO_NECK, NECK, BUDDED = "no neck", "neck", "budded"

#: Part of a run that its first stage lasts at least: that of a run which starts with a neck would last no time.
EARLIEST = 1e-6

#: Rows after a neck's appearance from which its moment is extrapolated.
ONSET_ROWS = 3

#: The slope with which a neck is continued to times before it forms, and all to times after the end, is that between these
#: points of the second stage and its ends. The continuation exists to lead a fit back; it is no result.
EARLY_POINT, LATE_POINT = STAGE_POINTS // 2, STAGE_POINTS - 4


@dataclass(frozen=True)
class Course:
    """outcome; neck_time and end (µs), neck_time = end without a neck; first, second: {column: (STAGE_POINTS,)} of a stage."""

    outcome: str
    neck_time: float
    end: float
    first: dict
    second: dict


class CourseError(ValueError):
    """A run that makes no course."""


def course_of(run, columns, contours=()):
    """The Course of an endoflow.Run with some columns of its history or of COAT, and the distances of contours' points.

    Raises CourseError for a run that has not moved on from its start, or has no coat though columns are of it.
    """
    history = run.history
    time, budding = history["time_us"], run.event_time("budding")
    end = float(time[-1]) if budding is None else budding
    onset = neck_onset(time, history["neck_radius_nm"], history["bud_diameter_nm"])
    if onset is not None and not np.any(np.isfinite(history["neck_radius_nm"]) & (time > onset[0]) & (time <= end)):
        onset = None  # born with the last row: a stage that lasts no time has no course
    outcome = NO_NECK if onset is None else NECK if budding is None else BUDDED
    neck_time = end if onset is None else max(onset[0], EARLIEST * end)
    first_times = neck_time * FIRST_GRID
    second_times = neck_time + (end - neck_time) * SECOND_GRID
    first, second = {}, {}
    for column in (name for name in columns if name not in COAT):
        known = np.isfinite(history[column])
        if column in WITH_NECK:
            if onset is not None:
                factor = 1 if column == "neck_radius_nm" else 2
                known &= time > neck_time
                curve = _curve(np.append(neck_time, time[known]), np.append(factor * onset[1], history[column][known]))
                second[column] = curve(second_times)
            continue
        curve = _curve(time[known], history[column][known])
        first[column] = curve(first_times)
        if onset is not None:
            second[column] = curve(second_times)
    for name, (times, values) in {**coat_curves(run, columns), **contour_distances(run, contours)}.items():
        first[name] = np.interp(first_times, times, values)
        if onset is not None:
            second[name] = np.interp(second_times, times, values)
    return Course(outcome, neck_time, end, first, second)


def _curve(time, values):
    """Through rows at times that increase or stay; of rows at one time the last one counts. Raises CourseError."""
    kept = np.append(np.diff(time) > 0, True) if len(time) else np.zeros(0, dtype=bool)
    if kept.sum() < 2:
        raise CourseError("the run holds no two moments of what is measured")
    return PchipInterpolator(time[kept], values[kept], extrapolate=True)


def neck_onset(time, neck, diameter):
    """(time in µs, radius in nm) at which a neck forms, None when none does.

    Neck and widest place are born together where the tangent first is upright, and what lies between them grows like
    (t − t₀)^{3/2}: a cubic with a fold. Its power 2/3 is extrapolated to zero, and the mean of both radii linearly. A run
    that starts with a neck has it at its first row.
    """
    rows = np.nonzero(np.isfinite(neck))[0]
    if not rows.size:
        return None
    start = rows[0]
    if start == 0 or rows.size < ONSET_ROWS:
        return float(time[start]), float(neck[start])
    used = slice(start, start + ONSET_ROWS)
    gap = np.maximum(0.5 * diameter[used] - neck[used], 0) ** (2 / 3)
    mean = 0.5 * (0.5 * diameter[used] + neck[used])
    slope, offset = np.polyfit(time[used] - time[start], gap, 1)
    at = time[start] - offset / slope if slope > 0 else time[start]
    at = float(np.clip(at, time[start - 1], time[start]))
    return at, float(np.polyval(np.polyfit(time[used] - at, mean, 1), 0.0))


def contour_distances(run, contours):
    """{name of a contour's point: (times (n,) of a run's shapes, its signed distances (n,) in nm from them)}."""
    if not contours:
        return {}
    r, z = (np.concatenate([getattr(outline, part) for outline in contours]) for part in ("r", "z"))
    distances = np.transpose([signed_distances(r, z, shape.r, shape.z - shape.z[-1]) for shape in run.shapes])
    names = [name for outline in contours for name in outline.columns]
    return {name: (run.shape_times, values) for name, values in zip(names, distances)}


def coat_curves(run, columns):
    """{column: (times, values)} of those columns that are of COAT, from the first shape on that has a coat's edge."""
    wanted = [column for column in columns if column in COAT]
    if not wanted:
        return {}
    coats = [coat_of(shape) for shape in run.shapes]
    start = next((i for i, coat in enumerate(coats) if coat is not None), len(coats))
    lost = [shape.time for shape, coat in zip(run.shapes[start:], coats[start:]) if coat is None]
    if lost or start == len(coats):
        when = f" at t = {lost[0]:g} µs" if lost else ""
        raise CourseError(f"the run has no coat's edge, c = ½, where the closing angle is taken{when}")
    return {column: (run.shape_times[start:], np.array([coat[column] for coat in coats[start:]])) for column in wanted}


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
