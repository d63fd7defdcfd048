"""A sweep: lines against one varied parameter or heat maps over two, and report.html."""

import numpy as np
from matplotlib.ticker import NullFormatter, NullLocator

from comparisons.drawing import style
from comparisons.drawing.axes import say_none
from comparisons.drawing.plots import legend_on_top, panels, save
from comparisons.drawing.style import plt
from comparisons.files import as_number, write_text
from comparisons.measures.quantities import BUDDING, SWEPT
from comparisons.page import html
from comparisons.studies.members import axis_label
from comparisons.studies.sweep_table import complaints, engines_of, mixed_programs

#: Columns of sweep.csv that are drawn, with their titles; the first three make the heat maps.
QUANTITIES = {
    column: one.name if one.column == BUDDING else f"Final {one.name[0].lower()}{one.name[1:]}" for column, one in SWEPT.items()
}
MAPPED = 3

#: A parameter's axis is logarithmic when its values span more than this factor.
LOGARITHMIC_FROM = 30

#: Smallest range of a linear value axis, relative to its values.
LEAST_SPREAD = 1e-6

#: Margin around the panels, inches.
PADDING = {"w_pad": 0.08, "h_pad": 0.08}


def write_page(rows, keys, units, convention, basis, directory):
    """Write plot and report.html of a sweep's rows (as of sweep_table) over its varied keys into directory (Path).

    units: {key: unit} of keys that have one; basis: of its runs.
    """
    drawn = write_plot(rows, keys, units, directory)
    write_text(directory / "report.html", sweep_html(rows, keys, convention, basis, drawn, directory))


def write_plot(rows, keys, units, directory):
    """{name: title} of the plot, written into directory; there is none for more than two varied keys."""
    labels = [axis_label(key, units) for key in keys]
    if len(keys) == 1:
        title, figure = f"Results against {keys[0]}", lines(rows, keys[0], labels[0])
    elif len(keys) == 2:
        title, figure = f"Results over {keys[0]} and {keys[1]}", maps(rows, keys, labels)
    else:
        return {}
    save(figure, directory, "sweep")
    return {"sweep": title}


def positions(texts):
    """Where values stand on an axis (list of numbers), and whether these are the values: texts are merely counted."""
    numbers = [as_number(text) for text in texts]
    return (list(range(len(texts))), False) if None in numbers else (numbers, True)


def lines(rows, key, label):
    """Every quantity against the parameter `key`, called `label` at its axis, one line for each engine; crosses mark runs without the value."""
    texts = list(dict.fromkeys(row[key] for row in rows))
    places, numeric = positions(texts)
    place = dict(zip(texts, places))
    figure, grid = panels(len(QUANTITIES), 2.8, 3)
    for axes, (column, title) in zip(grid, QUANTITIES.items()):
        for engine in engines_of(rows):
            _draw_line(axes, [row for row in rows if row["engine"] == engine], column, key, place)
        axes.set_title(title)
        axes.margins(y=0.12)
        axes.ticklabel_format(axis="y", useOffset=False)
        keep_apart(axes)
        if not any(row[column] is not None for row in rows):
            say_none(axes, "none in any run")
    for axes in grid:
        axes.set_xlabel(label)
        _set_axis(axes, texts, places, numeric)
    _legend(figure, engines_of(rows), any(row[c] is None for row in rows for c in QUANTITIES))
    return figure


def keep_apart(axes):
    """Widen a linear value axis whose values differ by round-off alone: its ticks would show nothing but digits of that."""
    low, high = axes.get_ylim()
    middle = 0.5 * (low + high)
    if axes.get_yscale() == "linear" and high - low < LEAST_SPREAD * abs(middle):
        axes.set_ylim(middle - 0.5 * LEAST_SPREAD * abs(middle), middle + 0.5 * LEAST_SPREAD * abs(middle))


def _draw_line(axes, rows, column, key, place):
    """One engine's values; missing ones as crosses at the lower edge."""
    engine = rows[0]["engine"]
    colour = style.ENGINE_COLOURS[engine][0]
    ordered = sorted(rows, key=lambda row: place[row[key]])
    x = [place[row[key]] for row in ordered]
    y = [np.nan if row[column] is None else row[column] for row in ordered]
    axes.plot(x, y, color=colour, markeredgecolor="white", markeredgewidth=0.8, **style.LOOKS[engine])
    missing = [at for at, value in zip(x, y) if np.isnan(value)]
    crosses = axes.plot(
        missing, [0.03] * len(missing), "x", color=colour, markersize=5, transform=axes.get_xaxis_transform()
    )
    crosses[0].set_in_layout(False)


