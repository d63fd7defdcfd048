"""What is to be inferred: data, unknowns and the arithmetic between the coordinates of unknowns, runs and data.

Coordinates x (n, unknowns) are those of the priors. The first `engine_count` unknowns need a run each time they change; the
others (a pure slowing down, a shift of time, times of contours) act on a finished course.

What the runs of the case cannot have (times outside them, outlines outside the box) is refused before the first run, with where it
was read and the key that would mend it.
"""

import dataclasses
import difflib

import numpy as np

from comparisons.errors import BAD_INPUT, StudyError
from comparisons.inference.course import BUDDED, values_at, within_course
from comparisons.inference.observations import EVENTS, Pit
from comparisons.inference.pits import drawn, log_likelihoods, nearest, path_of, times
from comparisons.inference.study_file import MOST_UNKNOWNS, horizon, is_exact_time_scale
from comparisons.inference.study_keys import MEASURABLE
from comparisons.measures.coat import COAT
from comparisons.measures.metrics import flattened

#: Rounding of a time that is meant to be the end of the runs, relative.
ROUNDING = 1e-6

#: What may mend a length.
UNIT = 'say length_unit = "Å" or whatever it is'

#: An outline that comes nearer to the wall than this part of the radius shows where the membrane is attached, at z = 0; from
#: there the membrane rises by less than STEEPEST times the distance, and the errors by less than this many deviations.
NEAR_WALL, STEEPEST, DEVIATIONS = 0.05, 3.0, 10.0

#: Largest (prediction − value)/error, in size: its square is a number, too.
LARGEST_RESIDUAL = 1e30

#: Digits of a parameter: a run is found again by them.
DIGITS = 10


def checked(study, parameters, exact):
    """The StudyFile with outlines whose z is from the rim's level. parameters: resolved, of the case; exact: Unknowns that act
    on finished courses. Raises StudyError."""
    contours = tuple(_inside(study, outline, parameters["domain"]) for outline in study.contours)
    for datum in study.data:
        _require_size(study, datum, parameters["domain"])
    earliest, latest = times_of_data(exact, horizon(study, parameters))
    slack = ROUNDING * (latest - earliest)
    for place, key, time, remedy in _times(study.data, contours, study.pits):
        where = f"{place}: {key} = {time:g} µs"
        if time < earliest - slack:
            remedy = "a shift between clocks is an unknown with time_offset = true"
            _refuse(study, f"{where} is before the start of the runs, {earliest:g} µs; {remedy}")
        if time > latest + slack:
            _refuse(study, f"{where} is after the end of the runs, {latest:g} µs; {remedy}")
    return dataclasses.replace(study, contours=contours)


def _times(data, contours, pits):
    """(place, key, time in µs, what to do about one after the end) of every time that a study names."""
    later = "raise horizon in [study]"
    for datum in data:
        if datum.column in EVENTS.values():
            yield datum.place, "time_us", datum.value, later
        else:
            yield datum.place, "time_us", datum.time, f'{later}, or say time_unit = "ns" or whatever it is'
    for outline in contours:
        named = {"time_us": outline.time} if outline.time is not None else {"low_us": outline.low, "high_us": outline.high}
        if outline.moments:
            named = {"from_us": outline.moments.start}
        for key, time in named.items():
            yield outline.places[0].rpartition(":")[0], key, time, later
    for pit in pits:
        yield pit.place.rpartition(":")[0], "from_us", pit.moments.start, later


def times_of_data(exact, end):
    """Earliest and latest time (µs) of the data's clock that runs up to `end` can have under the priors of exact Unknowns."""
    earliest, latest = 0.0, end
    for unknown in exact:
        low, high = (float(unknown.prior.value(x)) for x in (unknown.prior.lowest, unknown.prior.highest))
        if unknown.scales:
            latest *= high
    for unknown in exact:
        if unknown.time_offset:
            low, high = (float(unknown.prior.value(x)) for x in (unknown.prior.lowest, unknown.prior.highest))
            earliest, latest = earliest + low, latest + high
    return earliest, latest


