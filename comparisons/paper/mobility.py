"""Which γ the paper's Table 2 had: area at 0.5 µs and its sensitivity against γ, by the paper's printed numerics."""

import numpy as np
from scipy.interpolate import PchipInterpolator

from comparisons import PHASE_FIELD
from comparisons.drawing import style
from comparisons.drawing.style import plt
from comparisons.paper.item import Printed, Result, Wanted, text, value_at
from comparisons.paper.printed import MOBILITY_PER_PRINTED, QUICK_TIME, TIME, quick_sentence, settings
from comparisons.paper.table2 import PAPER, PAPER_AREA

TITLE = "Table 1's mobility: which reading of γ fits Table 2"

#: γ of the runs, nm²/(pN µs).
MOBILITIES = tuple(10.0**k for k in range(-6, 2))

#: What 6.4 nm³/s may mean (nm²/(pN µs)) if an energy unit is missing.
READINGS = {
    "unit 1 pN nm": 6.4e-6,
    "unit of the print's round numbers, ρL⁵/T² = 0.1024 pN nm": 6.25e-5,
    "nm³/µs in place of nm³/s, 1 pN nm": 6.4,
}


def name_of(mobility):
    """Name of a run."""
    return f"γ={mobility:g}"


def wanted(quick):
    """cases/printed.toml at every γ."""
    end = QUICK_TIME if quick else TIME
    return [
        Wanted(name_of(m), PHASE_FIELD, "printed", settings({"γ": m / MOBILITY_PER_PRINTED}, quick), end)
        for m in MOBILITIES
    ]


def column_of(area_of, mobility):
    """The print's column of γ, in %, about a γ that stands for its 6.4 nm³/s; area_of(log10 γ), nan outside."""
    entries = PAPER["γ"][1]
    area = [float(area_of(np.log10(mobility * value / 6.4))) for value, _ in entries]
    return [100 * abs(one / area[-1] - 1) for one in area[:-1]]


def result(runs, quick):
    """See item.Result."""
    end = QUICK_TIME if quick else TIME
    rows = []
    for mobility in MOBILITIES:
        run = runs[name_of(mobility)].get(PHASE_FIELD)
        area = value_at(run, "membrane_area_nm2", end)
        rows.append({"mobility_nm2_per_pN_us": mobility, "time_us": end, "area_nm2": area})
    known = [(np.log10(row["mobility_nm2_per_pN_us"]), row["area_nm2"]) for row in rows if row["area_nm2"] is not None]
    area_of = PchipInterpolator(*zip(*known), extrapolate=False) if len(known) > 1 else lambda _: np.nan
    for row in rows:
        column = column_of(area_of, row["mobility_nm2_per_pN_us"])
        row |= {
            f"change_at_{value:g}_percent": change if np.isfinite(change) else None
            for (value, _), change in zip(PAPER["γ"][1], column)
        }
    wanted_column = [change for _, change in PAPER["γ"][1] if change is not None]
    printed = [
        Printed(
            f"6.4 nm³/s is {mobility:g} nm²/(pN µs) ({reading}): area, nm²; changes at 12.8, 6.4, 3.2 against 1.6, %",
            f"≈ {PAPER_AREA:g}; " + ", ".join(f"{change:g}" for change in wanted_column),
            {PHASE_FIELD: in_words(area_of, mobility)},
        )
        for reading, mobility in READINGS.items()
    ]
    remarks = [
        "The changes come from the areas between the runs, interpolated monotonically in log γ.",
        *quick_sentence(quick),
    ]
    return Result(rows, {"mobility": (f"Area at {end:g} µs against γ", draw(rows))}, printed, remarks)


def in_words(area_of, mobility):
    """Area and column about a γ."""
    area = float(area_of(np.log10(mobility)))
    column = ", ".join(text(change if np.isfinite(change) else None, 2) for change in column_of(area_of, mobility))
    return f"{text(area if np.isfinite(area) else None, 5)}; {column}"


def draw(rows):
    """Area against γ, the readings of the print marked."""
    figure, axes = plt.subplots(figsize=(6.4, 3.8), layout="constrained")
    points = [(row["mobility_nm2_per_pN_us"], row["area_nm2"]) for row in rows if row["area_nm2"] is not None]
    if points:
        look = {"color": style.ENGINE_COLOURS[PHASE_FIELD][0], "marker": "s", "label": "printed numerics"}
        axes.plot(*zip(*points), **look)
    axes.axhline(PAPER_AREA, color="#333333", linestyle=":", label="paper")
    for mobility in READINGS.values():
        axes.axvline(mobility, color="#888888", linewidth=0.9)
    axes.set(xscale="log", xlabel="γ (nm²/(pN µs))", ylabel=f"membrane area at {rows[0]['time_us']:g} µs (nm²)")
    axes.set_xlim(MOBILITIES[0] / 2, MOBILITIES[-1] * 2)
    axes.legend()
    return figure
