"""`endoflow map CASE.toml --vary section.key=low:high --vary section.key=low:high [-o DIR]`: where outcomes change.

A coarse grid of runs is refined only along the boundaries between outcomes (flat, dome, neck, bud, closed). Writes map.csv,
boundaries.csv, a plot and report.html; the runs lie in DIR/runs. Exit codes: 0 done; 2 bad command line or parameter; 3 every
run failed; 4 input or output; 130 or 143 interrupted (run it again to continue).
"""

import endoflow
from comparisons.commands.options import common_settings, output_directory, require_apart
from comparisons.errors import BAD_INPUT, RUN_FAILED, StudyError, shown
from comparisons.files import write_table
from comparisons.measures.words import common_basis, counted
from comparisons.page import map_page
from comparisons.studies.members import (
    NECK_CLOSED,
    axis_label,
    checked_member,
    directory_name,
    parameter_units,
    read_record,
    records_of,
    settings_of,
)
from comparisons.studies.outcome_map import boundaries, outcome_of, traced
from comparisons.studies.ranges import two_intervals
from comparisons.studies.study import Study
from comparisons.studies.sweep_table import row

#: Settings of every run unless --set gives others: a map needs neither fields nor many shapes.
LEAN = ("output.field_interval=0",)

#: Columns of map.csv beside the two parameters and the outcome.
KEPT = ("budding_time_us", "neck_radius_nm", "bud_height_nm", "exit_reason", "alarms", "directory")


class OutcomeMap(Study):
    """Outcomes of runs at points of the finest grid over two parameters."""

    command = "map"
    failures_are_results = True

    def __init__(self, options, output):
        super().__init__(options, output)
        self.axes = two_intervals(options.vary)
        self.keys = [key for key, *_ in self.axes]
        require_apart(options, self.keys)
        self.folds, self.units = static_points(options.folds, self.keys), parameter_units()
        self.extent = options.cells * 2**options.levels
        self.all, self.rows = [], []

    def value(self, axis, place):
        """Value of an axis (0 or 1) at a place of the finest grid, which may be half an integer."""
        _, low, high = self.axes[axis]
        return low + (high - low) * place / self.extent

    def member(self, point):
        """The Member of a point, its parameters checked."""
        options = self.options
        values = {key: f"{self.value(axis, point[axis]):.10g}" for axis, key in enumerate(self.keys)}
        settings, name = (*LEAN, *common_settings(options), *settings_of(values)), directory_name(values)
        return checked_member(name, options.case, self.output / "runs" / name, options.engine, settings, values)

    def outcomes(self, points):
        """{point: outcome}; runs what is missing."""
        members = {point: self.member(point) for point in points}
        outcomes = self.run([*members.values()]) if members else {}
        self.all += members.values()
        found = {}
        for point, member in members.items():
            entry = row(member, outcomes.get(member.name))
            record = None if entry["state"] in ("failed", "not run") else read_record(member.directory)
            found[point] = outcome_of(record, entry["neck_radius_nm"], entry["bud_height_nm"])
            values = {key: float(text) for key, text in member.values.items()}
            self.rows.append({**values, "outcome": found[point], **{name: entry[name] for name in KEPT}})
        return found

    def evaluate(self, outcomes):
        """The lines of boundaries.csv."""
        known, cells = traced(self.options.cells, self.options.levels, self.outcomes)
        self.rows.sort(key=lambda row: [row[key] for key in self.keys])
        write_table(self.output / "map.csv", self.rows)
        lines = [
            {"between": " | ".join(pair), self.keys[0]: self.value(0, x), self.keys[1]: self.value(1, y)}
            for pair, points in boundaries(cells, known).items()
            for x, y in points
        ]
        if lines:
            write_table(self.output / "boundaries.csv", lines)
        return lines

    def page(self, lines):
        rows, keys, output, full = self.rows, self.keys, self.output, (self.extent + 1) ** 2
        labels = [axis_label(key, self.units) for key in keys]
        map_page.write_page(rows, lines, self.folds, keys, labels, full, common_basis(records_of(self.all)), output)
        return [
            f"runs    {len(rows)} instead of the {full} of the full grid: {counted(row['outcome'] for row in rows)}",
            f"table   {shown(output / 'boundaries.csv') if lines else 'no boundary: one outcome everywhere'}",
            f"report  {shown(output / 'report.html')}",
        ]


def static_points(directories, keys):
    """{"stationary fold" or "stationary neck closes": [(x, y)]} in runs of statics that were continued in one of the keys."""
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


def run(options):
    """Run the command; returns its exit code."""
    study = OutcomeMap(options, output_directory(options, "map"))
    code = study.conduct()
    if study.rows and all(row["outcome"] == "failed" for row in study.rows) and not code:
        raise StudyError(f"every run failed, with: {study.rows[0]['exit_reason']}", RUN_FAILED)
    return code
