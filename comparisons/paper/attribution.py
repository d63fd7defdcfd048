"""From the paper's area at 0.5 µs to the sharp membrane's, one change of the numerics at a time."""

from dataclasses import dataclass, field

from comparisons import BOUNDARY_INTEGRAL, PHASE_FIELD
from comparisons.drawing.style import plt
from comparisons.paper.item import Printed, Result, Wanted, is_run, state_of, text, value_at
from comparisons.paper.printed import QUICK_TIME, TIME, quick_sentence, settings
from comparisons.paper.table2 import PAPER_AREA

TITLE = "Attribution: from the printed numerics to the sharp membrane"

#: Where the ladder ends, and the column it is about.
SHARP, AREA = "sharp", "membrane_area_nm2"


@dataclass(frozen=True)
class Rung:
    """One change of the numerics. settings: what it changes in addition to those of the rungs before it."""

    name: str
    what: str
    settings: dict = field(hash=False)


#: Changes of cases/printed.toml, in this order; each keeps those before it. Steps and time level come first, and γ
#: before the profile: otherwise most do not get to the end.
RUNGS = (
    Rung("printed", "as printed", {}),
    Rung(
        "steps",
        "steps held back by the membrane's motion",
        {"phase_field.paper.step_rule": "guarded", "phase_field.paper.ramp_steps": "10"},
    ),
    Rung(
        "level",
        "forces at the new time, advection centred",
        {"phase_field.paper.force_centering": "1", "phase_field.paper.advection_centering": "0.5"},
    ),
    Rung("unknown", "β f as the unknown, not f", {"phase_field.paper.bending_unknown": "moment"}),
    Rung(
        "degree",
        "cubic elements on cells of 1.25 nm instead of quadratic ones of 0.88",
        {
            "phase_field.degree": "3",
            "phase_field.velocity_degree": "3",
            "phase_field.surface_degree": "3",
            "phase_field.cell_size": "1.25",
        },
    ),
    Rung("xi", "ξ a thousandth", {"phase_field.paper.tension_extension": "0.390625"}),
    Rung("zeta", "ζ = 0.05/τ instead of 1/τ", {"phase_field.paper.stretching_relaxation": "0.05"}),
    Rung("mobility", "γ = 0.0064 nm²/(pN µs)", {"phase_field.paper.mobility": "0.0064"}),
    Rung("profile", "the profile is restored along the normal", {"phase_field.paper.profile_mobility": "600"}),
    Rung("inertia", "Stokes flow", {"fluid.inertia": "false"}),
)

#: Then the diffuse engine's own scheme, with the layer of the paper, and the sharp engine.
PRODUCTION = Rung("production", "scheme production: nothing leaks, all implicit, ε = 1.2 nm", {})
LIMIT = Rung(SHARP, "ε → 0: the sharp engine", {})


def wanted(quick):
    """The ladder's runs."""
    end = QUICK_TIME if quick else TIME
    runs, changes = [], {}
    for rung in RUNGS:
        changes |= rung.settings
        own = settings({}, quick) | changes
        if quick and "phase_field.cell_size" in changes:
            own["phase_field.cell_size"] = "2.5"
        runs.append(Wanted(rung.name, PHASE_FIELD, "printed", own, end))
    runs.append(Wanted(PRODUCTION.name, PHASE_FIELD, "standard", {}, end))
    return [*runs, Wanted(SHARP, BOUNDARY_INTEGRAL, "standard", {}, end)]


def rows_of(runs, end):
    """One row for each rung; change: from the last rung before it that has an area."""
    rows, before = [], None
    for rung in (*RUNGS, PRODUCTION, LIMIT):
        found = next(iter(runs[rung.name].values()), None)
        area = value_at(found, AREA, end)
        row = {"rung": rung.name, "change": rung.what, "time_us": end, "area_nm2": area}
        row["change_nm2"] = None if None in (area, before) else area - before
        row["state"] = ("ended before: " if area is None and is_run(found) else "") + state_of(found)
        rows.append(row)
        before = before if area is None else area
    return rows


def result(runs, quick):
    """See item.Result."""
    end = QUICK_TIME if quick else TIME
    rows = rows_of(runs, end)
    printed = [
        Printed(row["change"], f"≈ {PAPER_AREA:g}" if row["rung"] == "printed" else "–", {"": in_words(row)})
        for row in rows
    ]
    remarks = [
        "Each rung keeps the changes of those before it, so what a change does may depend on the order. A rung whose run did not get to "
        "the end is left out, and its change is part of the next one's.",
        *closure(rows),
        *quick_sentence(quick),
    ]
    return Result(rows, {"attribution": (f"Membrane area at {end:g} µs", draw(rows))}, printed, remarks)


def in_words(row):
    """Area and change of a rung."""
    if row["area_nm2"] is None:
        return row["state"]
    change = "" if row["change_nm2"] is None else f" ({row['change_nm2']:+.0f})"
    return f"{text(row['area_nm2'], 6)} nm²{change}"


def closure(rows):
    """The sum of the changes beside the difference they explain."""
    known = [row["area_nm2"] for row in rows if row["area_nm2"] is not None]
    if len(known) < 2 or rows[0]["area_nm2"] is None or rows[-1]["area_nm2"] is None:
        return ["The ladder does not close: its first or its last rung has not been run."]
    total = sum(row["change_nm2"] for row in rows if row["change_nm2"] is not None)
    return [
        f"The changes add up to {total:+.1f} nm², the difference between the sharp and the printed area is {known[-1] - known[0]:+.1f}."
    ]


def draw(rows):
    """The waterfall: a bar from one rung's area to the next one's."""
    figure, axes = plt.subplots(figsize=(9.2, 0.42 * len(rows) + 1.2), layout="constrained")
    before = None
    for place, row in enumerate(rows):
        area = row["area_nm2"]
        if area is None:
            label = axes.get_yaxis_transform()
            short = ":".join(row["state"].split(":")[:2])
            axes.text(0.02, place, short, transform=label, va="center", color="#777777")
            continue
        if before is None:
            axes.plot(area, place, "o", color="#333333")
        else:
            axes.barh(place, area - before, left=before, height=0.6, color="#D55E00" if area < before else "#0072B2")
            axes.plot([before, before], [place - 1, place + 0.3], color="#888888", linewidth=0.8)
        axes.annotate(in_words(row), (area, place), xytext=(6, 0), textcoords="offset points", va="center")
        before = area
    axes.axvline(PAPER_AREA, color="#333333", linestyle=":")
    axes.set_yticks(range(len(rows)), [row["change"] for row in rows])
    axes.invert_yaxis()
    axes.use_sticky_edges = False  # bars would hold the limits where they end
    axes.margins(x=0.3)
    axes.set_xlabel(f"membrane area at {rows[0]['time_us']:g} µs (nm²); dotted: the paper's average")
    return figure
