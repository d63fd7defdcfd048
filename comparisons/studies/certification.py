"""A run's numbers with the error that more accurate runs of the same case show: value ± error.

Settings of the runs with space, time and the layer refined, then the error from their differences.
"""

import math

from comparisons.measures.quantities import BUDDING, columns
from comparisons.studies.members import NECK_CLOSED

CERTIFIED = columns("certified")

#: By how much elements or cells of a run that names their number or size are refined.
ELEMENTS_RATIO, CELL_RATIO = 1.5, 1 / math.sqrt(2)

#: By how much the tolerance gets stricter.
STRICTER = 0.1

#: ε of the second layer.
THICKNESS_RATIO = 1 / math.sqrt(2)

#: Steps of scheme `paper`, which has no error control.
STEP_RATIO = 0.5

#: Errors that refinement shows are multiplied by this. Space and time refined cut an error to a third or less (a tenth
#: of the tolerance to a quarter, half as many elements again to a tenth): what they show is two thirds of it or more.
SAFETY = 1.5

#: A layer's results go with ε² (the orders measured lie between 1.4 and 1.9).
ORDER_IN_EPSILON = 2


def finer_settings(engine, parameters, notes):
    """("section.key=value", …): the same case with space and time refined.

    parameters: by section, as resolved; notes: those of the finished run's run.json.
    """
    refined = _finer_sharp(parameters, notes) if engine == "boundary-integral" else _finer_diffuse(parameters, notes)
    return (*(f"{key}={value:.12g}" for key, value in refined.items()), *_no_output(parameters))


def denser_settings(parameters, notes):
    """The same case of the sharp engine with space alone refined, as finer_settings() refines it."""
    refined = _finer_sharp(parameters, notes)
    refined["time.tolerance"] /= STRICTER
    return (*(f"{key}={value:.12g}" for key, value in refined.items()), *_no_output(parameters))


def thinner_settings(parameters):
    """The same case of the diffuse engine with a thinner layer; cells whose size the case leaves open follow it."""
    own = parameters["phase_field"]
    refined = {"phase_field.epsilon": own["epsilon"] * THICKNESS_RATIO}
    if own["cell_size"]:
        refined["phase_field.cell_size"] = own["cell_size"] * THICKNESS_RATIO
    return (*(f"{key}={value:.12g}" for key, value in refined.items()), *_no_output(parameters))


def _finer_sharp(parameters, notes):
    """From what a run chose, when it chose: as many elements as it ended with, and half of that, from the start."""
    elements = notes.get("elements") or parameters["boundary_integral"]["elements"]
    tolerance = notes.get("time_tolerance") or parameters["time"]["tolerance"]
    return {
        "boundary_integral.elements": math.ceil(ELEMENTS_RATIO * elements),
        "time.tolerance": STRICTER * tolerance,
    }


def _finer_diffuse(parameters, notes):
    own = parameters["phase_field"]
    cell = own["cell_size"] or notes["cell_size_nm"]
    chosen = notes.get("constants", {}).get("default_tolerance", 0)  # scheme `paper` has no error control
    tolerance = STRICTER * (parameters["time"]["tolerance"] or chosen)
    refined = {"phase_field.cell_size": CELL_RATIO * cell, "time.tolerance": tolerance}
    if own["scheme"] == "paper":
        for key in ("max_step", "max_motion"):
            refined[f"phase_field.paper.{key}"] = STEP_RATIO * own["paper"][key]
    return refined


def _no_output(parameters):
    return (f"output.shape_interval={parameters['time']['end']:.12g}", "output.field_interval=0")


def values(run, time):
    """{quantity: value or None} of an endoflow.Run at a time (µs); None for the run's own end."""
    last = {name: float(column[-1]) for name, column in run.history.items()}
    at = last if time is None else {name: float(run.history_at(name, time)) for name in run.history}
    found = {BUDDING: run.event_time("budding")}
    for name in (name for name in CERTIFIED if name in at):
        found[name] = None if math.isnan(at[name]) else at[name]
    if time is None:
        found["neck_radius_nm"] = None  # the neck's radius is what ended the run
    return found


def common_time(runs):
    """Where runs of one case are compared, µs; None when events ended all of them: each at its own end."""
    if all(run.record["exit_reason"] in ("budded", NECK_CLOSED) for run in runs):
        return None
    return min(float(run.history["time_us"][-1]) for run in runs)


def sharp_parts(run, denser, finer):
    """What a sharp run's error is made of, for certificate(): more elements first, then shorter steps as well.

    Errors of space and time may have opposite signs: a run that is right because of it would seem to have none.
    """
    return {"space": (run, denser, 1.0), "time": (denser, finer, 1.0)}


def layer_parts(run, finer, thinner, thickness_ratio):
    """The same of a diffuse run; thinner: with ε times thickness_ratio."""
    to_the_limit = 1.0 / (1.0 - thickness_ratio**ORDER_IN_EPSILON)
    return {"space and time": (run, finer, 1.0), "layer": (run, thinner, to_the_limit)}


def certificate(run, parts):
    """What run.json keeps under `certificate`.

    parts: {name: (Run, refined Run, how many times their difference)}, each an error that is added with its size. A
    quantity that not all of the runs have gets no interval.
    """
    time = common_time([each for coarse, refined, _ in parts.values() for each in (coarse, refined)])
    pairs = {part: (values(coarse, time), values(refined, time), scale) for part, (coarse, refined, scale) in parts.items()}
    entries = {}
    for name, value in values(run, time).items():
        if value is None or any(None in (coarse[name], refined[name]) for coarse, refined, _ in pairs.values()):
            continue
        errors = {part: SAFETY * scale * abs(refined[name] - coarse[name]) for part, (coarse, refined, scale) in pairs.items()}
        unit, title = CERTIFIED[name].unit, CERTIFIED[name].title.lower().removesuffix(" time")
        entry = {"title": title, "value": value, "error": sum(errors.values()), "unit": unit, "parts": errors}
        entries[name] = {**entry, "in_words": in_words(entry)}
    return {"time_us": time, "safety": SAFETY, "values": entries}


def in_words(entry):
    """"0.82589 ± 0.00004 µs" of an entry of a certificate's values: the error has one digit, the value as many."""
    error = entry["error"]
    if error <= 0.0:
        return f"{entry['value']:.8g} ± 0 {entry['unit']}"
    decimals = max(0, -math.floor(math.log10(error)))
    return f"{entry['value']:.{decimals}f} ± {error:.{decimals}f} {entry['unit']}"