def _set_axis(axes, texts, places, numeric):
    """Scale and ticks of the varied parameter's axis."""
    if not numeric:
        axes.set_xticks(places, texts)
        axes.set_xlim(-0.4, len(texts) - 0.6)
    elif min(places) > 0 and max(places) > LOGARITHMIC_FROM * min(places):
        axes.set_xscale("log")
    if numeric and len(places) <= 8:
        axes.set_xticks(places, texts)
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_minor_formatter(NullFormatter())


def _legend(figure, engines, with_missing):
    """Names of the engines above all panels."""
    handles = [plt.Line2D([], [], color=style.ENGINE_COLOURS[engine][0], **style.LOOKS[engine]) for engine in engines]
    names = [style.ENGINE_NAMES[engine] for engine in engines]
    if with_missing:
        handles.append(plt.Line2D([], [], color="#666666", marker="x", linestyle="", markersize=5))
        names.append("no such value, or no finished run")
    legend_on_top(figure, handles, names)
    figure.get_layout_engine().set(**PADDING)


def maps(rows, keys, labels):
    """Heat maps of the first quantities over two parameters, a row for each engine; grey where there is no value."""
    (key_x, key_y), engines = keys, engines_of(rows)
    x, y = (list(dict.fromkeys(row[key] for row in rows)) for key in (key_x, key_y))
    height = 0.5 + len(engines) * (1.2 + min(3.4, max(1.4, 0.42 * len(y))))
    figure, grid = plt.subplots(len(engines), MAPPED, figsize=(12.4, height), squeeze=False, layout="constrained")
    figure.get_layout_engine().set(**PADDING)
    for line, engine in zip(grid, engines):
        own = [row for row in rows if row["engine"] == engine]
        for axes, column in zip(line, list(QUANTITIES)[:MAPPED]):
            values = np.full((len(y), len(x)), np.nan)
            for row in own:
                if row[column] is not None:
                    values[y.index(row[key_y]), x.index(row[key_x])] = row[column]
            _draw_map(axes, values, x, y)
            axes.set_title(QUANTITIES[column])
            axes.set_xlabel(labels[0])
        line[0].set_ylabel(f"{style.ENGINE_NAMES[engine]}\n\n{labels[1]}" if len(engines) > 1 else labels[1])
    return figure


def _draw_map(axes, values, x, y):
    """One map (len(y), len(x)) with its numbers written into the cells while there is room."""
    axes.set_facecolor("#DADDE1")
    picture = axes.imshow(np.ma.masked_invalid(values), origin="lower", aspect="auto", cmap="viridis")
    axes.grid(False)
    axes.set_xticks(range(len(x)), x, rotation=45 if len(x) > 6 else 0)
    axes.set_yticks(range(len(y)), y)
    if len(x) <= 8:
        for (i, j), value in np.ndenumerate(values):
            ink = "white" if np.isfinite(value) and picture.norm(value) < 0.6 else "#222222"
            axes.text(j, i, "–" if np.isnan(value) else f"{value:.3g}", ha="center", va="center", color=ink, size=8)
    if np.isfinite(values).any():
        axes.figure.colorbar(picture, ax=axes, pad=0.02).outline.set_visible(False)


def sweep_html(rows, keys, convention, basis, drawn, directory):
    """The page's text; drawn: {plot: title}."""
    mixed = [sentence] if (sentence := mixed_programs(rows)) else []
    alarmed = any(row["alarms"] for row in rows)
    subtitle = f"{len(rows)} runs · curvature convention {convention} · {'with' if alarmed else 'no'} accuracy alarms"
    sections = [("Plots", html.plots(drawn, directory))] * bool(drawn) + [("Runs", html.rows_table(rows, 5))]
    sections += html.common_basis_section(basis)
    return html.page("endoflow sweep", " and ".join(keys), subtitle, complaints(rows) + mixed, [], sections, directory)
