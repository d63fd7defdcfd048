"""Plots of an inference: data with bands, posterior, what the data separate, ranks, sensitivities."""

import numpy as np
from scipy.stats import binom, chi2

from comparisons.drawing import style
from comparisons.drawing.plots import save_all
from comparisons.drawing.pyplot import plt
from comparisons.inference.calibration import GROUPS

DATA, MODEL, LINEAR = "#333333", "#0072B2", "#D55E00"

#: Bins of a histogram of samples, and fractions of the posterior that contours hold.
BINS, HELD = 40, (0.9, 0.5)

#: Colours of verdicts about directions.
VERDICTS = {"fixed by the data": "#0072B2", "narrowed": "#E69F00", "not separated": "#999999"}


def write_fit(problem, inference, results, bands, directory):
    """Write the plots of a fit into directory (Path); returns {name: title}."""
    figures = {"infer_posterior": ("Posterior; dashed: 90 % region of the linearised fit", posterior(problem, inference))}
    if bands:
        figures["infer_data"] = ("Data with the 90 % band of the posterior", data(problem, bands))
    figures["infer_directions"] = ("What the data separate", directions(results["directions"]))
    return save_all(figures, directory)


def write_calibration(calibration, directory):
    """Write the plot of a calibration."""
    title = "Ranks of true values; grey: 99 % of what chance does"
    return save_all({"infer_calibration": (title, ranks(calibration))}, directory)


def write_sensitivity(sensitivity, directory):
    """Write the plot of Sobol indices."""
    return save_all({"infer_sensitivity": ("Parts of the variance over the priors", sobol(sensitivity))}, directory)


def data(problem, bands):
    """Measured curves with their errors and the band of the posterior."""
    figure, grid = plt.subplots(1, len(bands), figsize=(4.6 * len(bands), 3.6), squeeze=False, layout="constrained")
    for axes, (column, (times, low, median, high)) in zip(grid.flat, bands.items()):
        shown = style.HISTORY_PLOTS[column]
        own = [datum for datum in problem.data if datum.column == column]
        axes.fill_between(times, low * shown.factor, high * shown.factor, color=MODEL, alpha=0.25, linewidth=0)
        axes.plot(times, median * shown.factor, color=MODEL)
        axes.errorbar(
            [datum.time for datum in own],
            [datum.value * shown.factor for datum in own],
            [datum.error * shown.factor for datum in own],
            fmt="o",
            color=DATA,
            markersize=3,
            linewidth=1,
        )
        axes.set_title(style.axis_label(column))
        axes.set_xlabel("time (µs)")
    return figure


def posterior(problem, inference):
    """Histograms of each unknown, samples of each pair with the ellipse of the linearised fit."""
    names, count = problem.names, len(problem.names)
    values = problem.display(inference.posterior.x)
    size = max(2.1 * count, 3.4)
    figure, grid = plt.subplots(count, count, figsize=(size + 1, size), squeeze=False, layout="constrained")
    for i in range(count):
        for j in range(count):
            axes = grid[i, j]
            if j > i:
                axes.set_axis_off()
            elif i == j:
                axes.hist(values[:, i], bins=BINS, color=MODEL, alpha=0.6)
                axes.axvline(problem.priors[i].value(inference.fit.x[i]), color=LINEAR, linewidth=1.2)
                axes.set_yticks([])
            else:
                axes.plot(values[:, j], values[:, i], ".", color=MODEL, markersize=1, alpha=0.3, rasterized=True)
                axes.plot(*_ellipse(problem, inference.fit, j, i), color=LINEAR, linewidth=1.2, linestyle="--")
            axes.locator_params(nbins=4)
            if i == count - 1:
                axes.set_xlabel(names[j])
            if j == 0 and i:
                axes.set_ylabel(names[i])
    return figure


def _ellipse(problem, fit, i, j):
    """Two arrays of values: the 90 % ellipse of unknowns i and j."""
    root = np.linalg.cholesky(fit.covariance[np.ix_((i, j), (i, j))])
    angle = np.linspace(0, 2 * np.pi, 200)
    x = np.sqrt(chi2.ppf(HELD[0], 2)) * root @ np.vstack((np.cos(angle), np.sin(angle)))
    outline = [np.clip(fit.x[k] + part, *problem.limits[k]) for k, part in zip((i, j), x)]
    return [problem.priors[k].value(part) for k, part in zip((i, j), outline)]


def directions(found):
    """How far each combination of unknowns is narrowed by the data."""
    figure, axes = plt.subplots(figsize=(8.4, 0.8 + 0.42 * len(found)), layout="constrained")
    places = np.arange(len(found))[::-1]
    axes.barh(places, [one["shrinkage"] for one in found], color=[VERDICTS[one["verdict"]] for one in found], height=0.6)
    axes.set_yticks(places, [one["combination"] for one in found])
    axes.set_xscale("log")
    axes.set_xlim(right=1.05)
    axes.set_xlabel("deviation after the data, of that before")
    return figure


def ranks(calibration):
    """A histogram of ranks for each unknown."""
    found = calibration["ranks"]
    figure, grid = plt.subplots(1, len(found), figsize=(3.4 * len(found) + 0.6, 3.0), squeeze=False, layout="constrained")
    low, high = binom.ppf((0.005, 0.995), calibration["cases"], 1 / GROUPS)
    for axes, entry in zip(grid.flat, found):
        axes.axhspan(low, high, color="#DDDDDD")
        axes.bar(np.arange(GROUPS) + 0.5, entry["groups"], width=0.9, color=MODEL)
        axes.set_title(f"{entry['unknown']}  (p = {entry['p_value']:.2g})")
        axes.set_xlabel("rank, tenths")
    return figure


def sobol(sensitivity):
    """First-order and total indices of each result."""
    found = [entry for entry in sensitivity if entry["unknowns"]]
    names = [one["unknown"] for one in found[0]["unknowns"]] if found else []
    figure, axes = plt.subplots(figsize=(8.4, 1.2 + 0.3 * max(1, len(found)) * max(1, len(names))), layout="constrained")
    places = np.arange(len(found))[::-1].astype(float)
    height = 0.8 / max(1, len(names))
    for number, name in enumerate(names):
        at = places + 0.4 - (number + 0.5) * height
        colour = f"C{number}"
        axes.barh(at, [e["unknowns"][number]["total"] for e in found], height=height, color=colour, alpha=0.35)
        axes.barh(at, [e["unknowns"][number]["first"] for e in found], height=0.5 * height, color=colour, label=name)
    axes.set_yticks(places, [entry["result"] for entry in found])
    axes.set_xlabel("first order (dark) and in all (light)")
    axes.set_xlim(0, 1.05)
    if names:
        axes.legend(loc="lower right")
    return figure
