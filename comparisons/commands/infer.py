"""`endoflow infer STUDY.toml [-o DIR]`: parameters from measured or simulated data.

Writes infer.json, posterior.csv, predictive.csv, plots and report.html; the runs lie in DIR/runs. Exit codes: 0 done; 2 bad
command line, study or parameter; 3 no run succeeded, or too few alike; 4 input or output; 130 or 143 interrupted (run it
again to continue).
"""

import argparse
import sys
from pathlib import Path

from comparisons.errors import BAD_INPUT, StudyError
from comparisons.files import write_json, write_text
from comparisons.studies.study import lock, program

from .options import positive_integer, runs_parser

#: A fraction of a prior that gives no whole number: a parameter that must be one is no unknown.
WITHIN = 0.381966

#: Samples in posterior.csv.
WRITTEN_SAMPLES = 4000


class Keys(argparse.Action):
    """Prints the keys of a study and ends, as --help does."""

    def __init__(self, option_strings, dest, **how):
        super().__init__(option_strings, argparse.SUPPRESS, nargs=0, **how)

    def __call__(self, parser, *_):
        from comparisons.inference.study_keys import documentation

        print(documentation(), end="")
        parser.exit()


def parsed(arguments):
    """The command line as a namespace."""
    description = "Infer parameters from data: best fit, posterior, what the data separate."
    parser = runs_parser("infer", description, "out/STUDY/infer")
    parser.add_argument("--keys", action=Keys, help="print every key of a study as a table and end")
    parser.add_argument("study", metavar="STUDY.toml", type=Path, help="case, unknowns with priors, data with errors")
    parser.add_argument(
        "--calibrate", metavar="N", type=positive_integer, help="do N cases with known truth as well: ranks and coverage"
    )
    parser.add_argument(
        "--truth", metavar="DIR", type=Path, help="--calibrate with data from this run of either engine, its parameters being true"
    )
    parser.add_argument(
        "--sensitivity", action="store_true", help="Sobol indices of budding time, neck and diameter as well"
    )
    return parser.parse_args(arguments)


def calibration(problem, simulator, trained, options, say):
    """The entry `calibration` of infer.json."""
    from comparisons.inference.calibration import calibrate, summary, truth_of_run, truths

    count, seed = options.calibrate, problem.study.seed + 100
    if options.truth:
        x, course = truth_of_run(problem, options.truth)
        truth, courses = [x] * count, [course] * count
    else:
        truth = truths(problem, count, seed)
        say(f"calibration: {count} run(s) with true values drawn from the priors")
        courses = simulator.courses(truth[:, : problem.engine_count])
    say(f"calibration: {count} posteriors on the emulator")
    kept = []
    for number, (x, course) in enumerate(zip(truth, courses)):
        simulator.stop_if_interrupted()
        case = calibrate(problem, trained, x, course, seed + 1 + number)
        kept += [case] if case is not None else []
    if not kept:
        raise StudyError("no calibration case ends as the emulator's runs do; narrow the priors", BAD_INPUT)
    return {
        **summary(problem, kept),
        "left_out": count - len(kept),
        "truth": str(options.truth) if options.truth else None,
    }


def fill(results, problem, simulator, options, units, output):
    """Do what is asked, put it into the dict of infer.json, and write tables and plots; returns {plot: title}."""
    from comparisons.drawing import inference_plots
    from comparisons.inference import pipeline
    from comparisons.inference.results import bands, fit_results
    from comparisons.inference.sensitivity import indices

    def say(text):
        simulator.stop_if_interrupted()
        print(text, flush=True)

    drawn = {}
    if problem.data:
        inference = pipeline.infer(problem, simulator, say)
        results |= fit_results(problem, inference, units)
        found = bands(problem, inference)
        write_tables(problem, inference, found, output)
        drawn |= inference_plots.write_fit(problem, inference, results, found, output)
    if options.calibrate or options.sensitivity:
        trained = pipeline.over_priors(problem, simulator, say)
        if options.calibrate:
            results["calibration"] = calibration(problem, simulator, trained, options, say)
            drawn |= inference_plots.write_calibration(results["calibration"], output)
        if options.sensitivity:
            results["sensitivity"] = indices(problem, trained, problem.study.seed)
            drawn |= inference_plots.write_sensitivity(results["sensitivity"], output)
    return drawn


def write_tables(problem, inference, bands, output):
    """posterior.csv and predictive.csv."""
    import numpy as np

    from comparisons.studies.sweep_table import write_table

    x = inference.posterior.x
    chosen = problem.display(x[np.linspace(0, len(x) - 1, min(len(x), WRITTEN_SAMPLES)).astype(int)])
    write_table(output / "posterior.csv", [dict(zip(problem.names, map(float, row))) for row in chosen])
    rows = []
    for column, curves in bands.items():
        for row in zip(*curves):
            numbers = (None if np.isnan(value) else float(value) for value in row)
            rows.append({"column": column, **dict(zip(("time_us", "low", "median", "high"), numbers))})
    if rows:
        write_table(output / "predictive.csv", rows)


