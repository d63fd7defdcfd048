"""A single run: its plots and report.html."""

import numpy as np

from comparisons.drawing import style
from comparisons.drawing.axes import draw_histories, mark_time
from comparisons.drawing.pictures import Panel, gallery
from comparisons.drawing.plots import panels, save_all
from comparisons.files import write_text
from comparisons.measures.along import Along
from comparisons.measures.metrics import flattened
from comparisons.measures.quantities import DRAWN
from comparisons.measures.words import basis
from comparisons.page import html
from comparisons.page.html import code, count_or_figures, escaped, figures, prose, quantity
from comparisons.studies.certification import in_words
from endoflow.history import unit_of
from endoflow.run_state import unfinished

#: Panels of the picture of the membrane.
PANELS = 4


def write_page(run, directory):
    """Write plots and report.html of an endoflow.Run into directory (Path)."""
    plots = {
        "run_membranes": ("The membrane, coloured by molecule concentration c", membranes(run)),
        "run_histories": ("Histories", histories(run)),
    }
    write_text(directory / "report.html", run_html(run, save_all(plots, directory), directory))


def membranes(run):
    """Output shapes, evenly chosen up to a little after budding or to the end."""
    times = run.shape_times
    end = min(times[-1], 1.2 * (run.event_time("budding") or times[-1]))
    wanted = np.linspace(times[0], end, PANELS + 1)[1:] if len(times) > 1 else times
    chosen = np.unique(np.argmin(np.abs(times[:, None] - wanted), axis=0))
    along = Along(run)
    start = "t = " if along.is_time else ""
    return gallery([("", [Panel(start + along.quantity(times[index]), run.shapes[index]) for index in chosen])])


def histories(run):
    """Every quantity of DRAWN against what the run goes along."""
    along = Along(run)
    figure, grid = panels(len(DRAWN))
    colour = style.ENGINE_COLOURS.get(run.engine, style.SECOND_RUN_COLOUR)[0]
    look = {"color": colour, "marker": "o" if len(along.values) == 1 else ""}
    draw_histories(grid, DRAWN, [(along.values, run.history, look)], "none in this run", along.label)
    for axes in grid:
        mark_time(axes, run.event_time("budding"))
    return figure


def run_html(run, drawn, directory):
    """The page of an endoflow.Run; drawn: {plot: title}, written into directory (Path)."""
    certified = certificate(run)
    record = {key: value for key, value in run.record.items() if key != "certificate"}
    sections = [
        *([("Certified", certified)] if certified else []),
        ("What the numbers rest on", html.facts(basis(run.record).items())),
        ("Plots", html.plots(drawn, directory)),
        ("Last row of history.csv", last_row(run)),
        ("Parameters", html.folded("All parameters of the run", html.parameters_table(flattened(run.parameters)))),
        ("Provenance", html.folded(html.PROVENANCE, html.provenance_table([record], [""]))),
    ]
    name = run.parameters.get("case", {}).get("name", "run")
    found = [f"accuracy alarm: {alarm}" for alarm in run.alarms]
    if left := unfinished(run.directory, run.record):
        found.append(f"the run did not finish: {left}")
    subtitle = f"Case “{name}” · {style.ENGINE_NAMES.get(run.engine, run.engine)} · {extent(run)}"
    return html.page("endoflow report", f"Run “{name}”", subtitle, found, cards(run), sections, run.directory)


def extent(run):
    """How far the run goes, in words."""
    if run.engine == "statics":
        count = len(run.shapes)
        return f"{count} stationary shapes, {Along(run).span()}" if count > 1 else "one stationary shape"
    return f"to {run.history['time_us'][-1]:.4g} µs"


def cards(run):
    """The key numbers on top: (title, ready HTML value, note)."""
    last = {name: values[-1] for name, values in run.history.items()}
    found = [("Ended with", escaped(run.record.get("exit_reason") or run.record.get("state") or "–"), extent(run))]
    if run.engine != "statics":
        found.append(("Budding", quantity(run.event_time("budding"), 4, "µs"), "neck radius below 5 nm"))
    for column in ("neck_radius_nm", "bud_diameter_nm", "bud_height_nm"):
        value = float(last[column])
        found.append(
            (DRAWN[column].title, quantity(None if value != value else value, 4, "nm"), "at the end")
        )
    return found


def certificate(run):
    """What `--certify` found: value ± error; "" for a run without a certificate."""
    found = run.record.get("certificate", {}).get("values", {})
    rows = [
        [escaped(entry["title"]), escaped(in_words(entry)), escaped(parts_in_words(entry))]
        for entry in found.values()
    ]
    return html.table(["", "value", "from"], rows, "text") if rows else ""


def parts_in_words(entry):
    """Where the error comes from."""
    return ", ".join(f"{part} {error:.2g}" for part, error in entry["parts"].items())


def last_row(run):
    """Every column's last value with its unit and what it is."""
    rows, meanings = [], run.record.get("columns", {})
    for column, values in run.history.items():
        value, unit = float(values[-1]), unit_of(column)
        shown = "–" if value != value else (count_or_figures if unit == "1" else figures)(value, 5)
        rows.append([code(column), shown, escaped("" if unit == "1" else unit), prose(meanings.get(column, ""))])
    return html.table(["", "value", "unit", "what it is"], rows, "words-last")
