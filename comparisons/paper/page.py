"""report.html of an item, and the index of all."""

from comparisons.drawing import style
from comparisons.measures.words import basis
from comparisons.page import html
from comparisons.page.html import escaped, figures, setting
from comparisons.paper import NAMES, OTHER_NAMES, item_module
from comparisons.paper.item import is_run, not_run_remarks, state_of

COMMAND = "endoflow reproduce"
SOURCE = "J. Lowengrub, J. Allard, S. Aland, J. Comput. Phys. (2016)"


def item_html(item, module, result, runs, quick, directory):
    """The page's text; module: the item's; result: item.Result, its figures saved in directory (Path)."""
    remarks = [*result.remarks, *not_run_remarks(runs)]
    sections = [
        ("The paper beside this", printed_table(result.printed)),
        ("What differs, and why", "<ul>" + "".join(f"<li>{escaped(one)}</li>" for one in remarks) + "</ul>"),
        ("Plots", html.plots({name: text for name, (text, _) in result.figures.items()}, directory)),
        ("Numbers", numbers_table(result.rows) + f'<p class="note">{escaped(item)}.csv holds them with 12 digits.</p>'),
        ("Runs", runs_table(runs)),
    ]
    subtitle = f"{getattr(module, 'SOURCE', SOURCE)} · {'quick' if quick else 'full'}"
    return html.page(f"{COMMAND} {item}", module.TITLE, subtitle, alarms(runs), [], sections, directory)


def alarms(runs):
    """A sentence for each alarm of the runs."""
    found = [(name, run) for name, engines in runs.items() for run in engines.values() if is_run(run)]
    return [f"{name}, {style.ENGINE_NAMES[run.engine]}: {alarm}" for name, run in found for alarm in run.alarms]


def engines_of(printed):
    """Engines that have an entry, in the order of style.ENGINE_NAMES; "" for numbers of no engine."""
    named = {engine for one in printed for engine in one.ours}
    return [engine for engine in ("", *style.ENGINE_NAMES) if engine in named]


def printed_table(printed):
    """What the paper says beside what was found."""
    engines = engines_of(printed)
    heads = ["", "paper", *(escaped(style.ENGINE_NAMES.get(engine, "here")) for engine in engines)]
    rows = [
        [escaped(one.what), escaped(one.paper), *(escaped(one.ours.get(engine, "–")) for engine in engines)]
        for one in printed
    ]
    return html.table(heads, rows, "text")


def numbers_table(rows):
    """The rows of the CSV file."""
    heads = [escaped(column.replace("_", " ")) for column in rows[0]]
    body = [[setting(value, 5) for value in row.values()] for row in rows]
    return f"<details><summary>{len(rows)} rows</summary>{html.table(heads, body)}</details>"


def runs_table(runs):
    """Every run: how it ended, what it cost, where it lies."""
    rows = []
    for name, engines in runs.items():
        for engine, found in engines.items():
            head = [escaped(name), escaped(style.ENGINE_NAMES[engine])]
            if not is_run(found):
                rows.append([*head, escaped(state_of(found)), "–", "–", "–", "–", "–"])
                continue
            record, (convention, resolved, alarmed) = found.record, basis(found.record).values()
            cells = [
                escaped(state_of(found)),
                setting(float(found.history["time_us"][-1]), 5),
                escaped(f"{resolved}; {convention}"),
                escaped(alarmed),
                figures(record.get("wall_s"), 3),
                f"<code>{escaped(found.directory)}</code>",
            ]
            rows.append([*head, *cells])
    return html.table(
        ["run", "engine", "ended with", "end (µs)", "resolution; curvature convention", "alarms", "wall (s)", "directory"],
        rows,
        "text",
    )


def summary_lines(item, result, directory):
    """What the terminal shows of an item."""
    lines = [f"{item}    {directory / 'report.html'}"]
    for one in result.printed:
        ours = "; ".join(f"{style.ENGINE_NAMES.get(engine, 'here')}: {value}" for engine, value in one.ours.items())
        lines.append(f"    {one.what}   paper: {one.paper}   {ours}")
    return lines


def index_html(output):
    """A page that links to every item that lies in output (Path)."""
    made = [name for name in (*NAMES, *OTHER_NAMES) if (output / name / "report.html").exists()]
    rows = []
    for name in made:
        picture = next(iter(sorted((output / name).glob("*.png"), key=lambda p: (len(p.name), p.name))), None)
        image = f'<img src="{escaped(picture.relative_to(output))}" alt="" width="320">' if picture else ""
        link = f'<a href="{escaped(name)}/report.html">{escaped(item_module(name).TITLE)}</a>'
        rows.append([link, image, f'<a href="{escaped(name)}/{escaped(name)}.csv">CSV</a>'])
    return html.page(COMMAND, "The paper, reproduced", SOURCE, [], [], [("Items", html.table(["", "", ""], rows))], output)
