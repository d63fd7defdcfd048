"""`endoflow report DIR [-o DIR]`: a page of one run with plots, numbers, alarms, parameters, provenance.

Writes report.html and its plots. Exit codes: 0 done; 2 bad command line; 4 the run cannot be read or the page cannot be
written; 130 interrupted.
"""

import endoflow
from comparisons.drawing import run_plots
from comparisons.errors import shown
from comparisons.files import require_writable, write_text
from comparisons.page.run_report import run_html


def run(options):
    """Run the command; returns its exit code."""
    found = endoflow.load(options.directory)
    output = options.output or options.directory / "report"
    require_writable(output)
    output.mkdir(parents=True, exist_ok=True)
    drawn = run_plots.write_all(found, output)
    write_text(output / "report.html", run_html(found, drawn, output))
    print(f"report  {shown(output / 'report.html')}")
    return 0
