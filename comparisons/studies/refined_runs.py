"""The more accurate runs that certify one: settings of the same case with space, time and the layer refined."""

import math

#: By how much elements or cells of a run that names their number or size are refined.
ELEMENTS_RATIO, CELL_RATIO = 1.5, 1 / math.sqrt(2)
#: By how much the tolerance gets stricter.
STRICTER = 0.1
#: ε of the second layer.
THICKNESS_RATIO = 1 / math.sqrt(2)
#: Steps of scheme `paper`, which has no error control.
STEP_RATIO = 0.5


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