def summary_lines(results, output):
    """What the terminal shows at the end, as a list of lines."""
    lines = []
    for one in results.get("unknowns", []):
        unit = f" {one['unit']}" if one["unit"] else ""
        lines.append(f"{one['name']:28} {one['median']:.4g} ({one['low']:.4g} … {one['high']:.4g}){unit}")
    for one in results.get("directions", []):
        if one["verdict"] == "not separated":
            lines.append(f"not separated by the data: {one['combination']}")
    for one in results.get("calibration", {}).get("coverage", []):
        lines.append(f"true values in the {100 * one['level']:.0f} % region: {100 * one['held']:.0f} %")
    return [*lines, f"report  {output / 'report.html'}"]


def resolved(study, settings=()):
    """Parameters of a study's case with its own and other settings. Raises StudyError that begins with the study's path."""
    from comparisons.inference.simulator import settings_of
    from comparisons.studies.members import resolved_parameters

    try:
        return resolved_parameters(program(), study.case, [*settings_of(study.settings), *settings])
    except StudyError as error:
        raise StudyError(f"{study.path}: {error}", error.exit_code) from None


def check_limits(problem):
    """Raises StudyError where a run at a limit of an unknown's prior or within it, the others in their middle, is refused."""
    import numpy as np

    priors = problem.priors[: problem.engine_count]
    middle = np.array([prior.from_fraction(0.5) for prior in priors])
    for number, prior in enumerate(priors):
        for tried in (prior.lowest, prior.highest, prior.from_fraction(WITHIN)):
            point = middle.copy()
            point[number] = tried
            own = problem.settings(point)
            try:
                resolved(problem.study, [f"{key}={text}" for key, text in own.items()])
            except StudyError as error:
                said = str(error).removeprefix(f"{problem.study.path}: ")
                what = f"its prior allows {float(prior.value(tried)):.6g}, but {said}"
                raise StudyError(f"{problem.study.path}: unknown {problem.names[number]}: {what}", error.exit_code) from None


def run(options):
    """Run the command; returns its exit code."""
    from comparisons.inference.problem import Problem
    from comparisons.inference.results import warnings
    from comparisons.inference.simulator import Interrupted, Simulator
    from comparisons.inference.study_file import read_study
    from comparisons.measures.basis import common_basis
    from comparisons.measures.metrics import flat_parameters
    from comparisons.page.inference_page import inference_html
    from comparisons.studies.member_runner import Interruption
    from comparisons.studies.members import parameter_units, read_record

    study = read_study(options.study)
    if not study.data and not study.contours and not options.sensitivity:
        raise StudyError(f"{options.study}: needs [[data]], or --sensitivity, which does without", BAD_INPUT)
    if options.calibrate and not (study.data or study.contours):
        raise StudyError(f"{options.study}: --calibrate needs [[data]] for times and errors", BAD_INPUT)
    if options.truth and not options.calibrate:
        raise StudyError("--truth needs --calibrate N: how often regions hold it", BAD_INPUT)
    output = options.output or Path("out") / options.study.stem / "infer"
    parameters = resolved(study)
    problem, units = Problem(study, parameters), parameter_units(program())
    check_limits(problem)
    with lock(output), Interruption() as interruption:
        simulator = Simulator(problem, program(), output, options.jobs, options.processes, interruption)
        results = {
            "schema_version": 1,
            "study": {
                "file": str(options.study),
                "case": parameters["case"]["name"],
                "engine": study.engine,
                "seed": study.seed,
            },
        }
        try:
            drawn = fill(results, problem, simulator, options, units, output)
        except Interrupted as stopped:
            print("endoflow infer: interrupted; the same command continues", file=sys.stderr)
            return 128 + stopped.number
        alarms = [*simulator.alarmed.values()]
        results["runs"] = {
            "total": len(simulator.courses_by_name),
            "failed": len(simulator.failures),
            "alarmed": len(alarms),
            "first_alarm": alarms[0] if alarms else None,
        }
        results["warnings"] = warnings(results)
        write_json(output / "infer.json", results)
        records = [record for member in simulator.members.values() if (record := read_record(member.directory))]
        flat = {key: value for key, value in flat_parameters(parameters).items() if key.split(".")[0] != "phase_field"}
        write_text(output / "report.html", inference_html(results, flat, common_basis(records), drawn, output))
        for warning in results["warnings"]:
            print(f"endoflow infer: warning: {warning}", file=sys.stderr)
        print("\n".join(summary_lines(results, output)))
        return 0
