"""Table 2: how much the membrane area at 0.5 µs depends on γ, ε, τ and h (phase-field engine)."""

from comparisons.drawing import style

style.apply()

import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)

from .item import PHASE_FIELD, Printed, Result, Wanted, is_run, not_run_remarks, text, value_at  # noqa: E402

TITLE = "Table 2: sensitivity of the membrane area"

#: Columns of the table: symbol, unit, [(printed value, printed relative change in %; None for the reference)].
PAPER = {
    "γ": ("nm³/s", [(12.8, 1.84), (6.4, 0.44), (3.2, 0.26), (1.6, None)]),
    "ε": ("nm", [(2.40, 8.53), (1.70, 3.67), (1.20, None)]),
    "τ": ("ns", [(2.00, 0.74), (1.00, 0.47), (0.50, 0.33), (0.25, None)]),
    "h": ("nm", [(1.77, 3.74), (1.25, 2.14), (0.88, 0.01), (0.63, None)]),
}

#: The paper's average area (nm²), its time (µs), and the values the others keep.
PAPER_AREA, TIME = 2.27e4, 0.5
STANDARD = {"γ": 6.4, "ε": 1.2, "τ": 2.0, "h": 1.25}

#: Our γ (nm²/(pN µs)) for each nm³/s of the print, and the paper's τ (ns) of the runs that vary h.
MOBILITY_PER_PRINTED, STEP_FOR_H = 1e-3, 0.1

#: `--quick`: lengths of layer and cells times this, followed up to this time (µs) with τ as it is.
QUICK_FACTOR, QUICK_TIME = 2.0, 0.02


def settings(symbol, value, quick):
    """The settings of the run in which `symbol` has the printed `value`."""
    at = {**STANDARD, symbol: value}
    if symbol == "ε":
        at["h"] = STANDARD["h"] * value / STANDARD["ε"]
    if symbol == "h" and not quick:
        at["τ"] = STEP_FOR_H
    factor = QUICK_FACTOR if quick else 1.0
    return {
        "phase_field.scheme": "paper",
        "phase_field.paper.mobility": f"{MOBILITY_PER_PRINTED * at['γ']:.6g}",
        "phase_field.epsilon": f"{factor * at['ε']:.6g}",
        "phase_field.cell_size": f"{factor * at['h']:.6g}",
        "phase_field.paper.max_step": f"{1e-3 * at['τ']:.6g}",
        "output.field_interval": "0",
    }


def name_of(symbol, value):
    """Name of a run."""
    return f"{symbol}={value:g}"


def wanted(quick):
    """One phase-field run for each entry."""
    end = QUICK_TIME if quick else TIME
    return [
        Wanted(name_of(symbol, value), PHASE_FIELD, "standard", settings(symbol, value, quick), end)
        for symbol, (_, entries) in PAPER.items()
        for value, _ in entries
    ]


def areas(runs, quick):
    """{(symbol, printed value): area in nm², None without a run that got so far}."""
    end = QUICK_TIME if quick else TIME
    found = {}
    for symbol, (_, entries) in PAPER.items():
        for value, _ in entries:
            run = runs[name_of(symbol, value)].get(PHASE_FIELD)
            known = run is not None and is_run(run)
            found[symbol, value] = value_at(run, "membrane_area_nm2", end) if known else None
    return found


def result(runs, quick):
    """See item.Result."""
    area, rows, printed = areas(runs, quick), [], []
    end = QUICK_TIME if quick else TIME
    for symbol, (unit, entries) in PAPER.items():
        reference = area[symbol, entries[-1][0]]
        for value, change in entries:
            ours = None
            if None not in (area[symbol, value], reference):
                ours = 100 * abs(area[symbol, value] - reference) / reference
            row = {"parameter": symbol, "printed_value": value, "unit": unit, "time_us": end}
            row |= {"paper_change_percent": change, "area_nm2": area[symbol, value], "change_percent": ours}
            rows.append(row)
            if change is not None:
                printed.append(
                    Printed(f"{symbol} = {value:g} {unit}", f"{change:g} %", {PHASE_FIELD: text(ours, 3, "%")})
                )
    known = [value for value in area.values() if value is not None]
    mean = sum(known) / len(known) if known else None
    printed.append(
        Printed(f"area at {end:g} µs, nm²", f"≈ {PAPER_AREA:g} at {TIME:g} µs", {PHASE_FIELD: text(mean, 5)})
    )
    remarks = [
        "γ: Table 1's 6.4 nm³/s lacks a unit of energy. Read as 6.4·10⁻⁶ nm²/(pN µs) the phase field is purely advected; "
        f"the runs here take {MOBILITY_PER_PRINTED:g} nm²/(pN µs) for each printed nm³/s, the engine's default, which is "
        "a thousand times that. The row says what halving γ does around it.",
        "The other numerical parameters are this engine's defaults, not the paper's: elements of degree 3, an extension "
        "ξ of the tension a thousand times smaller, relaxation of the profile (docs/phase-field.md says why). So the "
        "changes need not agree; they should be small and fall along each column.",
        "The area itself: the paper prints about 2.27·10⁴ nm² at 0.5 µs. The sharp membrane has 24 836 nm² with the "
        "curvature as printed in (4)–(5) and 22 693 nm² with that of (1)–(2); but the latter never forms a neck. The "
        "print does not say enough to decide whether that is more than a coincidence.",
        *(
            [
                f"Quick: all lengths of layer and cells are {QUICK_FACTOR:g} times the printed ones, τ of the column h is that of "
                f"the others, and the area is taken at {end:g} µs: only the procedure is the paper's, the numbers are not comparable."
            ]
            if quick
            else []
        ),
        *not_run_remarks(runs),
    ]
    return Result(rows, {"table2": (f"Relative change of the area at {end:g} µs", draw(rows))}, printed, remarks)


def draw(rows):
    """Relative changes against the parameter, paper and engine."""
    figure, panels = plt.subplots(1, len(PAPER), figsize=(11.5, 3.3), sharey=True, layout="constrained")
    for axes, (symbol, (unit, _)) in zip(panels, PAPER.items()):
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
        axes.set_xlabel(f"{symbol} ({unit}), as printed")
        axes.set_title(symbol)
    panels[0].set_ylabel("relative change (%)")
    panels[0].legend()
    return figure
