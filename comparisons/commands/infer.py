"""`endoflow infer STUDY.toml [-o DIR]`: parameters from measured or simulated data.

Writes infer.json, posterior.csv, predictive.csv, plots and report.html; the runs lie in DIR/runs. Exit codes: 0 done; 2 bad
command line, study or parameter; 3 no run succeeded, or too few alike; 4 input or output; 130 or 143 interrupted (run it
again to continue).
"""

from pathlib import Path

from comparisons.errors import BAD_INPUT, StudyError
from comparisons.files import write_json, write_text
from comparisons.inference import page, pipeline
from comparisons.inference.calibration import calibration
from comparisons.inference.problem import Problem
from comparisons.inference.results import bands, fit_results, head, runs_entry, warnings, write_tables
from comparisons.inference.sensitivity import indices
from comparisons.inference.simulator import Simulator, check_limits, resolved
from comparisons.inference.study_file import read_study
from comparisons.measures.metrics import flattened
from comparisons.measures.words import common_basis
from comparisons.studies.members import parameter_units, records_of
from comparisons.studies.study import Study


class Inference(Study):
    """Runs at parameters that the data ask for."""

    command = "infer"
    failures_are_results = True

    def __init__(self, options, output):
        super().__init__(options, output)
        study = read_study(options.study)
        measured = study.data or study.contours or study.pits
        if not measured and not options.sensitivity:
            raise StudyError(f"{options.study}: needs [[data]], or --sensitivity, which does without", BAD_INPUT)
        if options.calibrate and not measured:
            raise StudyError(f"{options.study}: --calibrate needs [[data]] for times and errors", BAD_INPUT)
        if options.truth and not options.calibrate:
            raise StudyError("--truth needs --calibrate N: how often regions hold it", BAD_INPUT)
        self.problem, self.units, self.drawn = Problem(study, resolved(study)), parameter_units(), {}
        check_limits(self.problem)
        self.simulator = Simulator(self.problem, self)

    def announce(self, work, seconds):
        """Nothing: each stage says what it runs."""

    def say(self, text):
        self.stop_if_interrupted()
        super().say(text)

    def evaluate(self, outcomes):
        """infer.json as a dict; does what is asked and draws it."""
        problem, simulator, options, output = self.problem, self.simulator, self.options, self.output
        results = head(problem, options.study)
        if problem.data:
            inference = pipeline.infer(problem, simulator, self.say)
            results |= fit_results(problem, inference, self.units)
            found = bands(problem, inference)
            write_tables(problem, inference, found, output)
            self.drawn |= page.write_fit(problem, inference, results, found, output)
        if options.calibrate or options.sensitivity:
            trained = pipeline.over_priors(problem, simulator, self.say)
        if options.calibrate:
            results["calibration"] = calibration(problem, simulator, trained, options.calibrate, options.truth, self.say)
            self.drawn |= page.write_calibration(results["calibration"], output)
        if options.sensitivity:
            results["sensitivity"] = indices(problem, trained, problem.study.seed)
            self.drawn |= page.write_sensitivity(results["sensitivity"], output)
        results["runs"] = runs_entry(simulator)
        results["warnings"] = warnings(results)
        write_json(output / "infer.json", results)
        return results

    def page(self, results):
        flat = flattened(self.problem.parameters)
        flat = {key: value for key, value in flat.items() if not key.startswith("phase_field.")}
        basis, path = common_basis(records_of(self.simulator.members.values())), self.output / "report.html"
        write_text(path, page.inference_html(results, flat, basis, self.drawn, self.output))
        self.warn(results["warnings"])
        return [*summary_lines(results), f"report  {path}"]


def summary_lines(results):
    """What the terminal shows of infer.json (a dict), as a list of lines."""
    lines = []
    for one in results.get("unknowns", []):
        unit = f" {one['unit']}" if one["unit"] else ""
        lines.append(f"{one['name']:28} {one['median']:.4g} ({one['low']:.4g} … {one['high']:.4g}){unit}")
    for one in results.get("directions", []):
        if one["verdict"] == "not separated":
            lines.append(f"not separated by the data: {one['combination']}")
    for one in results.get("calibration", {}).get("coverage", []):
        lines.append(f"true values in the {100 * one['level']:.0f} % region: {100 * one['held']:.0f} %")
    return lines


def run(options):
    """Run the command; returns its exit code."""
    return Inference(options, options.output or Path("out") / options.study.stem / "infer").conduct()
