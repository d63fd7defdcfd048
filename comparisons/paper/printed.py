"""Settings of cases/printed.toml, the paper's numerics as printed, in the print's own units."""

import math
import tomllib

from comparisons import ROOT
from comparisons.measures.metrics import flattened

CASE = ROOT / "cases" / "printed.toml"

#: Table 1: γ (nm³/s), ε (nm), τ (ns), h (nm), the diameter of a triangle.
STANDARD = {"γ": 6.4, "ε": 1.2, "τ": 2.0, "h": 1.25}

#: Our γ (nm²/(pN µs)) for each nm³/s of the print, whose energy unit is missing: 1 pN nm.
MOBILITY_PER_PRINTED = 1e-6

#: Time (µs) of Table 2, and the sharp membrane's area (nm²) then.
TIME, SHARP_AREA = 0.5, 24836.0

#: `--quick`: lengths of layer, edge and cells times this, followed up to this time (µs).
QUICK_FACTOR, QUICK_TIME = 2.0, 0.02


def settings(values, quick):
    """{section.key: text} of cases/printed.toml with some of γ, ε, τ and h (as in STANDARD) changed.

    With ε goes the width of the coat's edge, since (24) has the layer's ε, and h, unless that is given: the paper refines
    the grid with the layer.
    """
    at = {**STANDARD, **values}
    if "ε" in values and "h" not in values:
        at["h"] = STANDARD["h"] * at["ε"] / STANDARD["ε"]
    factor = QUICK_FACTOR if quick else 1.0
    wanted = {
        "phase_field.epsilon": factor * at["ε"],
        "molecules.interface_width": factor * at["ε"],
        "phase_field.cell_size": cell_size(factor * at["h"]),
        "phase_field.paper.mobility": MOBILITY_PER_PRINTED * at["γ"],
        "phase_field.paper.max_step": 1e-3 * at["τ"],
    }
    own = flattened(tomllib.loads(CASE.read_text(encoding="utf-8")))
    return {key: f"{value:.6g}" for key, value in wanted.items() if f"{value:.6g}" != f"{own[key]:.6g}"}


def cell_size(h):
    """Side (nm) of the square whose diameter is h (nm), with the case file's two digits."""
    return round(h / math.sqrt(2), 2)


def quick_sentence(quick):
    """What `--quick` does to these runs."""
    if not quick:
        return []
    return [
        f"Quick: all lengths of layer, edge and cells are {QUICK_FACTOR:g} times the printed ones, τ of the column h is that of the others, "
        f"and the runs end at {QUICK_TIME:g} µs: only the procedure is the paper's, the numbers are not comparable."
    ]
