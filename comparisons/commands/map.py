"""`endoflow map CASE.toml --vary section.key=low:high --vary section.key=low:high [-o DIR]`: where outcomes change.

A coarse grid of runs is refined only along the boundaries between outcomes (flat, dome, neck, bud, closed). Writes map.csv,
boundaries.csv, a plot and report.html; the runs lie in DIR/runs. Exit codes: 0 done; 2 bad command line or parameter; 3 every
run failed; 4 input or output; 130 or 143 interrupted (run it again to continue).
"""

import sys
from pathlib import Path

from comparisons.errors import BAD_INPUT, RUN_FAILED, StudyError
from comparisons.files import shown, write_text
from comparisons.studies.study import lock, program, run_members

from .options import case_parser, common_settings, output_directory, positive_integer, require_apart

#: Settings of every run unless --set gives others: a map needs neither fields nor many shapes.
LEAN = {"output.field_interval": "0"}

#: exit_reason of a branch of stationary shapes whose neck closes.
NECK_CLOSED = "neck-closed"


def parsed(arguments):
    """The command line as a namespace."""
    parser = case_parser("map", "Trace where the outcomes of runs change over two parameters.")
    parser.add_argument(
        "--vary", metavar="section.key=LOW:HIGH", action="append", required=True, help="a parameter's range; given twice"
    )
    parser.add_argument("--engine", default="boundary-integral", choices=("boundary-integral", "phase-field"))
    for name, default, what in (
        ("--cells", 4, "cells of the first grid along each axis"),
        ("--levels", 3, "times that cells along boundaries are halved"),
    ):
        parser.add_argument(
            name, metavar="N", type=positive_integer, default=default, help=f"{what} (default: {default})"
        )
    parser.add_argument(
        "--folds",
        metavar="DIR",
        type=Path,
        action="append",
        default=[],
        help="a run of `endoflow statics --continue-in` in one of the two: its folds, and where its neck closes, are drawn; "
        "may be repeated",
    )
    return parser.parse_args(arguments)


def ranges(texts):
    """[(key, low, high)] of both --vary. Raises StudyError."""
    from comparisons.studies.ranges import as_number

    found = []
    for text in texts:
        key, _, limits = text.partition("=")
        numbers = [as_number(part) for part in limits.split(":")]
        if key.count(".") < 1 or len(numbers) != 2 or None in numbers or not numbers[0] < numbers[1]:
            raise StudyError(f"--vary {text}: it must read section.key=low:high with low below high", BAD_INPUT)
        found.append((key, *numbers))
    if len(found) != 2 or found[0][0] == found[1][0]:
        raise StudyError("a map needs --vary for two parameters", BAD_INPUT)
    return found


class Runs:
    """Outcomes of points of the finest grid, by runs in directory/runs."""

    def __init__(self, options, axes, directory, interruption):
        self.options, self.axes, self.directory, self.interruption = options, axes, directory, interruption
        self.extent = options.cells * 2**options.levels
        self.rows = []

    def value(self, axis, place):
        """Value of an axis (0 or 1) at a place of the finest grid, which may be half an integer."""
        _, low, high = self.axes[axis]
        return low + (high - low) * place / self.extent

    def member(self, point):
        """The Member of a point, its parameters checked."""
        from comparisons.studies.members import Member, directory_name, resolved_parameters

        values = {key: f"{self.value(axis, point[axis]):.10g}" for axis, (key, *_) in enumerate(self.axes)}
        lean = [f"{key}={value}" for key, value in LEAN.items()]
        settings = (*lean, *common_settings(self.options), *(f"{key}={text}" for key, text in values.items()))
        parameters = resolved_parameters(program(), self.options.case, settings)
        name = directory_name(values)
        case, engine, place = self.options.case, self.options.engine, self.directory / "runs" / name
        return Member(name, case, place, engine, settings, values, parameters)

    def __call__(self, points):
        """{point: outcome}; runs what is missing. Raises KeyboardInterrupt after a signal."""
        from comparisons.studies.members import read_record
        from comparisons.studies.outcome_map import outcome_of
        from comparisons.studies.sweep_table import row

        if not points:
            return {}
        members = {point: self.member(point) for point in points}
        outcomes = run_members([*members.values()], self.options, self.interruption)
        if self.interruption.signal:
            raise KeyboardInterrupt
        found = {}
        for point, member in members.items():
            entry = row(member, outcomes.get(member.name))
            record = None if entry["state"] in ("failed", "not run") else read_record(member.directory)
            found[point] = outcome_of(record, entry["neck_radius_nm"], entry["height_nm"])
            kept = ("budding_time_us", "neck_radius_nm", "height_nm", "exit_reason", "alarms", "directory")
            values = {key: float(text) for key, text in member.values.items()}
            self.rows.append({**values, "outcome": found[point], **{name: entry[name] for name in kept}})
        return found


