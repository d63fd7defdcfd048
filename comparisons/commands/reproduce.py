"""`endoflow reproduce ITEM [--quick|--full] [-o DIR] [--jobs N]`: the paper's figures and tables, ours beside them.

ITEM is table2, fig3, fig4, fig5, fig6, fig7, figA2; mobility, attribution, timescale or inertia, which ask why ours differ;
all; or of other papers hassinger2017, derenyi2002, juelicher1996, akamatsu2020, and collar, what scission has to do, which are branches
of stationary shapes and need seconds, or for collar minutes; and mund2023, three runs of the sharp engine, a minute.
The runs lie in DIR/runs and are shared by the items; each item writes DIR/ITEM with report.html, plots (PNG, SVG) and
ITEM.csv; DIR/index.html lists them, DIR/runs.csv the runs with state, CPU time and an estimate of what is left. Exit codes:
0 done, also when an engine refused a run: its item's page says so; 2 bad command line or parameter; 3 nothing ran; 4 input or
output; 130 or 143 interrupted (run it again to continue).
"""

import sys
from pathlib import Path

from comparisons.drawing.plots import save_all
from comparisons.errors import shown
from comparisons.files import write_table, write_text
from comparisons.paper import NAMES, OTHER_NAMES, item_module, page
from comparisons.paper.item import NotRun, is_run
from comparisons.paper.wanted_runs import WantedRuns, found_run, run_rows
from comparisons.studies.study import Study


class Reproduction(Study):
    """The runs behind some items of the paper, each made once."""

    command = "reproduce"
    failures_are_results = True

    def __init__(self, options, output):
        super().__init__(options, output)
        #: In the paper's order, then those of other papers.
        self.items = [name for name in NAMES if "all" in options.items or name in options.items]
        self.items += [name for name in OTHER_NAMES if name in options.items]
        self.wanted = WantedRuns(self.items, options, output)

    def members(self):
        return [member for member in self.wanted.members.values() if not isinstance(member, NotRun)]

    def run(self, members):
        return {} if self.options.pages_only else super().run(members)

    def evaluate(self, outcomes):
        """{member name: endoflow.Run or item.NotRun}."""
        found = {name: found_run(member, outcomes.get(name)) for name, member in self.wanted.members.items()}
        missing = {name: one.reason for name, one in found.items() if not is_run(one)}
        for name, reason in missing.items():
            print(f"endoflow reproduce: {name}: not run: {reason}", file=sys.stderr)
        self.failed = len(missing) if len(missing) == len(found) else 0
        return found

    def page(self, found):
        for item in self.items:
            yield from self.write_item(item, self.wanted.runs_of(item, found))
        if found:  # branches of stationary shapes are no runs
            write_table(self.output / "runs.csv", run_rows(self.wanted.members))
        write_text(self.output / "index.html", page.index_html(self.output))
        yield f"pages   {shown(self.output / 'index.html')}"

    def write_item(self, item, runs):
        """Write an item's directory; returns what the terminal shows of it."""
        module, directory = item_module(item), self.output / item
        directory.mkdir(parents=True, exist_ok=True)
        result = module.result(runs, self.options.quick)
        write_table(directory / f"{item}.csv", result.rows)
        save_all(result.figures, directory)
        write_text(directory / "report.html", page.item_html(item, module, result, runs, self.options.quick, directory))
        return page.summary_lines(item, result, directory)


def run(options):
    """Run the command; returns its exit code."""
    return Reproduction(options, options.output or Path("out/paper")).conduct()
