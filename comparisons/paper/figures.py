"""Figures that several items have: histories of runs on the same axes, rows of membranes at some times."""

import numpy as np

from comparisons import BOUNDARY_INTEGRAL
from comparisons.drawing import style
from comparisons.drawing.axes import draw_histories, plain_number
from comparisons.drawing.pictures import Panel, fluid_arrows, gallery, membrane_arrows
from comparisons.drawing.plots import legend_on_top
from comparisons.drawing.style import plt
from comparisons.measures.quantities import DRAWN
from comparisons.paper.item import end_of, is_run, last_time, state_of
from comparisons.studies.members import NECK_CLOSED

COLUMNS = ("neck_radius_nm", "bud_diameter_nm", "bud_height_nm")

#: Colours of runs in order (Okabe and Ito), and the line of each engine.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
LINES = {"boundary-integral": "-", "phase-field": (0, (4, 2))}

#: Where the time axis begins, µs; for runs of less than a microsecond that part of their length.
FIRST_SHOWN = 0.01

#: Room (nm) around the membranes in pictures that show the fluid.
FLUID_MARGIN = 30.0


def history_names(titles, engines):
    """Names of the lines: {(run name, engine): text} from {run name: title}."""
    return {
        (name, engine): f"{title}, {style.ENGINE_NAMES[engine]}" for name, title in titles.items() for engine in engines
    }


def history_figure(runs, names, columns=COLUMNS):
    """Columns against time (logarithmic); names: {(run name, engine): legend text}. A run's colour is its name's."""
    order = list(dict.fromkeys(name for name, _ in names))
    figure, grid = plt.subplots(1, len(columns), figsize=(10.6, 3.6), layout="constrained")
    lines, texts = [], []
    for (name, engine), legend in names.items():
        run = runs[name].get(engine)
        if is_run(run):
            look = {"color": COLOURS[order.index(name) % len(COLOURS)], "linestyle": LINES[engine]}
            lines.append((run.history["time_us"], run.history, look))
            texts.append(legend)
    draw_histories(grid, {column: DRAWN[column] for column in columns}, lines, "none in any run")
    handles = grid[0].get_lines()
    last = max((axes.dataLim.x1 for axes in grid if np.isfinite(axes.dataLim.x1)), default=1.0)
    for axes in grid:
        axes.set_xscale("log", nonpositive="mask")
        axes.xaxis.set_major_formatter(plain_number)
        axes.set_xlim(min(FIRST_SHOWN, FIRST_SHOWN * last), last)
        axes.set_ylim(bottom=0)
    if "neck_radius_nm" in columns and np.isfinite(grid[columns.index("neck_radius_nm")].dataLim.y1):
        grid[columns.index("neck_radius_nm")].axhline(
            style.BUDDING_NECK_RADIUS, color="#888888", linewidth=0.9, linestyle=":"
        )
    if handles:
        legend_on_top(figure, handles, texts)
    return figure


def panels_at(found, times, draw, sharp=None):
    """Panels of a run at some times (µs); draw(run, time) makes one. sharp: a run whose membrane is drawn over it, or None."""
    if not is_run(found):
        return [Panel(f"t = {time:.4g} µs", state_of(found)) for time in times]
    reached = last_time(found) * (1 + 1e-12)
    panels = [draw(found, time) if time <= reached else after_the_end(found, time) for time in times]
    return [with_line(panel, sharp, time) for panel, time in zip(panels, times)]


def with_line(panel, sharp, time):
    """The panel with another run's membrane at a time (µs) as a line, if there is such a run and it went on so long."""
    if not is_run(sharp) or time > last_time(sharp) * (1 + 1e-12):
        return panel
    return panel._replace(other=sharp.shape_at(time))


def sharp_of(engines, engine):
    """The sharp engine's run of {engine: run} beside another engine's; None for its own."""
    return None if engine == BOUNDARY_INTEGRAL else engines.get(BOUNDARY_INTEGRAL)


def after_the_end(run, time):
    """A panel for a time after a run's end: the last shape if its neck had closed, else a sentence."""
    if run.record.get("exit_reason") == NECK_CLOSED:
        last = run.shapes[-1]
        return Panel(f"t = {last.time:.4g} µs, neck closed", last)
    return Panel(f"t = {time:.4g} µs", f"the run ended at {end_of(run):.4g} µs" + ended_because(run))


def membrane(run, time):
    """The membrane alone."""
    return Panel(f"t = {time:.4g} µs", run.shape_at(time))


def moving_membrane(run, time):
    """The membrane with its velocity, if the engine records one: the phase field does not without flow."""
    shape = run.shape_at(time)
    moves = shape.u_r.any() or shape.u_z.any()
    return Panel(f"t = {time:.4g} µs", shape, membrane_arrows(shape) if moves else None)


def membrane_in_fluid(run, time):
    """The membrane with the fluid's velocity at the output time nearest to it; its own where the run wrote no fields."""
    fields = run.fields_at(time) if run.parameters["fluid"]["dynamics"] == "flow" else None
    if fields is None or abs(fields.time - time) > 0.5 * run.parameters["output"]["field_interval"]:
        return moving_membrane(run, time)
    return Panel(f"t = {time:.4g} µs, flow at {fields.time:.4g} µs", run.shape_at(time), fluid_arrows(fields))


def ended_because(run):
    """Why a run ended before its time, in words; "" when it did not."""
    reason = run.record.get("exit_reason")
    return {NECK_CLOSED: "\n(neck closed)", "budded": "\n(budded)"}.get(reason, "")


def snapshots(runs, times, names, draw=membrane):
    """Figure with a row for each engine and run (names: {run name: title}) at times (µs); rows without any shape are left out.

    Over the layer the sharp membrane is drawn as a dashed line.
    """
    rows = [
        (f"{title}\n{style.ENGINE_NAMES[engine]}", panels_at(found, times, draw, sharp_of(runs[name], engine)))
        for name, title in names.items()
        for engine, found in runs[name].items()
    ]
    shown = [row for row in rows if any(not isinstance(panel.shape, str) for panel in row[1])]
    return gallery(shown or rows[:1], FLUID_MARGIN if draw is membrane_in_fluid else 7.0)
