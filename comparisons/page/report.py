"""report.html: one file without links to anything outside, made from the sources in assets/."""

import base64
import json
from pathlib import Path

from comparisons.drawing import style
from comparisons.measures.basis import basis
from comparisons.measures.metrics import ENGINE_SECTIONS, QUANTITIES, flat_parameters
from comparisons.page.numbers import code, escaped, figures, flattened, percent, quantity, setting
from comparisons.page.report_data import report_data

SOURCES = Path(__file__).resolve().parent / "assets"
SCRIPTS = ("theme.js", "data.js", "colours.js", "membrane_view.js", "charts.js", "readout.js", "player.js", "main.js")

#: Entries of run.json that are no part of the provenance: told elsewhere on the page, or the same for every run (docs/outputs.md).
TOLD = ("parameters", "alarms", "columns")

#: What the rest of run.json is.
PROVENANCE = "Programs, machines, times, and what was noted on the way"

#: Titles of the compared quantities.
TITLES = {name: f"{plot.title} ({plot.unit})" for name, plot in style.HISTORY_PLOTS.items()}

#: Columns of the table of all output times: key, entry of a pair (or None), heading.
TIME_COLUMNS = (
    ("time_us", None, "t (µs)"),
    ("mean_distance_nm", None, "mean distance (nm)"),
    ("hausdorff_distance_nm", None, "Hausdorff (nm)"),
    ("interpolation_error_nm", None, "of that, interpolation (nm)"),
    ("neck_radius_nm", "a", "neck A (nm)"),
    ("neck_radius_nm", "b", "neck B (nm)"),
    ("bud_diameter_nm", "a", "diameter A (nm)"),
    ("bud_diameter_nm", "b", "diameter B (nm)"),
    ("concentration_l1_relative", None, "∫|Δc| dA / ∫c dA"),
    ("concentration_max", None, "max |Δc|"),
)


def report_html(a, b, metrics, plots, directory):
    """The report's text for two endoflow.Run objects, their metrics, and the plots {name: title} in directory (Path)."""
    labels = [metrics["runs"][key]["label"] for key in "ab"]
    parameters = parameter_rows(a, b)
    data = json.dumps(report_data(a, b, metrics), allow_nan=False, separators=(",", ":"))
    sections = filled(
        source("comparison.html"),
        sides="".join(f'<span class="ink-{key}">{escaped(label)}</span>' for key, label in zip("ab", labels)),
        canvas_label=escaped(
            f"Both membranes at the time shown: {labels[0]} left, {labels[1]} right, coloured by concentration"
        ),
        readout_heads="".join(
            f'<th scope="col" class="ink-{key}">{escaped(label)}</th>' for key, label in zip("ab", labels)
        ),
        cards=card_section(cards(metrics)),
        legend=legend(labels),
        metrics_table=metrics_table(metrics, labels),
        times=folded("All output times", times_table(metrics["times"])),
        plots="\n".join(plot(directory / f"{name}.svg", title) for name, title in plots.items()),
        basis_table=basis_table(a, b, labels),
        parameters=folded(
            "All parameters of both runs",
            table(["", *map(escaped, labels)], parameters, "text"),
            unfolded=any(kind == "differs" for kind, _ in parameters),
        ),
        provenance=folded(PROVENANCE, provenance_table(a, b, labels)),
    )
    embedded = data.replace("</", "<\\/")
    return page(
        "endoflow compare",
        title=escaped(f"{labels[0]} and {labels[1]}: endoflow comparison"),
        heading=escaped(f"{labels[0].capitalize()} and {labels[1]}"),
        finding=f'<p class="finding">{escaped(metrics["finding"])}</p>',
        subtitle=subtitle(a, b, metrics),
        warnings=warnings(metrics["warnings"]),
        cards="",
        sections=sections,
        origin="from " + " and ".join(f"<code>{escaped(str(run.directory))}</code>" for run in (a, b)),
        scripts=SCRIPTS,
        colours=run_colours(a, b),
        data=f'<script type="application/json" id="report-data">{embedded}</script>',
    )


