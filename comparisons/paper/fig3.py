"""Fig. 3: molecules that keep together (Cahn–Hilliard) and molecules that diffuse (Fick)."""

from comparisons.paper.figures import history_figure, history_names, snapshots
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
    value_at,
)
from comparisons.studies.sweep_table import engines_of

TITLE = "Fig. 3: Cahn–Hilliard and Fickian transport"
TRANSPORTS = {"standard": "Cahn–Hilliard", "fickian": "Fickian"}

#: End (µs) of the Cahn–Hilliard run, and of the Fickian run as the paper says.
ENDS = {"standard": 20.0, "fickian": 36.0}

#: Times (µs) of the panels: the paper does not print those of Fig. 3; before, at and after our budding, then as Fig. 4.
TIMES = (0.2, 0.5, 0.8, 2.9, 16.98)


def wanted(quick):
    """Both transport laws in both engines."""
    return [run for case in TRANSPORTS for run in both_engines(case, case, {}, ENDS[case], quick)]


def rows_of(runs):
    """One row for each run."""
    rows = []
    for name in TRANSPORTS:
        for engine, run in runs[name].items():
            row = {"transport": name, "engine": engine, "state": state_of(run)}
            rows.append(row)
            if not is_run(run):
                continue
            necks = run.history["neck_radius_nm"]
            smallest = float(min((n for n in necks if n == n), default=float("nan")))
            row |= {
                "end_us": end_of(run),
                "budding_time_us": run.event_time("budding"),
                "smallest_neck_radius_nm": smallest if smallest == smallest else None,
                "neck_radius_at_0.5_us_nm": value_at(run, "neck_radius_nm", 0.5),
                "height_at_0.5_us_nm": value_at(run, "bud_height_nm", 0.5),
                "final_neck_radius_nm": final_value(run, "neck_radius_nm"),
                "final_height_nm": final_value(run, "bud_height_nm"),
                "final_largest_c": float(run.shapes[-1].c.max()),
            }
    return filled(rows)


def result(runs, quick):
    """See item.Result."""
    rows = rows_of(runs)
    of = {(row["transport"], row["engine"]): row for row in rows}
    engines = engines_of(rows)

    def beside(column, digits=4):
        return {e: " / ".join(text(of[t, e][column], digits) for t in TRANSPORTS) for e in engines}

    printed = [
        Printed(
            "dynamics: budding time, µs (Cahn–Hilliard / Fickian)",
            "faster with Cahn–Hilliard",
            beside("budding_time_us"),
        ),
        Printed("smallest neck radius, nm", "smaller with Cahn–Hilliard", beside("smallest_neck_radius_nm", 3)),
        Printed("neck radius at 0.5 µs, nm", "–", beside("neck_radius_at_0.5_us_nm")),
        Printed("end of the run, µs", "– / 36.0", beside("end_us")),
        Printed("neck radius at the end, nm", "stationary neck / still evolving", beside("final_neck_radius_nm", 3)),
        Printed("height at the end, nm", "vesicle / flat in the end", beside("final_height_nm")),
        Printed("largest c at the end", "1 / falling", beside("final_largest_c", 3)),
    ]
    remarks = [
        "The paper's neck stays open; the sharp membrane's closes (see Fig. 6): its neck is 5 nm wide at the budding "
        "time and goes on shrinking. So after that time the shapes agree in the bud and differ in the neck.",
        "The paper does not print the times of its panels; ours are before, at and after budding, and two of Fig. 4.",
        *quick_remark(quick),
    ]
    names = history_names(TRANSPORTS, engines)
    figures = {
        "fig3": ("Membranes coloured by c; dashed over the layer: the sharp membrane", snapshots(runs, TIMES, TRANSPORTS)),
        "fig3_histories": ("Neck radius and height", history_figure(runs, names)),
    }
    return Result(rows, figures, printed, remarks)
