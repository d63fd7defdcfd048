"""report.html of a single run."""

from comparisons.drawing import style
from comparisons.measures.along import Along
from comparisons.measures.basis import basis
from comparisons.measures.certificate import in_words
from comparisons.measures.metrics import flat_parameters
from comparisons.page import report
from comparisons.page.numbers import code, count_or_figures, escaped, figures, flattened, prose, quantity, setting
from comparisons.page.study_report import page, parameters_table
from endoflow.history import unit_of
from endoflow.run_state import unfinished


def run_html(run, drawn, directory):
    """The page of an endoflow.Run; drawn: {plot: title}, written into directory (Path)."""
    plots = "".join(report.plot(directory / f"{name}.svg", title) for name, title in drawn.items())
    basics = report.table(["", ""], [("", [escaped(what), escaped(value)]) for what, value in basis(run)], "text")
    certified = certificate(run)
    sections = [
        *([("Certified", certified)] if certified else []),
        ("What the numbers rest on", basics),
        ("Plots", plots),
        ("Last row of history.csv", last_row(run)),
        ("Parameters", report.folded("All parameters of the run", parameters_table(flat_parameters(run.parameters)))),
        ("Provenance", report.folded(report.PROVENANCE, provenance(run))),
    ]
    name = run.parameters.get("case", {}).get("name", "run")
    found = [f"accuracy alarm: {alarm}" for alarm in run.alarms]
    if left := unfinished(run.directory, run.record):
        found.append(f"the run did not finish: {left}")
    subtitle = f"Case “{name}” · {style.ENGINE_NAMES.get(run.engine, run.engine)} · {extent(run)}"
    return page("endoflow report", f"Run “{name}”", subtitle, found, cards(run), sections, run.directory)


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
            (style.HISTORY_PLOTS[column].title, quantity(None if value != value else value, 4, "nm"), "at the end")
        )
    return found


def certificate(run):
    """What `--certify` found: value ± error; "" for a run without a certificate."""
    found = run.record.get("certificate", {}).get("values", {})
    rows = [
        ("", [escaped(entry["title"]), escaped(in_words(entry)), escaped(parts_in_words(entry))])
        for entry in found.values()
    ]
    return report.table(["", "value", "from"], rows, "text") if rows else ""


def parts_in_words(entry):
    """Where the error comes from."""
    return ", ".join(f"{part} {error:.2g}" for part, error in entry["parts"].items())


def last_row(run):
    """Every column's last value with its unit and what it is."""
    rows, meanings = [], run.record.get("columns", {})
    for column, values in run.history.items():
        value, unit = float(values[-1]), unit_of(column)
        shown = "–" if value != value else (count_or_figures if unit == "1" else figures)(value, 5)
        rows.append(("", [code(column), shown, escaped("" if unit == "1" else unit), prose(meanings.get(column, ""))]))
    return report.table(["", "value", "unit", "what it is"], rows, "words-last")


def provenance(run):
    """Everything else in run.json."""
    record = {key: value for key, value in run.record.items() if key not in (*report.TOLD, "certificate")}
    flat = flattened(record)
    return report.table(
        ["", ""], [("", [code(key), setting(value, 6)]) for key, value in flat.items()], "text"
    )
