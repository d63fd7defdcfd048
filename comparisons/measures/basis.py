"""What a run's numbers rest on, in words: convention, resolution, and whether its balances held."""

from comparisons.measures.powers import with_powers
from endoflow.alarms import alarms_of

#: Most different entries that are named one by one where many runs are described together.
NAMED = 4


def basis(run):
    """[(what, value)] of an endoflow.Run: curvature convention, resolution reached, alarms."""
    return basis_of(run.record)


def basis_of(record):
    """The same of a run.json (dict)."""
    return [
        ("curvature convention", record["parameters"]["membrane"].get("curvature_convention", "–")),
        ("resolution", resolution(record)),
        ("alarms", alarms_in_words(record)),
    ]


def common_basis(records):
    """The same of many runs together, from their run.json (dicts); [] without any.

    Different conventions and resolutions are named side by side, alarms with the number of runs that raised them.
    """
    found = [dict(basis_of(record)) for record in records]
    if not found:
        return []
    conventions, resolutions = (side_by_side([one[what] for one in found]) for what in ("curvature convention", "resolution"))
    names = [one["alarms"] for one in found if one["alarms"] != "none"]
    counts = ", ".join(f"{name} ({names.count(name)} of {len(found)} runs)" for name in dict.fromkeys(names))
    return [("curvature convention", conventions), ("resolution", resolutions), ("alarms", counts or "none")]


def side_by_side(texts):
    """Different texts in the order of their appearance; of many the first and the last."""
    different = [*dict.fromkeys(texts)]
    if len(different) > NAMED:
        return f"{different[0]} … {different[-1]} ({len(different)} different ones)"
    return "; ".join(different)


def resolution(record):
    """What the engine resolved, in words."""
    notes, parameters = record.get("notes", {}), record["parameters"]
    if record["engine"] == "phase-field":
        cells = parameters["phase_field"].get("cell_size") or notes.get("cell_size_nm")
        layer = f"layer of ε = {parameters['phase_field']['epsilon']:g} nm"
        return layer + (f" on cells of {cells:.4g} nm" if cells else "")
    elements = f"{notes.get('elements') or parameters['boundary_integral']['elements']:g} elements"
    return elements if record["engine"] == "statics" else elements + _sharp_resolution(record)


def _sharp_resolution(record):
    """What follows the number of elements: those it began with, tolerance, accuracy asked for and reached."""
    notes, parameters = record.get("notes", {}), record["parameters"]
    counts = notes.get("elements_from", [])
    text = f" at the end, {counts[0]['elements']} at the start" if len(counts) > 1 else ""
    tolerance = notes.get("time_tolerance") or parameters["time"].get("tolerance")
    text += f", time tolerance {tolerance:g}" if tolerance else ""
    reached = record.get("accuracy", {}).get("resolution")
    if reached:
        asked = parameters["boundary_integral"]["accuracy"]
        text += f"; relative accuracy {asked:g} asked for, {with_powers(format(reached['largest'], '.1e'))} reached"
    return text


def alarms_in_words(record):
    """The names of the alarms, "none", or that the run did not look."""
    if "alarms" not in record:
        return "not recorded by the version that made the run"
    return ", ".join(alarm.name for alarm in alarms_of(record)) or "none"
