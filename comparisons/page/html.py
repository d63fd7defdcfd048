"""Pages as one HTML file without links to anything outside, made from the sources in assets/: the parts that all pages have."""

import base64
import html
import re
from collections import namedtuple
from pathlib import Path

from comparisons.measures.metrics import flattened
from comparisons.measures.words import with_powers
from endoflow.curves import arc_length, resample
from endoflow.history import name_and_unit

SOURCES = Path(__file__).resolve().parent / "assets"

#: Entries of run.json that are no part of the provenance: told elsewhere on the page, or the same for every run (docs/outputs.md).
TOLD = ("parameters", "alarms", "columns", "resolution")

#: What one subject adds to a page: {name: (title, figure)}; (title, ready HTML value, note); (heading, ready HTML); a dict for
#: each moment of what the page's scripts move.
Part = namedtuple("Part", "figures cards sections frames")

#: What the rest of run.json is.
PROVENANCE = "Programs, machines, times, and what was noted on the way"


def escaped(text):
    """Text safe inside HTML and attributes."""
    return html.escape(str(text), quote=True)


def code(name):
    """The name of a parameter, an entry or a column, which narrow columns break at its dots and underscores alone."""
    return "<code>" + re.sub(r"([._])(?=.)", r"\1<wbr>", escaped(name)) + "</code>"


def setting(value, digits=9):
    """A parameter or record entry as a case file would have it: numbers with at most that many digits, a dash for None."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return str(value).lower()
    if not isinstance(value, (int, float)):
        return escaped(value)
    return f"{value:.{digits}g}"


def figures(value, digits=4):
    """A measured number with exactly that many significant digits, a dash for None."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    text = grouped(value) if abs(value) >= 10**digits else f"{value:#.{digits}g}".rstrip(".")
    return with_powers(text).replace("-", "−")


def grouped(value):
    """A whole number, from five digits on in groups of three."""
    return f"{value:.0f}" if abs(value) < 1e4 else f"{value:,.0f}".replace(",", "\u2009")


def count_or_figures(value, digits=4):
    """A number without unit: as it is where it counts something, else with that many significant digits."""
    return grouped(value) if float(value).is_integer() else figures(value, digits)


def prose(text):
    """A sentence with `names` in it, as HTML."""
    return re.sub("`([^`]+)`", lambda found: code(html.unescape(found[1])), escaped(text))


def percent(value):
    """A relative difference in per cent, with its sign."""
    if value is None:
        return "–"
    if abs(value) < 1e-5:
        return "0 %" if value == 0 else "< 0.001 %"
    return f"{with_powers(f'{100 * value:+#.3g}'.rstrip('.'))} %".replace("-", "−")


def quantity(value, digits, unit):
    """A measured number with its unit; "none" when it does not exist."""
    return "none" if value is None else f'{figures(value, digits)} <span class="unit">{unit}</span>'


def page(command, heading, subtitle, warnings, cards, sections, directory):
    """A page's text. cards: [(title, ready HTML value, note)]; sections: [(heading, ready HTML)]; directory: Path."""
    return document(
        command,
        title=escaped(f"{heading}: {command}"),
        heading=escaped(heading),
        subtitle=escaped(subtitle),
        warnings=warning_box(warnings),
        cards=card_section(cards),
        sections=section_texts(sections),
        origin=f"in <code>{escaped(directory)}</code>",
        scripts=("theme.js", "study.js"),
    )


def document(command, title, heading, subtitle, sections, origin, scripts, warnings="", cards="", colours="", data="", finding=""):
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
        cards=cards,
        sections=sections,
        origin=origin,
        data=data,
        script="\n".join(source(name) for name in scripts),
    )


def source(name):
    """Text of a file in assets/."""
    return (SOURCES / name).read_text(encoding="utf-8")


def filled(template, **values):
    """The template with each {{name}} replaced once; values are not searched for names."""
    head, *rest = template.split("{{")
    pieces = [head]
    for piece in rest:
        name, after = piece.split("}}", 1)
        pieces += [values[name], after]
    return "".join(pieces)


def embedded(data):
    """JSON text for the page's scripts."""
    data = data.replace("</", "<\\/")
    return f'<script type="application/json" id="report-data">{data}</script>'


