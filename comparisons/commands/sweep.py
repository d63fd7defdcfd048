"""`endoflow sweep CASE.toml --vary section.key=start:stop:step --engine E [-o DIR]`: many runs of one case.

Writes sweep.csv, plots and report.html. Exit codes: 0 done; 2 bad command line or parameter; 3 a run failed; 4 input or
output; 130 or 143 interrupted (run it again to continue).
"""

from dataclasses import replace

from comparisons import ENGINES
from comparisons.commands.options import common_settings, output_directory, require_apart
from comparisons.errors import shown
from comparisons.files import write_table
from comparisons.measures.words import common_basis, counted
from comparisons.page import sweep_page
from comparisons.studies.members import checked_member, directory_name, parameter_units, records_of, settings_of
from comparisons.studies.ranges import combinations, parsed_variation
from comparisons.studies.slurm import write_script
from comparisons.studies.study import Study, lock
from comparisons.studies.sweep_table import mixed_programs, row


class Sweep(Study):
    """Runs of a case with all combinations of some parameters' values."""

    command = "sweep"

    def __init__(self, options, output):
        super().__init__(options, output)
        self.all, self.units = [], parameter_units()

    def members(self):
        options = self.options
        variations = [parsed_variation(text) for text in options.vary]
        require_apart(options, [key for key, _ in variations])
        for values in combinations(variations):
            settings = (*common_settings(options), *settings_of(values))
            member = checked_member("", options.case, self.output, "", settings, values)
            for engine in ENGINES if options.engine == "both" else (options.engine,):
                name = f"{directory_name(values)}/{engine}"
                self.all.append(replace(member, name=name, engine=engine, directory=self.output / name))
        return self.all

    def run(self, members):
        return {} if self.options.collect else super().run(members)

    def evaluate(self, outcomes):
        """The rows of sweep.csv."""
        rows = [row(member, outcomes.get(member.name)) for member in self.all]
        write_table(self.output / "sweep.csv", rows)
        return rows

    def stopped(self, members, outcomes):
        """The table of what there is."""
        self.evaluate(outcomes)

    def page(self, rows):
        self.warn(filter(None, [mixed_programs(rows)]))
        keys, basis = [*self.all[0].values], common_basis(records_of(self.all))
        used = dict.fromkeys(member.parameters["membrane"]["curvature_convention"] for member in self.all)
        sweep_page.write_page(rows, keys, self.units, " and ".join(used), basis, self.output)
        return [
            f"runs    {counted(row['state'] for row in rows)}",
            f"table   {shown(self.output / 'sweep.csv')}",
            f"report  {shown(self.output / 'report.html')}",
        ]


def run(options):
    """Run the command; returns its exit code."""
    study = Sweep(options, output_directory(options, "sweep"))
    if not options.slurm:
        return study.conduct()
    members = study.members()
    with lock(study.output):
        script = study.output / "sweep.sbatch"
        print(write_script(members, options.case.stem, script, options.processes, options.jobs))
    return 0
