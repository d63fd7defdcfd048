"""report.html of `endoflow infer`."""

from comparisons.page import report
from comparisons.page.numbers import escaped, figures, quantity
from comparisons.page.study_report import common_basis_section, page, parameters_table

REGION_NOTE = (
    '<p class="note">Linearised: best fit with the 90 % interval of the covariance at it. Posterior: median with the 90 % '
    "interval of the samples. An unknown without runs acts on a finished course exactly.</p>"
)

DIRECTION_NOTE = (
    '<p class="note">Combinations of unknowns from the singular values of the sensitivities, best known first. The number '
    "compares what is left after the data with the prior: near 1 the data say nothing about it.</p>"
)


def inference_html(results, parameters, basis, drawn, directory):
    """The page of a study's results (the dict of infer.json); parameters: flat; basis: of its runs; drawn: {plot: title}; directory: Path."""
    plots = "".join(report.plot(directory / f"{name}.svg", title) for name, title in drawn.items())
    sections = [("Plots", plots)] * bool(drawn)
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
    sections += [*common_basis_section(basis), ("Parameters of the case", parameters_table(parameters))]
    study = results["study"]
    subtitle = f"Case “{study['case']}” · {study['engine']} · {results['runs']['total']} runs"
    return page("endoflow infer", "Parameters from data", subtitle, results["warnings"], cards(results), sections, directory)


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
        rows.append(("", [escaped(one["name"]), linear, sampled, prior, escaped(one["unit"] or "–"), runs]))
    return report.table(["", "linearised", "posterior", "prior", "unit", "known by"], rows)


def directions_table(directions):
    """Combinations with verdicts."""
    rows = [("", [escaped(one["combination"]), figures(one["shrinkage"], 2), escaped(one["verdict"])]) for one in directions]
    return report.table(["combination", "after the data / before", "verdict"], rows, "text")


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
    return report.table(["", ""], [("", [escaped(what), escaped(value)]) for what, value in rows.items()], "text")


def calibration_table(calibration):
    """Coverage and ranks."""
    rows = [
        (
            "",
            [
                f"truth in the {100 * one['level']:.0f} % region",
                f"{100 * one['held']:.0f} %",
                f"chance: {100 * one['by_chance_low']:.0f} … {100 * one['by_chance_high']:.0f} %",
            ],
        )
        for one in calibration["coverage"]
    ]
    for one in calibration["ranks"]:
        groups = ", ".join(map(str, one["groups"]))
        rows.append(("", [f"ranks of {escaped(one['unknown'])}", groups, f"p = {figures(one['p_value'], 2)}"]))
    left_out = f"{calibration['left_out']} left out because their run failed or ended unlike the others"
    truth = calibration["truth"]
    drawn = f"the parameters of {escaped(truth)}, whose numbers are the data of all" if truth else "drawn from the priors"
    note = f'<p class="note">{calibration["cases"]} cases, true values: {drawn}; {left_out}.</p>'
    return note + report.table(["", "", ""], rows, "text")


def sensitivity_table(sensitivity):
    """First-order and total indices with their errors."""
    rows = []
    for entry in sensitivity:
        if not entry["unknowns"]:
            where = f"exists in {100 * entry['exists']:.0f} % of the priors"
            rows.append(("", [escaped(entry["result"]), where, "–", "–"]))
        for one in entry["unknowns"]:
            cells = [escaped(entry["result"]), escaped(one["unknown"])]
            cells += [f"{one[kind]:.3f} ± {one[kind + '_error']:.3f}" for kind in ("first", "total")]
            rows.append(("", cells))
    return report.table(["result", "unknown", "first order", "in all"], rows)
