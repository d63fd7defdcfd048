"""What inertia does: (32) with and without its first term, to 0.5 µs."""

from comparisons import BOUNDARY_INTEGRAL, PHASE_FIELD
from comparisons.paper.figures import history_figure
from comparisons.paper.item import Printed, Result, Wanted, text, value_at
from comparisons.paper.printed import QUICK_TIME, TIME

TITLE = "Inertia: Navier–Stokes and Stokes to 0.5 µs"

#: Runs of the diffuse engine's own scheme.
FLUIDS = {"Navier–Stokes": {"fluid.inertia": "true"}, "Stokes": {}}

#: Times (µs) at which they are compared; ρR²/ν₁, in which momentum crosses the box, is 0.006 µs.
TIMES = (0.0005, 0.002, 0.01, 0.02, 0.1, 0.5)

COLUMNS = ("volume_extracellular_nm3", "membrane_area_nm2", "bud_height_nm")


def wanted(quick):
    """Both fluids, and the sharp engine's Stokes flow."""
    end = QUICK_TIME if quick else TIME
    diffuse = [Wanted(name, PHASE_FIELD, "standard", own, end) for name, own in FLUIDS.items()]
    return [*diffuse, Wanted("Stokes", BOUNDARY_INTEGRAL, "standard", {}, end)]


def rows_of(runs, end):
    """One row for each time, run and engine."""
    rows = []
    for name, engines in runs.items():
        for engine, run in engines.items():
            for time in (t for t in TIMES if t <= end):
                row = {"fluid": name, "engine": engine, "time_us": time}
                rows.append(row | {c: value_at(run, c, time) for c in COLUMNS})
    return rows


def relative(rows, time, column):
    """Difference (%) that inertia makes in the diffuse engine."""
    of = {row["fluid"]: row[column] for row in rows if row["engine"] == PHASE_FIELD and row["time_us"] == time}
    with_inertia, without = of.get("Navier–Stokes"), of.get("Stokes")
    return 100 * (with_inertia / without - 1) if with_inertia is not None and without else None


def result(runs, quick):
    """See item.Result."""
    end = QUICK_TIME if quick else TIME
    rows = rows_of(runs, end)
    printed = [
        Printed(
            f"volume gained; height at {time:g} µs: with inertia against without",
            "–",
            {
                PHASE_FIELD: f"{text(relative(rows, time, COLUMNS[0]), 3, '%')}; {text(relative(rows, time, COLUMNS[2]), 3, '%')}"
            },
        )
        for time in TIMES
        if time <= end
    ]
    remarks = [
        "The paper solves (32) with inertia and says that Stokes' equations could be solved instead where inertial forces are small. "
        "Momentum crosses the box in ρR²/ν₁ ≈ 6 ns: until then inertia delays the flux of volume, later it does not matter.",
    ]
    names = {(name, engine): f"{name}, {engine}" for name, engines in runs.items() for engine in engines}
    figures = {"inertia": ("Volume gained, area and height", history_figure(runs, names, COLUMNS))}
    return Result(rows, figures, printed, remarks)
