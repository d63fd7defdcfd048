"""`endoflow converge CASE.toml --epsilon 2.4,1.7,1.2,0.85 [-o DIR]`: the phase field's way to the sharp membrane.

Runs the boundary-integral engine once and the phase-field engine for each ε, then writes metrics.json, converge.csv,
plots and report.html. Exit codes: 0 done; 2 bad command line or parameter; 3 a run failed; 4 input or output; 130 or
143 interrupted (run it again to continue).
"""

import sys

from comparisons.errors import BAD_INPUT, RUN_FAILED, StudyError
from comparisons.files import shown, write_json, write_text
from comparisons.studies.study import lock, program, report_failures, run_members

from .options import case_parser, common_settings, output_directory


def parsed(arguments):
    """The command line as a namespace."""
    parser = case_parser("converge", "Compare phase-field runs of decreasing ε with the sharp membrane.")
    parser.add_argument("--epsilon", metavar="E1,E2,...", required=True, help="values of phase_field.epsilon in nm")
    parser.add_argument(
        "--cells-per-epsilon",
        metavar="X",
        help="phase_field.cell_size = ε/X (default: the case's ratio, or the scheme's)",
    )
    parser.add_argument(
        "--times", metavar="T1,T2,...", help="times of the comparison in µs (default: four, evenly chosen)"
    )
    return parser.parse_args(arguments)


def positive_numbers(text, option):
    """The numbers of a comma list or range, all positive."""
    from comparisons.studies.ranges import RangeError, as_number, parsed_values

    numbers = [as_number(value) for value in parsed_values(text, f"{option} {text}")]
    if any(number is None or number <= 0 for number in numbers):
        raise RangeError(f"{option} {text}: positive numbers separated by commas are needed")
    return numbers


def study_members(options, output):
    """(sharp Member, [phase-field Members] in order of decreasing ε), their parameters checked."""
    from comparisons.studies.members import Member, resolved_parameters

    base = common_settings(options)
    case = resolved_parameters(program(), options.case, base)
    own = case["phase_field"]
    ratio = own["cell_size"] / own["epsilon"]
    if options.cells_per_epsilon is not None:
        ratio = 1 / positive_numbers(options.cells_per_epsilon, "--cells-per-epsilon")[0]
    name = "boundary-integral"
    sharp = Member(name, options.case, output / name, name, tuple(base), {}, case)
    diffuse = []
    for epsilon in sorted(positive_numbers(options.epsilon, "--epsilon"), reverse=True):
        values = {"phase_field.epsilon": f"{epsilon:.12g}", "phase_field.cell_size": f"{ratio * epsilon:.12g}"}
        settings = (*base, *(f"{key}={value}" for key, value in values.items()))
        name = f"epsilon={epsilon:.12g}"
        parameters = resolved_parameters(program(), options.case, settings)
        diffuse.append(Member(name, options.case, output / name, "phase-field", settings, values, parameters))
    return sharp, diffuse


def loaded(members):
    """(runs {name: endoflow.Run}, [problem]) of the members whose directories can be read and hold their parameters."""
    import endoflow
    from comparisons.studies.members import covers, differing_parameters

    runs, problems = {}, []
    for member in members:
        try:
            run = endoflow.load(member.directory)
        except endoflow.EndoflowError as error:
            problems.append(f"{member.name} is left out: {error}")
            continue
        if covers(run.record, member):
            run = run.until(member.end)
        elif differing_parameters(run.parameters, member.parameters, member.engine):
            problems.append(f"{member.name} is left out: {member.directory} holds a run with other parameters")
            continue
        runs[member.name] = run
    return runs, problems


def write_results(sharp, diffuse, times, output):
    """Write everything that is made from the members' runs; returns the metrics.

    Raises StudyError when there is nothing to compare.
    """
    from comparisons.drawing import study_plots
    from comparisons.measures.convergence import DiffuseRun, study_metrics, table
    from comparisons.measures.metrics import flat_parameters
    from comparisons.page.study_report import convergence_html
    from comparisons.studies.sweep_table import write_table

    runs, problems = loaded([sharp, *diffuse])
    pairs = [(member, runs[member.name]) for member in diffuse if member.name in runs]
    if sharp.name not in runs or not pairs:
        raise StudyError(f"nothing to compare: {problems[0]}", RUN_FAILED)
    kept = [DiffuseRun(member.parameters["phase_field"]["epsilon"], run) for member, run in pairs]
    metrics = study_metrics(runs[sharp.name], kept, times)
    if not metrics["records"]:
        raise StudyError("nothing to compare: no run covers the times asked for; choose other --times", BAD_INPUT)
    metrics["warnings"] = problems + metrics["warnings"]
    write_json(output / "metrics.json", metrics)
    write_table(output / "converge.csv", table(metrics))
    drawn = study_plots.write_all(runs[sharp.name], kept, metrics, output)
    shared = {k: v for k, v in flat_parameters(sharp.parameters).items() if k not in diffuse[0].values}
    case = sharp.parameters["case"]["name"]
    write_text(output / "report.html", convergence_html(metrics, case, shared, drawn, output))
    return metrics


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
    from comparisons.studies.member_runner import Interruption

    output = output_directory(options, "converge")
    times = sorted(positive_numbers(options.times, "--times")) if options.times else []
    sharp, diffuse = study_members(options, output)
    from comparisons.drawing import study_plots  # noqa: F401  (a missing matplotlib must show before the runs)

    with lock(output):
        with Interruption() as interruption:
            outcomes = run_members([sharp, *diffuse], options, interruption)
        if interruption.signal:
            print("endoflow converge: interrupted; the same command continues", file=sys.stderr)
            return 128 + interruption.signal
        failed = report_failures("converge", outcomes)
        metrics = write_results(sharp, diffuse, times, output)
        for warning in metrics["warnings"]:
            print(f"endoflow converge: warning: {shown(warning)}", file=sys.stderr)
        print("\n".join(summary_lines(metrics, output)))
        return RUN_FAILED if failed else 0