def source(name):
    """Text of a file in assets/."""
    return (SOURCES / name).read_text(encoding="utf-8")


def page(command, title, heading, subtitle, warnings, cards, sections, origin, scripts, colours="", data="", finding=""):
    """A whole page's text; every argument but `scripts`, names of files in assets/, is ready HTML or style sheet."""
    return filled(
        source("page.html"),
        command=escaped(command),
        title=title,
        heading=heading,
        finding=finding,
        subtitle=subtitle,
        style=source("report.css") + colours,
        warnings=warnings,
        cards=card_section(cards),
        sections=sections,
        origin=origin,
        data=data,
        script="\n".join(source(name) for name in scripts),
    )


def card_section(cards):
    """The section of the key numbers; empty without any."""
    return f'<section aria-label="Key numbers"><dl class="cards">{cards}</dl></section>' if cards else ""


def filled(template, **values):
    """The template with each {{name}} replaced once; values are not searched for names."""
    head, *rest = template.split("{{")
    pieces = [head]
    for piece in rest:
        name, after = piece.split("}}", 1)
        pieces += [values[name], after]
    return "".join(pieces)


def run_colours(a, b):
    """Style sheet rules that give each run its engine's colour, on light and on dark ground."""
    (a_light, a_dark), (b_light, b_dark) = style.colours(a, b)
    return (
        f":root {{ --run-a: {a_light}; --run-b: {b_light}; }}\n"
        f':root[data-theme="dark"] {{ --run-a: {a_dark}; --run-b: {b_dark}; }}\n'
    )


def subtitle(a, b, metrics):
    """Case name and the time both runs cover."""
    first, last = metrics["common_interval_us"]
    names = dict.fromkeys(str(run.parameters.get("case", {}).get("name", "")) for run in (a, b))
    case = " / ".join(name for name in names if name)
    return escaped((f"Case “{case}” · " if case else "") + f"compared from {first:g} to {last:g} µs")


def warnings(found):
    """The box of warnings; empty without any."""
    if not found:
        return ""
    items = "".join(f"<li>{escaped(text)}</li>" for text in found)
    return f'<div class="warnings" role="note"><p>Read this first</p><ul>{items}</ul></div>'


def cards(metrics):
    """The key numbers."""
    labels = [metrics["runs"][key]["label"] for key in "ab"]
    budding, found = metrics["budding"], metrics["summary"]
    relative = (
        f"{percent(budding['relative_difference'])} between the runs"
        if budding["difference_us"] is not None
        else "not in both runs"
    )
    worst = f"at {setting(found['max_hausdorff_distance_time_us'], 4)} µs{interpolation_note(found)}"
    entries = [
        (f"Budding, {labels[0]}", quantity(budding["a_us"], 4, "µs"), "neck radius below 5 nm", "ink-a"),
        (f"Budding, {labels[1]}", quantity(budding["b_us"], 4, "µs"), "neck radius below 5 nm", "ink-b"),
        ("Budding time difference", quantity(budding["difference_us"], 3, "µs"), relative, ""),
        ("Mean distance", quantity(found["time_mean_of_mean_distance_nm"], 3, "nm"), "along the curves, over time", ""),
        ("Largest Hausdorff distance", quantity(found["max_hausdorff_distance_nm"], 3, "nm"), worst, ""),
    ]
    return "".join(
        f'<div><dt>{escaped(title)}</dt><dd class="{ink}">{value}<small>{escaped(note)}</small></dd></div>'
        for title, value, note, ink in entries
    )


def interpolation_note(found):
    """What part of a distance may be interpolation in time, as a continuation of a sentence; found: the summary."""
    if not found["includes_interpolated_shapes"]:
        return ""
    error = found["interpolation_error_nm"]
    return ", interpolated shapes" if error is None else f"; up to {figures(error, 2)} nm of it interpolation"


def legend(labels):
    """Line samples of both runs."""
    dashes = (' stroke-width="4"', ' stroke-width="2" stroke-dasharray="6 4"')
    return "".join(
        f'<span class="key"><svg width="34" height="10" aria-hidden="true"><line x1="1" x2="33" y1="5" y2="5" '
        f'stroke="var(--run-{key})"{dash}/></svg>{escaped(label)}</span>'
        for key, label, dash in zip("ab", labels, dashes)
    )


