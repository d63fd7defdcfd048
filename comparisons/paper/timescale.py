"""The time scale of the paper's figures: which reading of the print, put into the sharp model, gives it."""

from dataclasses import dataclass, field

import numpy as np

from comparisons import BOUNDARY_INTEGRAL
from comparisons.drawing.style import plt
from comparisons.paper.figures import COLOURS
from comparisons.paper.item import Printed, Result, Wanted, end_of, is_run, state_of, text, value_at
from comparisons.paper.printed import TIME
from comparisons.paper.table2 import PAPER_AREA

TITLE = "Time scale: readings of the print in the sharp model"

AREA = "membrane_area_nm2"

#: Times (µs) that the figure shows.
SHOWN = (0.003, 4.0)

#: γ of Sec. 4.3 in nm²/(pN µs) if the energy unit is 1 pN nm, and if it is that of the print's round numbers,
#: ρL⁵/T² = 0.1024 pN nm with L = 40 nm, T = 1 µs, ρ = 1000 kg/m³. A layer of 1.2 nm moves with 3ε/(2√2) γ times the force.
MOBILITIES = (4.2, 4.2 / 0.1024)
LAYER = 3 * 1.2 / (2 * np.sqrt(2))


@dataclass(frozen=True)
class Reading:
    """A reading of the print. settings: what it changes of the case; end: µs."""

    name: str
    what: str
    settings: dict = field(hash=False)
    end: float = 4.0
    case: str = "standard"


#: {key: text} of fluids and membranes that several readings name.
OUTSIDE, INSIDE = "fluid.viscosity_extracellular", "fluid.viscosity_intracellular"
BARE, COATED = "membrane.bending_stiffness", "membrane.bending_stiffness_coated"

READINGS = (
    Reading("as printed", "(4), (5), (32); ν₁ = 1, ν₂ = 10 mPa s", {}),
    Reading("(1), (2)", "curvature and stiffness of (1), (2), (A.26)", {"membrane.curvature_convention": "consistent"}),
    Reading("stiffness of (1)", "b for b/2, C = 2H₀", {BARE: "200", COATED: "2400"}),
    Reading("Table 1's b(c)", "(1 + 11c) b_c to the letter: twelve times as stiff", {BARE: "1200", COATED: "14400"}),
    Reading("viscosities exchanged", "φ = 1 inside, as in Fig. 2", {OUTSIDE: "1e-2", INSIDE: "1e-3"}),
    Reading("ν₂ on both sides", "ν = 10 mPa s", {OUTSIDE: "1e-2"}),
    Reading("ν₁ on both sides", "ν = 1 mPa s", {INSIDE: "1e-3"}),
    Reading("no tension", "ξ = ∞: the membrane stretches freely", {"membrane.inextensible": "false"}),
    *(
        Reading(f"r_c = {r} nm", "Table 2 does not say which patch", {"molecules.patch_radius": str(r)})
        for r in (24, 28, 32)
    ),
    *(
        Reading(
            f"no flow, γ = {mobility:.3g}",
            "Sec. 4.3",
            {"fluid.normal_mobility": f"{LAYER * mobility:.6g}"},
            20.0,
            "geometric",
        )
        for mobility in MOBILITIES
    ),
)


def wanted(quick):
    """One run of the sharp engine for each reading; they are cheap."""
    return [Wanted(r.name, BOUNDARY_INTEGRAL, r.case, r.settings, r.end) for r in READINGS]


def time_of_area(run, area):
    """First time (µs) at which the membrane has that area (nm²); None if it never has."""
    time, values = run.history["time_us"], run.history[AREA]
    above = np.nonzero(values >= area)[0]
    if not above.size:
        return None
    i = int(above[0])
    return float(time[0]) if i == 0 else float(np.interp(area, values[i - 1 : i + 1], time[i - 1 : i + 1]))


def rows_of(runs):
    """One row for each reading."""
    rows = []
    for reading in READINGS:
        run = next(iter(runs[reading.name].values()), None)
        row = {"reading": reading.name, "meaning": reading.what}
        columns = ("area_at_0.5_us_nm2", "time_of_paper_area_us", "slowdown", "budding_time_us", "end_us", "state")
        row |= dict.fromkeys(columns) | {"state": state_of(run)}
        rows.append(row)
        if not is_run(run):
            continue
        reached = time_of_area(run, PAPER_AREA)
        row |= {
            "area_at_0.5_us_nm2": value_at(run, AREA, TIME),
            "time_of_paper_area_us": reached,
            "slowdown": None if not reached else TIME / reached,
            "budding_time_us": run.event_time("budding"),
            "end_us": end_of(run),
        }
    return rows


def result(runs, quick):
    """See item.Result."""
    rows = rows_of(runs)
    printed = [
        Printed(
            f"{row['reading']} ({row['meaning']}): area at {TIME:g} µs; {PAPER_AREA:g} nm² reached at; neck of 5 nm at",
            f"≈ {PAPER_AREA:g} nm²; {TIME:g} µs; –",
            {"": "; ".join(in_words(row))},
        )
        for row in rows
    ]
    remarks = [
        "Stokes flow has one time scale, viscosity times length³ over stiffness, so a reading that scales both viscosities or all stiffness "
        "scales all times alike; “slowdown” is the factor by which the paper is slower than the reading at its area of Table 2.",
        "Two numbers of the print tie the clock down: the area at 0.5 µs, and γ = 4.2 nm³/µs, which “approximately synchronizes” "
        "the evolutions without and with flow. Its figures have both at 2.90, 7.46, 14.02 and 16.98 µs.",
    ]
    return Result(rows, {"timescale": ("Membrane area by reading", draw(runs))}, printed, remarks)


def in_words(row):
    """Area, its time and the budding time of a row."""
    found = (("area_at_0.5_us_nm2", 5, "nm²"), ("time_of_paper_area_us", 3, "µs"), ("budding_time_us", 4, "µs"))
    return [text(row[column], digits, unit) for column, digits, unit in found]


def draw(runs):
    """Area against time for every reading with flow; the paper's point."""
    figure, axes = plt.subplots(figsize=(7.6, 4.4), layout="constrained")
    for place, reading in enumerate(r for r in READINGS if r.case == "standard"):
        run = next(iter(runs[reading.name].values()), None)
        if not is_run(run) or run.history["time_us"][-1] < SHOWN[0]:
            continue
        look = {"color": COLOURS[place % len(COLOURS)], "linestyle": ("-", "--", ":")[place // len(COLOURS)]}
        axes.plot(run.history["time_us"], 1e-3 * run.history[AREA], label=reading.name, **look)
    axes.plot(TIME, 1e-3 * PAPER_AREA, "*", color="#333333", markersize=13, label="paper", zorder=5)
    axes.set(xscale="log", xlim=SHOWN, ylim=(20, 27), xlabel="time (µs)", ylabel="membrane area (10³ nm²)")
    axes.legend(fontsize=8, ncols=2)
    return figure