def _require_size(study, datum, domain):
    """Refuses a length that is larger than the box (the section `domain` of the parameters)."""
    rim, top, wall = domain["membrane_height"], domain["height"], domain["radius"]
    most = {"neck_radius_nm": wall, "bud_diameter_nm": 2 * wall, "bud_height_nm": max(rim, top - rim)}.get(datum.column)
    if domain.get("kind") != "free-space" and most is not None and abs(datum.value) > most:
        what = f"{datum.column} = {datum.value:g} nm is more than the domain has room for, {most:g} nm"
        _refuse(study, f"{datum.place}: {what}; {UNIT}")


def _inside(study, outline, domain):
    """A Contour with z from the rim's level, its points within the box (the section `domain` of the parameters)."""
    if domain.get("kind") == "free-space":
        if outline.from_floor:
            _refuse(study, f'{outline.places[0]}: z_from = "floor": a vesicle in free space has no floor')
        return outline
    rim, top, wall = domain["membrane_height"], domain["height"], domain["radius"]
    z = outline.z - rim if outline.from_floor else outline.z
    for place, r, height in zip(outline.places, outline.r, z):
        if r > wall:
            what = f"r_nm = {r:g} nm is outside the domain, domain.radius = {wall:g}"
            _refuse(study, f"{place}: {what}; leave the point out, or {UNIT}")
        if not -rim <= height <= top - rim:
            if outline.from_floor:
                given, remedy = f"z_nm = {height + rim:g} nm from the floor", 'leave out z_from = "floor"'
            else:
                given, remedy = f"z_nm = {height:g} nm from the level of the rim", 'say z_from = "floor" if it is from there'
            what = f"{given} is outside the domain, {top:g} nm high with the rim at {rim:g}"
            _refuse(study, f"{place}: {what}; {remedy}, or {UNIT}")
    last = int(outline.r.argmax())
    gap, height = wall - outline.r[last], float(z[last])
    if gap < NEAR_WALL * wall and abs(height) > STEEPEST * gap + DEVIATIONS * outline.error:
        given = f"z_nm = {height:g} nm from the level of the rim at r_nm = {outline.r[last]:g} nm"
        remedy = "z_from in [[data]] says from where z is measured"
        _refuse(study, f"{outline.places[last]}: {given}, where the membrane is attached at 0; {remedy}")
    return dataclasses.replace(outline, z=z, from_floor=False)


def _refuse(study, what):
    raise StudyError(f"{study.path}: {what}", BAD_INPUT)


