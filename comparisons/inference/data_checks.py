"""Whether the runs of a case can have what was measured: times within them, outlines within the box.

What cannot be is refused before the first run, with where it was read and the key that would mend it.
"""

import dataclasses

from comparisons.errors import BAD_INPUT, StudyError
from comparisons.inference.observations import EVENTS
from comparisons.inference.study_file import horizon

#: Rounding of a time that is meant to be the end of the runs, relative.
ROUNDING = 1e-6

#: What may mend a length.
UNIT = 'say length_unit = "Å" or whatever it is'

#: An outline that comes nearer to the wall than this part of the radius shows where the membrane is attached, at z = 0; from
#: there the membrane rises by less than STEEPEST times the distance, and the errors by less than this many deviations.
NEAR_WALL, STEEPEST, DEVIATIONS = 0.05, 3.0, 10.0


def checked(study, parameters, exact):
    """The StudyFile with outlines whose z is from the rim's level. parameters: resolved, of the case; exact: Unknowns that act
    on finished courses. Raises StudyError."""
    contours = tuple(_inside(study, outline, parameters["domain"]) for outline in study.contours)
    for datum in study.data:
        _require_size(study, datum, parameters["domain"])
    earliest, latest = times_of_data(exact, horizon(study, parameters))
    slack = ROUNDING * (latest - earliest)
    for place, key, time, remedy in _times(study.data, contours):
        where = f"{place}: {key} = {time:g} µs"
        if time < earliest - slack:
            remedy = "a shift between clocks is an unknown with time_offset = true"
            _refuse(study, f"{where} is before the start of the runs, {earliest:g} µs; {remedy}")
        if time > latest + slack:
            _refuse(study, f"{where} is after the end of the runs, {latest:g} µs; {remedy}")
    return dataclasses.replace(study, contours=contours)


def _times(data, contours):
    """(place, key, time in µs, what to do about one after the end) of every time that a study names."""
    later = "raise horizon in [study]"
    for datum in data:
        if datum.column in EVENTS.values():
            yield datum.place, "time_us", datum.value, later
        else:
            yield datum.place, "time_us", datum.time, f'{later}, or say time_unit = "ns" or whatever it is'
    for outline in contours:
        named = {"time_us": outline.time} if outline.time is not None else {"low_us": outline.low, "high_us": outline.high}
        for key, time in named.items():
            yield outline.places[0].rpartition(":")[0], key, time, later


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