def table(heads, rows, kind=""):
    """A table, without a head where no column has a heading; rows are (class, cells) with ready HTML cells, the first cell being the row's heading."""
    head = "".join(f'<th scope="col">{text}</th>' for text in heads)
    head = f"<thead><tr>{head}</tr></thead>" if any(heads) else ""
    body = "".join(
        f'<tr class="{row_class}"><th scope="row">{cells[0]}</th>'
        + "".join(f"<td>{cell}</td>" for cell in cells[1:])
        + "</tr>"
        for row_class, cells in rows
    )
    return (
        f'<div class="table {kind}" tabindex="0" role="region" aria-label="table">'
        f"<table>{head}<tbody>{body}</tbody></table></div>"
    )


def folded(summary, body, unfolded=False):
    """Ready HTML that a click on its summary shows."""
    return f"<details{' open' if unfolded else ''}><summary>{escaped(summary)}</summary>{body}</details>"


def metrics_table(metrics, labels):
    """Every quantity at the last common time, with its largest relative difference over all times."""
    last = metrics["times"][-1]
    factors = {name: plot.factor for name, plot in style.HISTORY_PLOTS.items()}
    rows = []
    for name in QUANTITIES:
        entry = last[name]
        scaled = [None if entry[key] is None else entry[key] * factors[name] for key in ("a", "b", "difference")]
        largest = metrics["summary"]["max_relative_difference"][name]
        cells = [
            escaped(TITLES[name]),
            *(figures(v) for v in scaled),
            percent(entry["relative_difference"]),
            percent(largest).lstrip("+"),
        ]
        rows.append(("", cells))
    end = f"at {setting(last['time_us'], 4)} µs"
    heads = [
        "",
        *(f"{escaped(label)}<br>{end}" for label in labels),
        f"difference<br>{end}",
        f"relative<br>{end}",
        "largest relative<br>at any time",
    ]
    return table(heads, rows)


def times_table(records):
    """The records of metrics.json as rows."""
    rows = [
        ("", [figures(r[key] if entry is None else r[key][entry]) for key, entry, _ in TIME_COLUMNS]) for r in records
    ]
    return table([heading for *_, heading in TIME_COLUMNS], rows)


def plot(path, title):
    """One static plot, embedded."""
    source = base64.b64encode(path.read_bytes()).decode("ascii")
    return (
        f'<figure class="plot"><figcaption>{escaped(title)}</figcaption>'
        f'<img alt="{escaped(title)}" src="data:image/svg+xml;base64,{source}"></figure>'
    )


def basis_table(a, b, labels):
    """What the numbers of both runs rest on."""
    rows = [("", [escaped(what), escaped(x), escaped(y)]) for (what, x), (_, y) in zip(basis(a), basis(b))]
    return table(["", *map(escaped, labels)], rows, "text")


def parameter_rows(a, b):
    """All parameters of both runs as rows of a table; those that differ are marked, an engine's own only between runs of one engine."""
    flat_a, flat_b = flat_parameters(a.parameters), flat_parameters(b.parameters)
    rows = []
    for key in dict.fromkeys([*flat_a, *flat_b]):
        values = flat_a.get(key), flat_b.get(key)
        differs = values[0] != values[1] and (a.engine == b.engine or key.split(".")[0] not in ENGINE_SECTIONS)
        rows.append(("differs" if differs else "", [code(key), *map(setting, values)]))
    return rows


def provenance_table(a, b, labels):
    """Everything else in run.json: versions, host, times."""
    flat_a, flat_b = (flattened({k: v for k, v in run.record.items() if k not in TOLD}) for run in (a, b))
    keys = list(dict.fromkeys([*flat_a, *flat_b]))
    rows = [
        ("", [code(key), setting(flat_a.get(key), 6), setting(flat_b.get(key), 6)]) for key in keys
    ]
    return table(["", *map(escaped, labels)], rows, "text")
