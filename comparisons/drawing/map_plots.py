"""The map of outcomes over two parameters."""

from comparisons.drawing import style

style.apply()

import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)

from comparisons.drawing.plots import legend_on_top, save  # noqa: E402
from comparisons.studies.outcome_map import OUTCOMES  # noqa: E402

#: Marker and colour of each outcome (Okabe and Ito).
LOOKS = dict(zip(OUTCOMES, (("o", "#999999"), ("s", "#E69F00"), ("^", "#0072B2"), ("D", "#CC79A7"), ("x", "#D55E00"))))

#: Lines of boundaries, by the second of their outcomes.
LINE = {"linestyle": "none", "marker": ".", "markersize": 4, "color": "#222222"}


def write_all(rows, boundary_rows, folds, keys, labels, directory):
    """Write the map into directory (Path); returns {name: title}.

    rows: of map.csv, boundary_rows: of boundaries.csv; folds: [(x, y)] of stationary branches; keys, labels: of x and y.
    """
    figure, axes = plt.subplots(figsize=(9.6, 6.2), layout="constrained")
    for outcome, (marker, colour) in LOOKS.items():
        own = [row for row in rows if row["outcome"] == outcome]
        if own:
            places = [[row[key] for row in own] for key in keys]
            axes.plot(*places, marker, color=colour, markersize=4, label=outcome)
    axes.plot([row[keys[0]] for row in boundary_rows], [row[keys[1]] for row in boundary_rows], label="boundary", **LINE)
    if folds:
        axes.plot(*zip(*folds), "*", color="#009E73", markersize=11, label="stationary fold")
    axes.set_xlabel(labels[0])
    axes.set_ylabel(labels[1])
    legend_on_top(figure, *axes.get_legend_handles_labels())
    save(figure, directory, "map")
    return {"map": f"Outcomes over {keys[0]} and {keys[1]}"}
