"""What `endoflow infer` shows: data with bands, posterior, what the data separate, ranks, sensitivities, and report.html."""

import numpy as np
from scipy.stats import binom, chi2

from comparisons.drawing.plots import save_all
from comparisons.drawing.style import plt
from comparisons.inference.calibration import GROUPS
from comparisons.measures.coat import COAT
from comparisons.measures.quantities import DRAWN
from comparisons.page import html
from comparisons.page.html import escaped, figures, quantity

DATA, MODEL, LINEAR = "#333333", "#0072B2", "#D55E00"

#: Bins of a histogram of samples, and fractions of the posterior that contours hold.
BINS, HELD = 40, (0.9, 0.5)

#: Paths of samples that are drawn beside pits.
PATHS = 30

#: Colours of verdicts about directions.
VERDICTS = {"fixed by the data": "#0072B2", "narrowed": "#E69F00", "not separated": "#999999"}

REGION_NOTE = (
    '<p class="note">Linearised: best fit with the 90 % interval of the covariance at it. Posterior: median with the 90 % '
    "interval of the samples. An unknown without runs acts on a finished course exactly.</p>"
)

DIRECTION_NOTE = (
    '<p class="note">Combinations of unknowns from the singular values of the sensitivities, best known first. The number '
    "compares what is left after the data with the prior: near 1 the data say nothing about it.</p>"
)


def write_fit(problem, inference, results, bands, directory):
    """Write the plots of a fit into directory (Path); returns {name: title}."""
    figures = {"infer_posterior": ("Posterior; dashed: 90 % region of the linearised fit", posterior(problem, inference))}
    if bands:
        figures["infer_data"] = ("Data with the 90 % band of the posterior", data(problem, bands))
    if pairs(problem):
        figures["infer_pits"] = ("Coats that were seen once; lines: paths of samples of the posterior", coats(problem, inference))
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
        shown = DRAWN[column]
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
        axes.set_title(DRAWN[column].label)
        axes.set_xlabel("time (µs)")
    return figure


def pairs(problem):
    """[columns that are drawn against each other]: the first one of COAT that was measured of a pit, and each other one."""
    measured = [column for column in COAT if any(column in pit.columns for pit in problem.pits)]
    return [(measured[0], other) for other in measured[1:]]


def coats(problem, inference):
    """What was measured of pits, one quantity against another, with paths of samples of the posterior."""
    drawn = pairs(problem)
    figure, grid = plt.subplots(1, len(drawn), figsize=(4.6 * len(drawn), 3.6), squeeze=False, layout="constrained")
    chosen = inference.posterior.x[np.linspace(0, len(inference.posterior.x) - 1, PATHS).astype(int)]
    batch = inference.trained.batch(chosen[:, : problem.engine_count])
    for axes, pair in zip(grid.flat, drawn):
        for number in range(PATHS):
            stages = [stage for stage in (batch.first, batch.second) if stage]
            line = (np.concatenate([stage[column][number] for stage in stages]) * COAT[column].factor for column in pair)
            axes.plot(*line, color=MODEL, alpha=0.15, linewidth=0.8)
        own = [{datum.column: datum for datum in pit.data} for pit in problem.pits]
        x, y = ([data[column] for data in own if set(pair) <= data.keys()] for column in pair)
        (across, up) = (COAT[column] for column in pair)
        axes.errorbar(
            [datum.value * across.factor for datum in x],
            [datum.value * up.factor for datum in y],
            [datum.error * up.factor for datum in y],
            [datum.error * across.factor for datum in x],
            fmt="o",
            color=DATA,
            markersize=3,
            linewidth=0.7,
        )
        axes.set(xlabel=across.label, ylabel=up.label)
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


def inference_html(results, parameters, basis, drawn, directory):
    """The page of a study's results (the dict of infer.json); parameters: flat; basis: of its runs; drawn: {plot: title}; directory: Path."""
    sections = [("Plots", html.plots(drawn, directory))] * bool(drawn)
    if "unknowns" in results:
        sections += [
            ("Unknowns", REGION_NOTE + unknowns_table(results["unknowns"])),
            ("What the data separate", DIRECTION_NOTE + directions_table(results["directions"])),
            ("Fit, samples, emulator", machinery_table(results)),
        ]
    if "calibration" in results:
        sections.append(("Calibration", calibration_table(results["calibration"])))
    if "sensitivity" in results:
        sections.append(("Sensitivity (Sobol indices)", sensitivity_table(results["sensitivity"])))
    sections += [*html.common_basis_section(basis), ("Parameters of the case", html.parameters_table(parameters))]
    study = results["study"]
    subtitle = f"Case “{study['case']}” · {study['engine']} · {results['runs']['total']} runs"
    return html.page("endoflow infer", "Parameters from data", subtitle, results["warnings"], cards(results), sections, directory)


