"""What reads finished runs, and the studies that make many. It knows run directories and the program, no engine.

Groups, each of which imports only from those before it (tests/comparisons/test_layout.py):

    measures    numbers from runs: the table of quantities, distances, metrics, convergence, fits
    studies     many runs of one case: what a study is, members, their state, the runner, tables, Slurm
    drawing     plots, pictures, films, surfaces for ParaView
    page        report.html: what all pages have, and the plots and the page of each kind of result
    inference   parameters from data, from the study file to its page
    paper       the paper's figures and tables, one module each
    commands    what becomes of each command; options.py lists them
"""

from pathlib import Path

#: The engines, as the program calls them.
BOUNDARY_INTEGRAL, PHASE_FIELD = ENGINES = ("boundary-integral", "phase-field")

#: Where comparisons/, python/ and cases/ lie.
ROOT = Path(__file__).resolve().parents[1]
