"""Fig. 4: the membrane with the fluids and without them (geometric evolution)."""

from dataclasses import replace

import numpy as np

from comparisons.drawing import style
from comparisons.paper.figures import history_figure, history_names, membrane_in_fluid, moving_membrane, snapshots
from comparisons.paper.item import (
    Printed,
    Result,
    both_engines,
    end_of,
    filled,
    final_value,
    is_run,
    quick_remark,
    state_of,
    text,
)
from comparisons.studies.members import NECK_CLOSED
from comparisons.studies.sweep_table import engines_of

TITLE = "Fig. 4: without flow and with flow"
DYNAMICS = {"geometric": "without flow", "standard": "with flow"}
END = 20.0

#: Early times (µs): ours bud before the paper's first panel.
EARLY_TIMES = (0.05, 0.2, 0.5, 0.8)


#: `--quick`: without flow there is nothing fast to resolve, so the phase field goes to the end with long steps. The
#: membrane moves with (3ε/2√2) γ times the force per area, so the case's γ = 4.2 at ε = 1.2 nm is half of it at 2.4 nm.
QUICK_GEOMETRIC = {
    "phase_field.epsilon": "2.4",
    "phase_field.cell_size": "2.5",
    "phase_field.paper.max_step": "0.05",
    "phase_field.paper.mobility": "2.1",
}


#: In full the layer is the paper's; the steps are long for the same reason.
GEOMETRIC = {"phase_field.paper.max_step": "0.02"}


def wanted(quick):
    """Both dynamics in both engines."""
    sharp, diffuse = both_engines("geometric", "geometric", {}, END, quick, END, QUICK_GEOMETRIC)
    geometric = [sharp, diffuse if quick else replace(diffuse, settings=GEOMETRIC)]
    return geometric + both_engines("standard", "standard", {}, END, quick)


def lowest_apex(run):
    """Most negative height (nm) of any membrane point below the rim over the run's shapes; 0 when none sinks."""
    return float(min((shape.z - shape.z[-1]).min() for shape in run.shapes))


def pinch_off_time(run):
    """Time (µs) at which the neck has closed: the run ended there, or went on with what is left without a neck; or None."""
    budding = run.event_time("budding")
    if budding is None:
        return None
    time, neck = run.history["time_us"], run.history["neck_radius_nm"]
    without = (time > budding) & np.isnan(neck)
    if without.any():
        return float(time[without][0])
    return end_of(run) if run.record["exit_reason"] == NECK_CLOSED else None


def row(name, engine, run):
    """One row of the table."""
    head = {"dynamics": name, "engine": engine, "state": state_of(run)}
    if not is_run(run):
        return head
    return head | {
        "end_us": end_of(run),
        "budding_time_us": run.event_time("budding"),
        "pinch_off_time_us": pinch_off_time(run),
        "lowest_point_below_rim_nm": lowest_apex(run),
        "final_neck_radius_nm": final_value(run, "neck_radius_nm"),
        "final_height_nm": final_value(run, "bud_height_nm"),
        "final_area_nm2": final_value(run, "membrane_area_nm2"),
    }


def pinch_off_words(row):
    """When a run pinched off, or up to when it did not."""
    if row["end_us"] is None:
        return row["state"]
    time = row["pinch_off_time_us"]
    return text(time) if time is not None else f"none up to {text(row['end_us'])}"


def result(runs, quick):
    """See item.Result."""
    rows = filled([row(name, engine, run) for name in DYNAMICS for engine, run in runs[name].items()])
    engines = engines_of(rows)

    def of(name, column, digits=4):
        found = {one["engine"]: one.get(column) for one in rows if one["dynamics"] == name}
        return {engine: text(found[engine], digits) for engine in engines}

    def pinch_off(name):
        found = {one["engine"]: one for one in rows if one["dynamics"] == name}
        return {engine: pinch_off_words(found[engine]) for engine in engines}

    printed = [
        Printed("pinch-off without flow, µs", "after 14.02, before 16.98", pinch_off("geometric")),
        Printed("neck radius 5 nm without flow, µs", "–", of("geometric", "budding_time_us")),
        Printed("pinch-off with flow, µs", "none: stationary neck", pinch_off("standard")),
        Printed("neck radius 5 nm with flow, µs", "–", of("standard", "budding_time_us")),
        Printed(
            "lowest point below the rim without flow, nm",
            "moves down early",
            of("geometric", "lowest_point_below_rim_nm", 3),
        ),
        Printed(
            "lowest point below the rim with flow, nm",
            "largely suppressed",
            of("standard", "lowest_point_below_rim_nm", 3),
        ),
    ]
    remarks = [
        "The paper chose the mobility γ of the evolution without flow “so as to approximately synchronize” it with its "
        "flow; its value, 4.2 nm³/µs, lacks a unit of energy and is read as 4.2 nm²/(pN µs) here. A diffuse membrane then moves "
        "with (3ε/2√2) γ times the force per area, so the time of pinching off goes with 1/(γε); with --quick γε is kept, and the sharp membrane has that mobility too.",
        "Without flow a diffuse membrane may end earlier than a sharp one, since it cannot resolve a neck thinner than its layer.",
        "With flow, the sharp membrane's neck reaches 5 nm before the paper's first panel at 2.90 µs and keeps "
        "draining slowly; the paper's stops. A diffuse layer cannot show a neck much narrower than a few of its own "
        "thickness, which is 1.2 nm.",
        f"Arrows are logarithmic as in the paper, from {style.SLOWEST_ARROW:g} nm/µs upwards, each panel with its own longest one; "
        "without flow they show the membrane's velocity, which the phase field does not record.",
        *quick_remark(quick),
        *(["Quick: without flow the phase field's layer has 2.4 nm, twice the paper's."] if quick else []),
    ]
    names = history_names(DYNAMICS, engines)
    figures = {
        "fig4": ("At the paper's times", snapshots(runs, style.PAPER_TIMES, DYNAMICS, membrane_in_fluid)),
        "fig4_early": ("While the bud forms", snapshots(runs, EARLY_TIMES, DYNAMICS, moving_membrane)),
        "fig4_histories": ("Neck radius, diameter and height", history_figure(runs, names)),
    }
    return Result(rows, figures, printed, remarks)