def cards(results):
    """The key numbers on top: (title, ready HTML value, note)."""
    found = []
    for one in results.get("unknowns", [])[:4]:
        note = f"90 %: {figures(one['low'], 3)} … {figures(one['high'], 3)}"
        found.append((one["name"], quantity(one["median"], 3, escaped(one["unit"])), note))
    if "fit" in results:
        fit = results["fit"]
        found.append(("χ²", figures(fit["chi_square"], 3), f"{fit['degrees_of_freedom']} degrees of freedom"))
    for one in results.get("calibration", {}).get("coverage", []):
        note = f"of {results['calibration']['cases']} true values"
        found.append((f"In the {100 * one['level']:.0f} % region", f"{100 * one['held']:.0f} %", note))
    return found


def unknowns_table(unknowns):
    """Best fit, posterior and prior of each unknown."""
    rows = []
    for one in unknowns:
        linear = f"{figures(one['best'])} ({figures(one['linear_low'], 3)} … {figures(one['linear_high'], 3)})"
        sampled = f"{figures(one['median'])} ({figures(one['low'], 3)} … {figures(one['high'], 3)})"
        prior = f"{figures(one['prior_low'], 3)} … {figures(one['prior_high'], 3)}"
        runs = "runs" if one["needs_runs"] else "exact"
        rows.append([escaped(one["name"]), linear, sampled, prior, escaped(one["unit"] or "–"), runs])
    return html.table(["", "linearised", "posterior", "prior", "unit", "known by"], rows)


def directions_table(directions):
    """Combinations with verdicts."""
    rows = [[escaped(one["combination"]), figures(one["shrinkage"], 2), escaped(one["verdict"])] for one in directions]
    return html.table(["combination", "after the data / before", "verdict"], rows, "text")


def machinery_table(results):
    """How the fit was found and what its samples are worth."""
    fit, posterior, emulator = results["fit"], results["posterior"], results["emulator"]
    budding, check = posterior["budding_time_us"], emulator["check"]
    when = "–" if budding is None else f"{budding['median']:.4g} ({budding['low']:.4g} … {budding['high']:.4g})"
    rows = {
        "runs of the engine": f"{results['runs']['total']}, of which {results['runs']['failed']} failed",
        "best fit": f"χ² = {figures(fit['chi_square'])} for {fit['data']} data, after {fit['evaluations']} evaluations",
        "its probability": figures(fit["p_value"], 2),
        "outcome of its run": fit["outcome"],
        "budding in the data's time (µs)": when,
        "samples": f"{posterior['samples']}, {figures(posterior['effective'], 3)} of them independent",
        "acceptance": figures(posterior["acceptance"], 2),
        "emulator": f"polynomials of degree {emulator['degree']} from {emulator['runs']} runs",
        "its largest error, in those of the data": figures(emulator["error"], 2),
        "at samples against the engine": f"{figures(check['size'], 2)} (largest {figures(check['worst'], 2)})",
    }
    return html.facts(rows.items())


def calibration_table(calibration):
    """Coverage and ranks."""
    rows = [
        [
            f"truth in the {100 * one['level']:.0f} % region",
            f"{100 * one['held']:.0f} %",
            f"chance: {100 * one['by_chance_low']:.0f} … {100 * one['by_chance_high']:.0f} %",
        ]
        for one in calibration["coverage"]
    ]
    for one in calibration["ranks"]:
        groups = ", ".join(map(str, one["groups"]))
        rows.append([f"ranks of {escaped(one['unknown'])}", groups, f"p = {figures(one['p_value'], 2)}"])
    left_out = f"{calibration['left_out']} left out because their run failed or ended unlike the others"
    truth = calibration["truth"]
    drawn = f"the parameters of {escaped(truth)}, whose numbers are the data of all" if truth else "drawn from the priors"
    note = f'<p class="note">{calibration["cases"]} cases, true values: {drawn}; {left_out}.</p>'
    return note + html.table(["", "", ""], rows, "text")


def sensitivity_table(sensitivity):
    """First-order and total indices with their errors."""
    rows = []
    for entry in sensitivity:
        if not entry["unknowns"]:
            where = f"exists in {100 * entry['exists']:.0f} % of the priors"
            rows.append([escaped(entry["result"]), where, "–", "–"])
        for one in entry["unknowns"]:
            cells = [escaped(entry["result"]), escaped(one["unknown"])]
            cells += [f"{one[kind]:.3f} ± {one[kind + '_error']:.3f}" for kind in ("first", "total")]
            rows.append(cells)
    return html.table(["result", "unknown", "first order", "in all"], rows)