def static_points(directories, keys):
    """{"stationary fold" or "stationary neck closes": [(x, y)]} in runs of statics that were continued in one of the keys."""
    import endoflow

    found = {}
    for directory in directories:
        run = endoflow.load(directory)
        branch = run.record.get("notes", {}).get("branch", {})
        if branch.get("parameter") not in keys:
            raise StudyError(f"--folds {directory}: not continued in {keys[0]} or {keys[1]}", BAD_INPUT)
        other = keys[1 - keys.index(branch["parameter"])]
        section, name = other.rsplit(".", 1)
        fixed = run.parameters[section][name]
        places = [("stationary fold", fold["value"]) for fold in branch.get("folds", [])]
        if run.record.get("exit_reason") == NECK_CLOSED:
            places.append(("stationary neck closes", branch["end"]))
        for what, value in places:
            point = (value, fixed) if branch["parameter"] == keys[0] else (fixed, value)
            found.setdefault(what, []).append(point)
    return found


def write_results(runs, known, cells, folds, units, output):
    """Tables, plot and page; returns what the terminal shows."""
    from comparisons.drawing import map_plots
    from comparisons.measures.basis import common_basis
    from comparisons.page.map_page import map_html
    from comparisons.studies.members import read_record
    from comparisons.studies.outcome_map import boundaries
    from comparisons.studies.sweep_table import write_table

    keys = [key for key, *_ in runs.axes]
    rows = sorted(runs.rows, key=lambda row: [row[key] for key in keys])
    write_table(output / "map.csv", rows)
    lines = [
        {"between": " | ".join(pair), keys[0]: runs.value(0, x), keys[1]: runs.value(1, y)}
        for pair, points in boundaries(cells, known).items()
        for x, y in points
    ]
    if lines:
        write_table(output / "boundaries.csv", lines)
    labels = [f"{key} ({units[key]})" if key in units else key for key in keys]
    drawn = map_plots.write_all(rows, lines, folds, keys, labels, output)
    full = (runs.extent + 1) ** 2
    basis = common_basis([record for row in rows if (record := read_record(Path(row["directory"])))])
    write_text(output / "report.html", map_html(rows, lines, folds, keys, full, basis, drawn, output))
    outcomes = [row["outcome"] for row in rows]
    counts = ", ".join(f"{outcomes.count(name)} {name}" for name in dict.fromkeys(outcomes))
    return [
        f"runs    {len(rows)} instead of the {full} of the full grid: {counts}",
        f"table   {shown(output / 'boundaries.csv') if lines else 'no boundary: one outcome everywhere'}",
        f"report  {shown(output / 'report.html')}",
    ]


def run(options):
    """Run the command; returns its exit code."""
    from comparisons.drawing import map_plots  # noqa: F401  (a missing matplotlib must show before the runs)
    from comparisons.studies.member_runner import Interruption
    from comparisons.studies.members import parameter_units
    from comparisons.studies.outcome_map import traced

    axes, output = ranges(options.vary), output_directory(options, "map")
    require_apart(options, [key for key, *_ in axes])
    folds = static_points(options.folds, [key for key, *_ in axes])
    units = parameter_units(program())
    with lock(output), Interruption() as interruption:
        runs = Runs(options, axes, output, interruption)
        try:
            known, cells = traced(options.cells, options.levels, runs)
        except KeyboardInterrupt:
            print("endoflow map: interrupted; the same command continues", file=sys.stderr)
            return 128 + interruption.signal
        print("\n".join(write_results(runs, known, cells, folds, units, output)))
        if set(known.values()) == {"failed"}:
            raise StudyError(f"every run failed, with: {runs.rows[0]['exit_reason']}", RUN_FAILED)
        return 0
