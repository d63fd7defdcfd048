"""Table 2: how much the membrane area at 0.5 µs depends on γ, ε, τ and h, by the paper's printed numerics."""

import numpy as np

from comparisons import PHASE_FIELD
from comparisons.drawing import style
from comparisons.drawing.style import plt
from comparisons.paper.item import Printed, Result, Wanted, end_of, is_run, state_of, text, value_at
from comparisons.paper.printed import QUICK_TIME, SHARP_AREA, STANDARD, TIME, quick_sentence, settings

TITLE = "Table 2: sensitivity of the membrane area"

#: Columns of the table: symbol, unit, [(printed value, printed relative change in %; None for the reference)].
PAPER = {
    "γ": ("nm³/s", [(12.8, 1.84), (6.4, 0.44), (3.2, 0.26), (1.6, None)]),
    "ε": ("nm", [(2.40, 8.53), (1.70, 3.67), (1.20, None)]),
    "τ": ("ns", [(2.00, 0.74), (1.00, 0.47), (0.50, 0.33), (0.25, None)]),
    "h": ("nm", [(1.77, 3.74), (1.25, 2.14), (0.88, 0.01), (0.63, None)]),
}

#: The paper's average area (nm²) at TIME, and the paper's τ (ns) of the runs that vary h.
PAPER_AREA, STEP_FOR_H = 2.27e4, 0.1

#: The column of h once more, with the τ of the columns γ and ε: not printed, but with STEP_FOR_H no run gets to TIME.
OTHER_STEP = f"h, τ = {STANDARD['τ']:g} ns"
COLUMNS = PAPER | {OTHER_STEP: PAPER["h"]}

#: Part of its time by which a run that ends early is still sound: it blows up in its last steps.
SOUND = 0.9


def name_of(symbol, value):
    """Name of a run."""
    return f"{symbol}={value:g}"


def wanted(quick):
    """One run of cases/printed.toml for each entry; equal ones are one run."""
    return [
        Wanted(
            name_of(symbol, value),
            PHASE_FIELD,
            "printed",
            settings(values_of(symbol, value, quick), quick),
            QUICK_TIME if quick else TIME,
        )
        for symbol, (_, entries) in COLUMNS.items()
        for value, _ in entries
    ]


def values_of(symbol, value, quick):
    """What an entry of the table changes, as printed.settings takes it."""
    if symbol == OTHER_STEP:
        return {"h": value}
    return {symbol: value} | ({"τ": STEP_FOR_H} if symbol == "h" and not quick else {})


def run_of(runs, symbol, value):
    """The run of an entry, or why there is none."""
    return runs[name_of(symbol, value)].get(PHASE_FIELD)


def times(runs, end):
    """{symbol: the time (µs) at which its column is compared}: the end, or the last one at which all its runs are sound."""
    found = {}
    for symbol, (_, entries) in COLUMNS.items():
        own = [run_of(runs, symbol, value) for value, _ in entries]
        found[symbol] = min([end, *(SOUND * end_of(run) for run in own if ends_early(run, end))])
    return found


def ends_early(run, end):
    """Whether there is a run that did not get to a time (µs)."""
    return is_run(run) and end_of(run) < end * (1 - 1e-9)


def areas(runs, time):
    """{(symbol, printed value): area in nm² at the column's time[symbol], None without a run}."""
    return {
        (symbol, value): value_at(run_of(runs, symbol, value), "membrane_area_nm2", time[symbol])
        for symbol, (_, entries) in COLUMNS.items()
        for value, _ in entries
    }


def early_ends(runs, end):
    """One sentence for each run that ended before the time of the table."""
    ended = {name: own.get(PHASE_FIELD) for name, own in runs.items()}
    return [
        f"{name} ends at {end_of(run):.3g} µs: {state_of(run)}."
        for name, run in ended.items()
        if ends_early(run, end)
    ]


def printed_limits():
    """What the printed column of ε says of ε = 0 if thicker layers are slower: {how: area in nm²}.

    The areas are PAPER_AREA (1 − change). A line through all, the line through the two thinnest, a parabola.
    """
    entries = PAPER["ε"][1]
    epsilon = np.array([value for value, _ in entries])
    area = PAPER_AREA * (1 - np.array([change or 0.0 for _, change in entries]) / 100)
    return {
        "line": float(np.polyfit(epsilon, area, 1)[-1]),
        "two thinnest": float(np.polyfit(epsilon[-2:], area[-2:], 1)[-1]),
        "parabola": float(np.polyfit(epsilon, area, 2)[-1]),
    }


