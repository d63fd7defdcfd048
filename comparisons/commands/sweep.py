"""`endoflow sweep CASE.toml --vary section.key=start:stop:step --engine E [-o DIR]`: many runs of one case.

Writes sweep.csv, plots and report.html. Exit codes: 0 done; 2 bad command line or parameter; 3 a run failed; 4 input or
output; 130 or 143 interrupted (run it again to continue).
"""

import sys
from pathlib import Path

from comparisons.errors import RUN_FAILED
from comparisons.files import shown, write_text
from comparisons.studies.study import lock, program, report_failures, run_members

from .options import case_parser, common_settings, output_directory, require_apart


def parsed(arguments):
    """The command line as a namespace."""
    parser = case_parser("sweep", "Run a case with many values of some parameters.")
    parser.add_argument(
        "--vary",
        metavar="section.key=VALUES",
        action="append",
        required=True,
        help="start:stop:step (stop included) or value,value,...; may be repeated for all combinations",
    )
    parser.add_argument("--engine", required=True, choices=("boundary-integral", "phase-field", "both"))
    what = parser.add_mutually_exclusive_group()
    what.add_argument(
        "--slurm", action="store_true", help="write DIR/sweep.sbatch for the unfinished runs; run nothing"
    )
    what.add_argument("--collect", action="store_true", help="make the table and plots of what is there; run nothing")
    return parser.parse_args(arguments)


def sweep_members(options, output):
    """Every member (members.Member), its parameters checked."""
    from comparisons.studies.members import ENGINES, Member, directory_name, resolved_parameters
    from comparisons.studies.ranges import combinations, parsed_variation

    engines = ENGINES if options.engine == "both" else (options.engine,)
    members = []
    variations = [parsed_variation(text) for text in options.vary]
    require_apart(options, [key for key, _ in variations])
    for values in combinations(variations):
        settings = (*common_settings(options), *(f"{key}={value}" for key, value in values.items()))
        parameters = resolved_parameters(program(), options.case, settings)
        for engine in engines:
            name = f"{directory_name(values)}/{engine}"
            members.append(Member(name, options.case, output / name, engine, settings, values, parameters))
    return members


def write_slurm(members, options, output):
    """Write DIR/sweep.sbatch for what is left to do; returns what to tell the user."""
    from comparisons.studies.members import FINISHED, run_command, work_left
    from comparisons.studies.slurm import array_script

    left = [(work_left(member), member) for member in members]
    entries = [
        (work, member.directory, run_command('"$endoflow"', member, "", options.processes))
        for work, member in left
        if work != FINISHED
    ]
    if not entries:
        return f"all {len(members)} runs are finished: nothing to submit"
    script = output / "sweep.sbatch"
    text = array_script(
        entries, options.case.stem, script, Path.cwd(), program(), options.processes, threads=1, jobs=options.jobs
    )
    write_text(script, text)
    return f"{len(entries)} of {len(members)} runs left: sbatch {script}; afterwards the same command with --collect"


def collect(members, outcomes, output):
    """Write the table; returns its rows."""
    from comparisons.studies.sweep_table import row, write_table

    rows = [row(member, outcomes.get(member.name)) for member in members]
    write_table(output / "sweep.csv", rows)
    return rows


def summary_lines(rows, output):
    """What the terminal shows at the end, as a list of lines."""
    states = [row["state"] for row in rows]
    counts = ", ".join(f"{states.count(state)} {state}" for state in dict.fromkeys(states))
    return [f"runs    {counts}", f"table   {shown(output / 'sweep.csv')}", f"report  {shown(output / 'report.html')}"]


def run(options):
    """Run the command; returns its exit code."""
    from comparisons.studies.member_runner import Interruption

    output = output_directory(options, "sweep")
    members = sweep_members(options, output)
    from comparisons.drawing import sweep_plots  # a missing matplotlib must show before the runs
    from comparisons.measures.basis import common_basis
    from comparisons.page.study_report import sweep_html
    from comparisons.studies.members import parameter_units, read_record
    from comparisons.studies.sweep_table import mixed_programs

    units = parameter_units(program())
    with lock(output):
        if options.slurm:
            print(write_slurm(members, options, output))
            return 0
        outcomes = {}
        if not options.collect:
            with Interruption() as interruption:
                outcomes = run_members(members, options, interruption)
            if interruption.signal:
                collect(members, outcomes, output)
                print("endoflow sweep: interrupted; the same command continues", file=sys.stderr)
                return 128 + interruption.signal
        rows = collect(members, outcomes, output)
        if mixed := mixed_programs(rows):
            print(f"endoflow sweep: warning: {mixed}", file=sys.stderr)
        keys = [*members[0].values]
        records = [record for member in members if (record := read_record(member.directory))]
        used = dict.fromkeys(member.parameters["membrane"]["curvature_convention"] for member in members)
        convention = " and ".join(used)
        drawn = sweep_plots.write_all(rows, keys, units, output)
        write_text(output / "report.html", sweep_html(rows, keys, convention, common_basis(records), drawn, output))
        print("\n".join(summary_lines(rows, output)))
        return RUN_FAILED if report_failures("sweep", outcomes) else 0
