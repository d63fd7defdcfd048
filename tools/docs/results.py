#!/usr/bin/env python3
"""Tables of docs/results/ from run directories, as Markdown.

    tools/docs/results.py differences SHARP DIFFUSE [--times 0.01,0.1]   the diffuse engine's run less the sharp engine's
    tools/docs/results.py refinement DIR...                              one row for each run of the sharp engine
    tools/docs/results.py balance DIR... [--from 0.02]                   what runs of the diffuse engine say of themselves
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import endoflow  # noqa: E402

TIMES = "0.0005,0.0077,0.02,0.05,0.1,0.2,0.4,0.6,0.8,1"

#: Column of history.csv of a quantity that is compared, and whether its value at time zero is taken off.
COMPARED = {
    "area gain": ("membrane_area_nm2", True),
    "volume": ("volume_extracellular_nm3", True),
    "energy": ("bending_energy_pN_nm", False),
    "height": ("bud_height_nm", True),
}


def table(head, rows):
    """Markdown of a table."""
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [head, ["---"] * len(head), *rows])


def text(numbers, form):
    """Numbers separated by commas; a dash where one does not exist."""
    if np.isnan(numbers).any():
        return "–"
    return ", ".join(form.format(number) for number in numbers).replace("-", "−").replace("%", " %")


def flat_area(run):
    """Area of the plane membrane at the start [nm²]."""
    return np.pi * run.parameters["domain"]["radius"] ** 2


def value(run, quantity, time):
    """A compared quantity at a time (µs)."""
    column, from_start = COMPARED[quantity]
    start = flat_area(run) if from_start and column == "membrane_area_nm2" else 0
    return run.history_at(column, time) - start


def differences(arguments):
    """Relative differences of a diffuse run from a sharp one, and both necks."""
    sharp, diffuse = (endoflow.load(name) for name in (arguments.sharp, arguments.diffuse))
    rows = []
    for time in [float(text) for text in arguments.times.split(",")]:
        parts = [value(diffuse, name, time) / value(sharp, name, time) - 1 for name in COMPARED]
        necks = [run.history_at("neck_radius_nm", time) for run in (diffuse, sharp)]
        rows.append([f"{time:g}", *(text([part], "{:+.2%}") for part in parts), text(necks, "{:.3f}")])
    return table(["time, µs", *COMPARED, "neck, sharp, nm"], rows)


def budding(run):
    """Time of budding as text."""
    time = run.event_time("budding")
    return "–" if time is None else f"{time:.8f}".rstrip("0")


def refinement(arguments):
    """Settings, results and cost of runs of the sharp engine."""
    rows = []
    for run in map(endoflow.load, arguments.runs):
        own, notes, end = run.parameters["boundary_integral"], run.record["notes"], run.history["time_us"][-1]
        neck, area = run.history_at("neck_radius_nm", end), run.history_at("membrane_area_nm2", end)
        rows.append(
            [str(notes["elements"]), f"{notes['time_tolerance']:.0e}", str(own["quadrature_order"])]
            + [budding(run), f"{neck:.6f}", f"{area:.4f}", str(run.record["steps"]["accepted"])]
            + [f"{run.record['cpu_s']:.1f}", f"{run.history['area_strain_max'].max():.0e}"]
        )
    head = ["elements", "tolerance", "points", "budding, µs", "neck, nm", "area, nm²", "steps", "processor time, s"]
    return table([*head, "largest strain"], rows)


def balance(arguments):
    """Steps, cost and what a run of the diffuse engine keeps or loses."""
    rows = []
    for run in map(endoflow.load, arguments.runs):
        h = run.history
        late = h["time_us"] >= arguments.start
        residual = np.abs(h["energy_law_residual_pN_nm_per_us"][late] / h["viscous_dissipation_pN_nm_per_us"][late])
        law = [np.median(residual), residual.max()] if late.any() else [np.nan]
        mass = h["molecule_mass_nm2"]
        rows.append(
            [f"{run.parameters['phase_field']['epsilon']:g}", budding(run)]
            + [f"{run.record['steps']['accepted']}, {run.record['steps']['rejected']}", f"{run.record['cpu_s']:.0f}"]
            + [text(law, "{:.2%}"), text([h[f"{name}_error_max"].max() for name in ("thickness", "profile")], "{:.2%}")]
            + [text([h["area_strain_max"].max()], "{:.3%}"), f"{np.abs(mass / mass[0] - 1).max():.1e}"]
        )
    head = ["ε, nm", "budding, µs", "steps, repeated", "processor time, s", "energy law: median, largest"]
    return table([*head, "thickness, profile", "strain", "change of mass"], rows)


def main():
    """Print the table asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    kinds = parser.add_subparsers(required=True)
    one = kinds.add_parser("differences")
    one.add_argument("sharp")
    one.add_argument("diffuse")
    one.add_argument("--times", default=TIMES, help="µs, separated by commas")
    one.set_defaults(make=differences)
    for name, make in (("refinement", refinement), ("balance", balance)):
        one = kinds.add_parser(name)
        one.add_argument("runs", nargs="+")
        one.set_defaults(make=make)
    one.add_argument("--from", dest="start", type=float, default=0.02, help="µs: from when on the energy law is looked at")
    arguments = parser.parse_args()
    try:
        print(arguments.make(arguments))
    except endoflow.EndoflowError as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