def rows_of(area, time):
    """One row for each entry of the table; time: {symbol: µs}."""
    rows = []
    for symbol, (unit, entries) in COLUMNS.items():
        reference = area[symbol, entries[-1][0]]
        for value, change in entries:
            known = None not in (area[symbol, value], reference)
            ours = 100 * (area[symbol, value] - reference) / reference if known else None
            row = {"parameter": symbol, "printed_value": value, "unit": unit, "time_us": time[symbol]}
            row |= {"paper_change_percent": change, "area_nm2": area[symbol, value]}
            rows.append(row | {"change_percent": ours if ours is None else abs(ours), "signed_change_percent": ours})
    return rows


def result(runs, quick):
    """See item.Result."""
    end = QUICK_TIME if quick else TIME
    time = times(runs, end)
    area = areas(runs, time)
    rows = rows_of(area, time)
    printed = [
        Printed(
            f"{row['parameter']}: {row['printed_value']:g} {row['unit']}"
            + ("" if row["time_us"] == end else f", at {row['time_us']:.3g} µs"),
            f"{row['paper_change_percent']:g} %",
            {PHASE_FIELD: text(row["signed_change_percent"], 3, "%")},
        )
        for row in rows
        if row["paper_change_percent"] is not None
    ]
    known = [
        area[symbol, value]
        for symbol, value in area
        if symbol != OTHER_STEP and time[symbol] == end and area[symbol, value] is not None
    ]
    mean = sum(known) / len(known) if known else None
    printed.append(
        Printed(f"area at {end:g} µs, nm²", f"≈ {PAPER_AREA:g} at {TIME:g} µs", {PHASE_FIELD: text(mean, 5)})
    )
    limits = printed_limits()
    remarks = [
        "The runs are cases/printed.toml, the paper's numerics to the letter where the print has one reading; "
        "docs/phase-field-paper.md lists where it has two, and which is taken.",
        "γ: Table 1's 6.4 nm³/s lacks a unit of energy; it is read as 6.4·10⁻⁶ nm²/(pN µs) (energies in pN nm). "
        "The item “mobility” goes through the other readings.",
        "The changes have signs here, the print has none.",
        f"The paper varies h with τ = {STEP_FOR_H:g} ns; “{OTHER_STEP}” is the same with the τ of the other columns.",
        f"The printed column of ε, if thicker layers are slower and {PAPER_AREA:g} nm² is the area of the thinnest, goes to "
        f"{limits['line']:.0f} (a line), {limits['two thinnest']:.0f} (the two thinnest) or {limits['parabola']:.0f} nm² (a parabola) at "
        f"ε = 0: to the sharp membrane's {SHARP_AREA:.0f}, not away from it. A caveat: the print gives no signs, calls the area an average "
        "of all runs, and varies h and, having one ε, the width of the coat's edge together with the layer.",
        *early_ends(runs, end),
        *quick_sentence(quick),
    ]
    return Result(rows, {"table2": (f"Relative change of the area at {end:g} µs", draw(rows, end))}, printed, remarks)


def draw(rows, end):
    """Relative changes against the parameter, paper and engine."""
    figure, panels = plt.subplots(1, len(COLUMNS), figsize=(13.5, 3.3), sharey=True, layout="constrained")
    for axes, (symbol, (unit, _)) in zip(panels, COLUMNS.items()):
        own = [row for row in rows if row["parameter"] == symbol]
        for column, look in (
            ("paper_change_percent", {"color": "#333333", "marker": "*", "linestyle": ":", "label": "paper"}),
            ("change_percent", {"color": style.ENGINE_COLOURS[PHASE_FIELD][0], "marker": "s", "label": "phase field"}),
        ):
            points = [(row["printed_value"], row[column]) for row in own if row[column]]
            if points:
                axes.plot(*zip(*points), **look)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xticks([row["printed_value"] for row in own], [f"{row['printed_value']:g}" for row in own])
        axes.minorticks_off()
        axes.set_xlabel(f"{symbol[0]} ({unit}), as printed")
        time = own[0]["time_us"]
        axes.set_title(symbol if time == end else f"{symbol}, at {time:.2g} µs")
    panels[0].set_ylabel("relative change (%)")
    panels[0].legend()
    return figure