#: Points of a curve that a page's scripts move, and digits of their numbers.
POINTS, DIGITS = 90, 3


def curves(r, z, *others):
    """Lists of POINTS numbers for the page's scripts: a curve r, z (n,) and other values along it (n,) at equal arc length."""
    spacing = arc_length(r, z)[-1] / (POINTS - 1) * (1 + 1e-9)
    return [[round(float(value), DIGITS) for value in values] for values in resample(r, z, spacing, *others)]


def section_texts(sections):
    """Sections, (heading, ready HTML), as HTML."""
    return "\n".join(f"<section><h2>{escaped(title)}</h2>{body}</section>" for title, body in sections)


def warning_box(found):
    """The box of warnings; empty without any."""
    if not found:
        return ""
    items = "".join(f"<li>{escaped(text)}</li>" for text in found)
    return f'<div class="warnings" role="note"><p>Read this first</p><ul>{items}</ul></div>'


def card_section(entries):
    """The section of the key numbers, (title, ready HTML value, note) and perhaps a class; empty without any."""
    cards = "".join(
        f'<div><dt>{escaped(title)}</dt><dd class="{"".join(ink)}">{value}<small>{escaped(note)}</small></dd></div>'
        for title, value, note, *ink in entries
    )
    return f'<section aria-label="Key numbers"><dl class="cards">{cards}</dl></section>' if cards else ""


def plots(drawn, directory):
    """The static plots {name: title} in directory (Path), embedded."""
    return "\n".join(_plot(directory / f"{name}.svg", title) for name, title in drawn.items())


def _plot(path, title):
    content = base64.b64encode(path.read_bytes()).decode("ascii")
    return (
        f'<figure class="plot"><figcaption>{escaped(title)}</figcaption>'
        f'<img alt="{escaped(title)}" src="data:image/svg+xml;base64,{content}"></figure>'
    )


def table(heads, rows, kind="", marked=()):
    """A table, without a head where no column has a heading; heads and rows are ready HTML cells, the first cell being the
    row's heading. marked: numbers of rows that differ from what is expected."""
    head = "".join(f'<th scope="col">{text}</th>' for text in heads)
    head = f"<thead><tr>{head}</tr></thead>" if any(heads) else ""
    body = "".join(
        f'<tr class="{"differs" if number in marked else ""}"><th scope="row">{first}</th>'
        + "".join(f"<td>{cell}</td>" for cell in cells)
        + "</tr>"
        for number, (first, *cells) in enumerate(rows)
    )
    return (
        f'<div class="table {kind}" tabindex="0" role="region" aria-label="table">'
        f"<table>{head}<tbody>{body}</tbody></table></div>"
    )


def facts(pairs):
    """A table of (what, value), texts."""
    return table(["", ""], [[escaped(what), escaped(value)] for what, value in pairs], "text")


def folded(summary, body, unfolded=False):
    """Ready HTML that a click on its summary shows."""
    return f"<details{' open' if unfolded else ''}><summary>{escaped(summary)}</summary>{body}</details>"


def common_basis_section(basis):
    """[(heading, ready HTML)] of what many runs rest on, from words.common_basis; empty without runs."""
    return [("What the numbers rest on", facts(basis))] if basis else []


def parameters_table(parameters):
    """Parameters {"section.key": value}."""
    return table(["", "value"], [[code(key), setting(value)] for key, value in parameters.items()], "text")


def provenance_table(records, labels):
    """What run.json (dicts) says of programs, machines and times, in a column for each label."""
    flat = [flattened({key: value for key, value in record.items() if key not in TOLD}) for record in records]
    keys = dict.fromkeys(key for one in flat for key in one)
    rows = [[code(key), *(setting(one.get(key), 6) for one in flat)] for key in keys]
    return table(["", *map(escaped, labels)], rows, "text")


def heading(column):
    """A table's column as ready HTML: a parameter's key as it is, else name and unit."""
    if "." in column:
        return f"<code>{escaped(column)}</code>"
    name, unit = name_and_unit(column)
    return escaped(name if unit == "1" else f"{name} ({unit})")


def rows_table(rows, digits):
    """Rows of a CSV file, [{column: value}], but for their directories."""
    heads = [head for head in rows[0] if head != "directory"]
    return table([heading(head) for head in heads], [[setting(row[head], digits) for head in heads] for row in rows])
