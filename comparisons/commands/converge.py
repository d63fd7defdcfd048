"""`endoflow converge CASE.toml --epsilon 2.4,1.7,1.2,0.85 [-o DIR]`: the phase field's way to the sharp membrane.

Runs the boundary-integral engine once and the phase-field engine for each ε, then writes metrics.json, converge.csv,
plots and report.html. Exit codes: 0 done; 2 bad command line or parameter; 3 a run failed; 4 input or output; 130 or
143 interrupted (run it again to continue).
"""

import math

import endoflow
from comparisons.commands.options import common_settings, output_directory
from comparisons.errors import BAD_INPUT, RUN_FAILED, StudyError, shown
from comparisons.files import write_json, write_table
from comparisons.measures.convergence import IN_PROPORTION, DiffuseRun, study_metrics, table
from comparisons.measures.metrics import flattened
from comparisons.page import convergence_page
from comparisons.studies.members import checked_member, load_run, resolved_parameters, settings_of
from comparisons.studies.ranges import positive_numbers
from comparisons.studies.study import Study


#: Of the scheme `production`, whose defaults are not those of a study of ε: largest cells, and time.tolerance at the
#: largest ε, from where it falls with ε².
CELLS_PER_EPSILON, TOLERANCE = 1.0, 2e-5

#: To be in proportion cells may be smaller than the largest ones by this factor.
SMALLEST_CELLS = 0.66


class Convergence(Study):
    """A sharp run and phase-field runs with decreasing ε."""

    command = "converge"

    def __init__(self, options, output):
        super().__init__(options, output)
        self.times = sorted(positive_numbers(options.times, "--times")) if options.times else []
        self.sharp, self.diffuse = None, []

    def members(self):
        """The sharp run, then the phase field's in order of decreasing ε."""
        options, base = self.options, common_settings(self.options)
        own = resolved_parameters(options.case, base)
        given = [setting.partition("=")[0] for setting in base]
        production = own["phase_field"]["scheme"] == "production"
        ratio = own["phase_field"]["cell_size"] / own["phase_field"]["epsilon"]
        if options.cells_per_epsilon is not None:
            ratio = 1 / positive_numbers(options.cells_per_epsilon, "--cells-per-epsilon")[0]
        name = "boundary-integral"
        self.sharp = checked_member(name, options.case, self.output / name, name, base)
        layers = sorted(positive_numbers(options.epsilon, "--epsilon"), reverse=True)
        sizes = {epsilon: ratio * epsilon for epsilon in layers}
        if production and ratio == 0:
            sizes = cells_in_proportion(own, layers)
        for epsilon, size in sizes.items():
            values = {"phase_field.epsilon": f"{epsilon:.12g}", "phase_field.cell_size": f"{size:.12g}"}
            if production:
                tolerance = (own["time"]["tolerance"] or TOLERANCE) * (epsilon / layers[0]) ** 2
                values["time.tolerance"] = f"{tolerance:.6g}"
                if "phase_field.production.thinning" not in given:
                    values["phase_field.production.thinning"] = "0"
            name, settings = f"epsilon={epsilon:.12g}", (*base, *settings_of(values))
            self.diffuse.append(checked_member(name, options.case, self.output / name, "phase-field", settings, values))
        return [self.sharp, *self.diffuse]

    def evaluate(self, outcomes):
        """(sharp endoflow.Run, [DiffuseRun], metrics). Raises StudyError when there is nothing to compare."""
        runs, problems = {}, []
        for member in (self.sharp, *self.diffuse):
            try:
                runs[member.name] = load_run(member)
            except (endoflow.EndoflowError, StudyError) as error:
                problems.append(f"{member.name} is left out: {error}")
        kept = [
            DiffuseRun(member.parameters["phase_field"]["epsilon"], runs[member.name])
            for member in self.diffuse
            if member.name in runs
        ]
        if self.sharp.name not in runs or not kept:
            raise StudyError(f"nothing to compare: {problems[0]}", RUN_FAILED)
        metrics = study_metrics(runs[self.sharp.name], kept, self.times)
        if not metrics["records"]:
            raise StudyError("nothing to compare: no run covers the times asked for; choose other --times", BAD_INPUT)
        metrics["warnings"] = problems + metrics["warnings"]
        write_json(self.output / "metrics.json", metrics)
        write_table(self.output / "converge.csv", table(metrics))
        return runs[self.sharp.name], kept, metrics

    def page(self, found):
        sharp, kept, metrics = found
        case = {key: value for key, value in flattened(self.sharp.parameters).items() if key not in self.diffuse[0].values}
        convergence_page.write_page(sharp, kept, metrics, case, self.output)
        self.warn(metrics["warnings"])
        return summary_lines(metrics, self.output)


def filling(size, parameters):
    """The cells of the mesh [nm] for this phase_field.cell_size, as phasefield/fem/mesh.cpp makes them: whole coarse
    cells, each halved some times, fill the box's radius."""
    radius = parameters["domain"]["radius"]
    halvings = parameters["phase_field"]["far_refinements"] + max(0, math.floor(math.log2(radius / (48 * size))))
    coarse = size * 2**halvings
    return radius / max(1, round(radius / coarse)) / 2**halvings


def cells_in_proportion(parameters, layers):
    """{ε: cell size in nm}: cells of at most one ε that fill the box in one proportion to all ε, the largest ones, or
    those nearest to that. Were they rounded each for itself, by up to 6 %, what the cells change would be taken for a
    part of ε's order."""
    if parameters["domain"]["kind"] != "box":
        return {epsilon: epsilon / CELLS_PER_EPSILON for epsilon in layers}
    steps, best, least = 100, None, math.inf
    for step in range(steps + 1):
        part = (1 - (1 - SMALLEST_CELLS) * step / steps) / CELLS_PER_EPSILON
        found = {epsilon: filling(part * epsilon, parameters) for epsilon in layers}
        proportions = [size / epsilon for epsilon, size in found.items()]
        spread = max(proportions) / min(proportions) - 1
        if max(proportions) <= (1 + IN_PROPORTION) / CELLS_PER_EPSILON and spread < least:
            best, least = found, spread
            if spread <= IN_PROPORTION:
                break
    return best


def summary_lines(metrics, output):
    """What the terminal shows at the end, as a list of lines."""
    last = metrics["times_us"][-1]
    lines = []
    for entry in metrics["orders"]:
        if entry["time_us"] in (last, None):
            spread = "" if entry["low"] is None else f"   95 %: {entry['low']:.2f} to {entry['high']:.2f}"
            lines.append(f"order  {entry['quantity']:26} {entry['order']:6.2f}{spread}")
    for entry in metrics["limits"]:
        if entry["time_us"] in (last, None) and entry["value"] is not None and entry["sharp"] is not None:
            value = f"{entry['value']:.6g} ± {entry['error']:.2g}"
            lines.append(f"limit  {entry['quantity']:26} {value:>22}   sharp: {entry['sharp']:.6g}")
    return [f"at {last:.4g} µs:", *lines, f"report {shown(output / 'report.html')}"]


def run(options):
    """Run the command; returns its exit code."""
    return Convergence(options, output_directory(options, "converge")).conduct()
