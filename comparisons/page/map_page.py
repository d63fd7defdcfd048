"""A map of outcomes over two parameters: its picture and report.html."""

import math

import numpy as np

from comparisons.drawing.plots import save
from comparisons.drawing.style import plt
from comparisons.files import write_text
from comparisons.page import html
from comparisons.page.html import escaped, setting
from comparisons.studies.outcome_map import OUTCOMES
from comparisons.studies.sweep_table import complaints

#: Marker and colour of each outcome (Okabe and Ito).
LOOKS = dict(
    zip(
        OUTCOMES,
        (("o", "#999999"), ("p", "#56B4E9"), ("s", "#E69F00"), ("^", "#0072B2"), ("D", "#CC79A7"), ("x", "#D55E00")),
    )
)

#: Marker and colour of stationary shapes' own boundaries.
STATIC = {"stationary fold": ("*", "#009E73"), "stationary neck closes": ("P", "#009E73")}

#: The key that says how large a coat is: its axis shows the coat's area, too.
COAT = "molecules.patch_radius"

#: Lines of boundaries, by the second of their outcomes.
LINE = {"linestyle": "none", "marker": ".", "markersize": 4, "color": "#222222"}

NOTE = (
    '<p class="note">A boundary’s point is the middle of an edge of the finest cells whose ends have different outcomes: the '
    "boundary is known to half such an edge.</p>"
)


def coat_area(radius):
    """π r_c² in 1000 nm² of radii in nm, an array."""
    return math.pi * np.square(radius) / 1000


def coat_radius(area):
    """Its inverse; areas below 0, which an axis asks for, count as 0."""
    return np.sqrt(1000 * np.maximum(area, 0) / math.pi)


def write_page(rows, lines, folds, keys, labels, full, basis, directory):
    """Write the map and report.html into directory (Path).

    rows: of map.csv, lines: of boundaries.csv; folds: {name of STATIC: [(x, y)]}; keys, labels: of x and y; full: runs of the full
    grid; basis: of the runs.
    """
    save(draw(rows, lines, folds, keys, labels), directory, "map")
    drawn = {"map": f"Outcomes over {keys[0]} and {keys[1]}"}
    write_text(directory / "report.html", map_html(rows, lines, folds, keys, full, basis, drawn, directory))


def draw(rows, lines, folds, keys, labels):
    """The map."""
    figure, axes = plt.subplots(figsize=(11, 6.2), layout="constrained")
    for outcome, (marker, colour) in LOOKS.items():
        own = [row for row in rows if row["outcome"] == outcome]
        if own:
            places = [[row[key] for row in own] for key in keys]
            axes.plot(*places, marker, color=colour, markersize=4, label=outcome)
    axes.plot([row[keys[0]] for row in lines], [row[keys[1]] for row in lines], label="boundary", **LINE)
    for what, points in folds.items():
        marker, colour = STATIC[what]
        axes.plot(*zip(*points), marker, color=colour, markeredgecolor="white", markersize=10, label=what, linestyle="none")
    axes.set_xlabel(labels[0])
    axes.set_ylabel(labels[1])
    if keys[0] == COAT:
        axes.secondary_xaxis("top", functions=(coat_area, coat_radius)).set_xlabel("coat’s area (1000 nm²)")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    return figure


def map_html(rows, lines, folds, keys, full, basis, drawn, directory):
    """The page's text; drawn: {plot: title}."""
    outcomes = [row["outcome"] for row in rows]
    cards = [(name, str(outcomes.count(name)), "runs") for name in dict.fromkeys(outcomes)]
    cards.append(("Runs", str(len(rows)), f"of {full} of the full grid"))
    sections = [("Map", html.plots(drawn, directory))]
    if lines:
        sections.append(("Boundaries", NOTE + html.rows_table(lines, 6)))
    if folds:
        body = [[escaped(what), setting(x, 6), setting(y, 6)] for what, points in folds.items() for x, y in points]
        sections.append(("Stationary shapes", html.table(["", *map(escaped, keys)], body)))
    sections += [("Runs", html.rows_table(rows, 6)), *html.common_basis_section(basis)]
    return html.page("endoflow map", " and ".join(keys), f"{len(rows)} runs", complaints(rows), cards, sections, directory)
