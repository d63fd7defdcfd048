"""report.html of a map of outcomes."""

from comparisons.page import report
from comparisons.page.numbers import escaped, setting
from comparisons.page.study_report import common_basis_section, heading, page

NOTE = (
    '<p class="note">A boundary’s point is the middle of an edge of the finest cells whose ends have different outcomes: the '
    "boundary is known to half such an edge.</p>"
)


def map_html(rows, lines, folds, keys, full, basis, drawn, directory):
    """The page; rows: of map.csv, lines: of boundaries.csv, folds: {what: [(x, y)]}, full: runs of the full grid, basis: of the runs,
    drawn: {plot: title}."""
    outcomes = [row["outcome"] for row in rows]
    cards = [(name, str(outcomes.count(name)), "runs") for name in dict.fromkeys(outcomes)]
    cards.append(("Runs", str(len(rows)), f"of {full} of the full grid"))
    found = [f"{row['directory']} failed: {row['exit_reason']}" for row in rows if row["outcome"] == "failed"]
    found += [f"{row['directory']}: accuracy alarm: {row['alarms']}" for row in rows if row["alarms"]]
    sections = [("Map", "".join(report.plot(directory / f"{name}.svg", title) for name, title in drawn.items()))]
    if lines:
        sections.append(("Boundaries", NOTE + _table(lines)))
    if folds:
        body = [(what, [setting(x, 6), setting(y, 6)]) for what, points in folds.items() for x, y in points]
        sections.append(("Stationary shapes", report.table([escaped(key) for key in keys], body)))
    sections += [("Runs", _table(rows)), *common_basis_section(basis)]
    return page("endoflow map", " and ".join(keys), f"{len(rows)} runs", found, cards, sections, directory)


def _table(rows):
    """Rows of a CSV file but for directories."""
    heads = [head for head in rows[0] if head != "directory"]
    body = [("", [setting(row[head], 6) for head in heads]) for row in rows]
    return report.table([heading(head) for head in heads], body)
