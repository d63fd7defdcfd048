"""Mund et al. (2023): closing angle of a coat against its area and curvature, on three ways from flat to closed."""

import numpy as np

from comparisons.drawing.style import BUDDING_NECK_RADIUS, plt
from comparisons.errors import StudyError
from comparisons.measures.coat import COAT, coat_of
from comparisons.paper.figures import COLOURS
from comparisons.paper.item import BOUNDARY_INTEGRAL, Printed, Result, Wanted, is_run, state_of, text

TITLE = "How a coat gets its curvature: three ways from flat to closed (Mund et al. 2023)"
SOURCE = "M. Mund, A. Tschanz, Y.-L. Wu, F. Frey et al., J. Cell Biol. 222, e202206038 (2023)"

#: Their cooperative curvature model, dH/dθ = γ (1 − H²/H₀²), H(θ) = H₀ tanh(γθ/H₀), of a coat that is a spherical cap.
#: Flat coats grow to half of the final area before they bend (their abstract): (H₀/γ)² tanh²(πγ/H₀)/4 = 1/2.
FLAT_PART = 0.5

#: Radii (nm) of the coats at the start: the final area of π 26² nm², and half of it. Speed (nm/µs) of the edge and rate (1/µs) of
#: maturation: slow for a membrane that follows within microseconds.
WHOLE, HALF, SPEED, RATE = "26", "18.4", "0.12", "0.03"

GROWTH = {"molecules.exchange": "edge", "molecules.edge_speed": SPEED}
MATURATION = {"molecules.maturation": "cooperative", "molecules.maturation_rate": RATE}
OUTPUT = {"output.field_interval": "0", "output.shape_interval": "1", "output.stop_at_budding": "true"}

#: {name: settings} of the ways, and with --quick what is added to them.
WAYS = {
    "constant curvature": {"molecules.patch_radius": HALF, **GROWTH},
    "constant area": {"molecules.patch_radius": WHOLE, **MATURATION},
    "growth and maturation": {"molecules.patch_radius": HALF, **GROWTH, **MATURATION},
}
QUICK = {"boundary_integral.accuracy": "1e-2"}
END = 300.0

#: Time (µs) that the flat membrane of the start takes to have the shape of its coat.
SETTLED = 5.0

#: Closing angles (degrees) at which the page compares.
SHOWN = (45, 90, 135)


def wanted(quick):
    """A run of the sharp engine for each way."""
    settings = {**OUTPUT, **(QUICK if quick else {})}
    return [Wanted(name, BOUNDARY_INTEGRAL, "standard", {**own, **settings}, END) for name, own in WAYS.items()]


def cooperativity():
    """γ/H₀ of the published fit, from the part of the area that is flat: a bisection, the part falls with γ/H₀."""
    low, high = 0.5, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (np.tanh(np.pi * middle) / (2 * middle)) ** 2 > FLAT_PART else (low, middle)
    return 0.5 * (low + high)


def fitted(angle):
    """(area, curvature) over their values at θ = 180° of the published fit; angle: array, degrees, > 0."""
    gamma, theta = cooperativity(), np.radians(angle)
    curvature = np.tanh(gamma * theta) / np.tanh(gamma * np.pi)
    return (1 - np.cos(theta)) / (2 * curvature**2), curvature


def rows_of(name, run):
    """A row for each shape of a run that has settled and has a coat's edge."""
    found = ((shape.time, coat_of(shape)) for shape in run.shapes if shape.time >= SETTLED)
    return [{"way": name, "time_us": time, **coat} for time, coat in found if coat is not None]


def over_last(rows):
    """Arrays (angle in degrees, area and curvature over their last values) of a way's rows."""
    angle, area, curvature = (np.array([row[column] for row in rows]) for column in COAT)
    return angle, area / area[-1], curvature / curvature[-1]


def at_angle(angle, values, wanted_angle):
    """Where the angle first reaches one: a value, None where it begins above or ends below."""
    reached = np.maximum.accumulate(angle)
    if not reached[0] <= wanted_angle <= reached[-1]:
        return None
    return float(np.interp(wanted_angle, reached, values))


def draw(ways):
    """Area and curvature, over their last values, against the closing angle; dashed: the published fit."""
    figure, panels = plt.subplots(1, 2, figsize=(9.4, 3.9), layout="constrained")
    angle = np.linspace(1, 180, 180)
    for panel, of_fit in zip(panels, fitted(angle)):
        panel.plot(angle, of_fit, color="#333333", linestyle="--", label="published fit")
    for (name, rows), colour in zip(ways.items(), COLOURS):
        own, *relative = over_last(rows)
        for panel, values in zip(panels, relative):
            panel.plot(own, values, color=colour, label=name)
    panels[0].set(xlabel="closing angle (°)", ylabel="coat's area, of the last", ylim=(0, None))
    panels[1].set(xlabel="closing angle (°)", ylabel="coat's mean curvature, of the last", ylim=(0, None))
    panels[0].legend()
    return figure


def words_of(ways, which, angle):
    """What each way says at a closing angle; which: 1 area, 2 curvature."""
    said = []
    for name, rows in ways.items():
        values = over_last(rows)
        said.append(f"{name} {text(at_angle(values[0], values[which], angle), 2)}")
    return ", ".join(said)


def result(runs, quick):
    """See item.Result."""
    found = {name: engines.get(BOUNDARY_INTEGRAL) for name, engines in runs.items()}
    ways = {name: rows for name, run in found.items() if is_run(run) and (rows := rows_of(name, run))}
    if not ways:
        raise StudyError("no run has a coat with an edge", 3)
    printed = []
    for angle in SHOWN:
        for which, what in ((1, "area"), (2, "mean curvature")):
            paper = text(float(fitted(angle)[which - 1]), 2)
            printed.append(Printed(f"{what} at {angle}°, of the last", paper, {"": words_of(ways, which, angle)}))
    for name, rows in ways.items():
        last = rows[-1]
        words = f"{text(last['closing_angle_deg'], 3)}° at {text(last['coat_area_nm2'])} nm² after {text(last['time_us'], 3)} µs"
        printed.append(Printed(f"{name}: the last shape", "–", {"": f"{words}, {state_of(found[name])}"}))
    remarks = [
        f"The fit is dimensionless here: γ/H₀ = {cooperativity():.3f} follows from the {100 * FLAT_PART:g} % of the final area that is "
        "flat before the coat bends, and from a final coat that is a whole sphere.",
        f"Our last shape is that whose neck is {BUDDING_NECK_RADIUS:g} nm wide, at the standard case's curvature and stiffness: the "
        "membrane's neck is part of the closing, and the edge of the coat does not reach 180°.",
        "Constant curvature: χ = 1, the coat grows at its edge from half of the area on. Constant area: no growth, χ from 0 on. "
        "Growth and maturation: both from half of the area on. All are slow for the membrane, which has the shape that belongs to "
        f"area and curvature within microseconds; the first {SETTLED:g} µs, from the flat membrane, are left out.",
    ]
    return Result(
        [row for rows in ways.values() for row in rows], {"mund2023": (TITLE, draw(ways))}, printed, remarks
    )
