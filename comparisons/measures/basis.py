"""What a run's numbers rest on, in words: convention, resolution, and whether its balances held."""


def basis(run):
    """[(what, value)] of an endoflow.Run: curvature convention, resolution reached, alarms."""
    return [
        ("curvature convention", run.parameters["membrane"].get("curvature_convention", "–")),
        ("resolution", resolution(run)),
        ("alarms", alarms_in_words(run)),
    ]


def resolution(run):
    """What the engine resolved, in words."""
    notes, parameters = run.record.get("notes", {}), run.parameters
    if run.engine == "phase-field":
        cells = parameters["phase_field"].get("cell_size") or notes.get("cell_size_nm")
        layer = f"layer of ε = {parameters['phase_field']['epsilon']:g} nm"
        return layer + (f" on cells of {cells:.4g} nm" if cells else "")
    elements = f"{notes.get('elements') or parameters['boundary_integral']['elements']:g} elements"
    tolerance = parameters["time"].get("tolerance")
    return elements + (f", time tolerance {tolerance:g}" if tolerance and run.engine != "statics" else "")


def alarms_in_words(run):
    """The names of the alarms, "none", or that the run did not look."""
    if "alarms" not in run.record:
        return "not recorded by the version that made the run"
    return ", ".join(alarm.name for alarm in run.alarms) or "none"