class Problem:
    """A StudyFile with the resolved parameters of its case. Raises StudyError for unknowns that the case does not have and
    data that its runs cannot have."""

    def __init__(self, study, parameters):
        exact = [u for u in study.unknowns if is_exact(u, parameters)]
        self.study = study = checked(study, parameters, exact)
        self.parameters, self.base = parameters, flattened(parameters)
        self.unknowns = [*(u for u in study.unknowns if u not in exact), *exact]
        self.engine_count = len(self.unknowns) - len(exact)
        if self.engine_count > MOST_UNKNOWNS:
            what = f"{self.engine_count} unknowns need runs; at most {MOST_UNKNOWNS} are possible"
            raise StudyError(f"{study.path}: {what}", BAD_INPUT)
        self.names = [unknown.name for unknown in self.unknowns]
        self.priors = [unknown.prior for unknown in self.unknowns]
        self.limits = np.array([(prior.lowest, prior.highest) for prior in self.priors])
        self.contours = study.contours
        seen_once = [contour for contour in study.contours if contour.moments]
        self.pits = [*study.pits, *(Pit(tuple(contour.data), contour.moments) for contour in seen_once)]
        self.data = [
            *study.data,
            *(datum for contour in study.contours if not contour.moments for datum in contour.data),
            *(datum for pit in self.pits for datum in pit.data),
        ]
        self.values = np.array([datum.value for datum in self.data])
        self.errors = np.array([datum.error for datum in self.data])
        first = len(self.data) - sum(len(pit.data) for pit in self.pits)
        self.of_pits = np.arange(len(self.data)) >= first
        self._groups, self._pit_groups = {}, {}
        for index, datum in enumerate(self.data[:first]):
            self._groups.setdefault((datum.column, datum.time_name), []).append(index)
        for number, pit in enumerate(self.pits):
            indices = range(first, first + len(pit.data))
            self._pit_groups.setdefault((pit.columns, pit.moments), []).append((number, indices))
            first = indices.stop
        self._check()

    def _check(self):
        numbers = [key for key, value in self.base.items() if isinstance(value, (int, float)) and not isinstance(value, bool)]
        for unknown in self.unknowns[: self.engine_count]:
            for key in (unknown.key, *unknown.scales, *unknown.divides):
                if key and key not in numbers:
                    near = difflib.get_close_matches(key, numbers, 1)
                    hint = f"did you mean {near[0]}?" if near and key not in self.base else "see endoflow params"
                    what = f"{key} is no parameter with a number; {hint}"
                    raise StudyError(f"{self.study.path}: unknown {unknown.name}: {what}", BAD_INPUT)

    @property
    def columns(self):
        """Columns of history.csv, and of coats, that courses need: those with data, and what pages show anyhow."""
        measured = {datum.column for datum in self.data}
        shown = ("neck_radius_nm", "bud_diameter_nm", "bud_height_nm")
        return [name for name in (*MEASURABLE, *COAT) if name in measured or name in shown]

    def settings(self, point):
        """{key: text} that a run with engine coordinates (engine_count,) has on top of the study's own."""
        found = {}
        for unknown, x in zip(self.unknowns[: self.engine_count], point):
            value = float(unknown.prior.value(x))
            if unknown.key:
                found[unknown.key] = value
            for keys, factor in ((unknown.scales, value), (unknown.divides, 1 / value)):
                for key in keys:
                    found[key] = found.get(key, self.base[key]) * factor
        return {key: f"{value:.{DIGITS}g}" for key, value in found.items()}

    def coordinates(self, parameters):
        """Coordinates (unknowns,) of a run with these parameters. Raises StudyError where they do not say what an unknown is."""
        flat, found = flattened(parameters), []
        for unknown, (lowest, highest) in zip(self.unknowns, self.limits):
            if not unknown.key:
                raise StudyError(f"unknown {unknown.name} is no parameter's value: no run says what it truly is", BAD_INPUT)
            value = float(flat[unknown.key])
            x = float(unknown.prior.coordinate(value))
            if not lowest <= x <= highest:
                raise StudyError(f"{unknown.key} = {value:g} is outside of what its prior allows; widen it", BAD_INPUT)
            found.append(x)
        return np.array(found)

    def points(self, fractions):
        """Coordinates (n, k) of the first k unknowns, below which these fractions (n, k) of their priors lie."""
        columns = [prior.from_fraction(part) for prior, part in zip(self.priors, fractions.T)]
        return np.column_stack(columns) if columns else np.empty(fractions.shape)

    def display(self, x):
        """Values (n, unknowns) of coordinates."""
        return np.column_stack([prior.value(x[:, i]) for i, prior in enumerate(self.priors)])

    def log_prior(self, x):
        """(n,), but for a constant."""
        return np.sum([prior.log_density(x[:, i]) for i, prior in enumerate(self.priors)], axis=0)

    def clocks(self, x):
        """(factor, offset), each (n, 1): the data's time is factor · model's time + offset."""
        factor, offset = np.ones(len(x)), np.zeros(len(x))
        for i, unknown in enumerate(self.unknowns[self.engine_count :], start=self.engine_count):
            value = unknown.prior.value(x[:, i])
            if unknown.scales:
                factor = factor * value
            elif unknown.time_offset:
                offset = offset + value
        return factor[:, None], offset[:, None]

    def predictions(self, batch, x):
        """(n, data) of n courses with coordinates (n, unknowns); nan where the model has no such number.

        Of a pit that was seen once: at the time at which the course is nearest to what was measured of it.
        """
        found = self.timed_predictions(batch, x)
        for path, _, indices, _ in self._paths(batch):
            found[:, indices] = nearest(path, self.values[indices], self.errors[indices]) if path else np.nan
        return found

    def timed_predictions(self, batch, x):
        """predictions(), but of data with times of their own alone; nan for those of pits."""
        found = np.full((len(x), len(self.data)), np.nan)
        for _, indices, column, time in self._requests(x):
            if column in EVENTS.values():
                factor, offset = self.clocks(x)
                found[:, indices] = factor * batch.end[:, None] + offset if batch.outcome == BUDDED else np.nan
            else:
                found[:, indices] = values_at(batch, column, time)
        return found

    def drawn(self, batch, x, generator):
        """predictions(), of pits at times that are drawn as their likelihood takes them."""
        found = self.predictions(batch, x)
        for path, _, indices, moments in self._paths(batch):
            if path:
                found[:, indices] = drawn(path, self.errors[indices], moments.even, generator)
        return found

    def log_likelihoods(self, batch, values, errors):
        """(n, pits): logarithms of the pits' likelihoods for values and errors (data,), but for a constant that depends on the errors; 0
        where the courses of a batch have no such quantity."""
        found = np.zeros((len(batch.end), len(self.pits)))
        for path, own, indices, moments in self._paths(batch):
            if path:
                found[:, own] = log_likelihoods(path, values[indices], errors[indices], moments.even)
        return found

    def pit_times(self, batch, errors, fractions):
        """(n, pits) in µs of the runs: a time of each pit below which a fraction (n, pits) of its likelihood lies, with errors (data,)."""
        found = np.full((len(batch.end), len(self.pits)), np.nan)
        for path, own, indices, moments in self._paths(batch):
            if path:
                found[:, own] = times(path, self.values[indices], errors[indices], moments.even, fractions[:, own])
        return found

    def _paths(self, batch):
        """(Path or None, numbers of the pits (p,), indices (p, k) of their data, Moments) for each group of pits."""
        for (names, moments), members in self._pit_groups.items():
            own, indices = zip(*members)
            yield path_of(batch, names, moments.start), np.array(own), np.array(indices), moments

    def known(self, batch):
        """Whether the courses of a batch, all of one outcome, have the quantity of each datum (data,)."""
        columns = {*batch.first, *batch.second, *(EVENTS.values() if batch.outcome == BUDDED else ())}
        return np.array([datum.column in columns for datum in self.data], dtype=bool)

    def covered(self, batch, x):
        """Whether each datum (n, data) lies within the course, where the model has such a number."""
        found = np.ones((len(x), len(self.data)), dtype=bool)
        for _, indices, column, time in self._requests(x):
            if column in EVENTS.values():
                found[:, indices] = batch.outcome == BUDDED
            else:
                found[:, indices] = within_course(batch, column, time)
        return found

    def _requests(self, x):
        """(name of the time, indices of the data, column, model's times (n, k)) for each group of data."""
        factor, offset = self.clocks(x)
        for (column, time_name), indices in self._groups.items():
            if time_name:
                at = self.names.index(time_name)
                time = np.repeat(self.priors[at].value(x[:, at])[:, None], len(indices), axis=1)
            else:
                time = np.array([[self.data[i].time for i in indices]])
            yield time_name, indices, column, np.broadcast_to((time - offset) / factor, (len(x), len(indices)))

    def residuals(self, batch, x):
        """(n, data): (prediction − value)/error, nan where there is no prediction."""
        scaled = (self.predictions(batch, x) - self.values) / self.errors
        return np.clip(scaled, -LARGEST_RESIDUAL, LARGEST_RESIDUAL)


def is_exact(unknown, parameters):
    """Whether an unknown acts on a finished course."""
    return not (unknown.key or unknown.scales) or is_exact_time_scale(unknown, parameters)
