"""What reads finished runs, and the studies that make many. It knows run directories and the program, no engine.

Groups, each of which imports only from those before it (tests/comparisons/test_layout.py):

    measures    numbers from runs: distances, metrics, convergence, fits
    studies     many runs of one case: members, their state, the runner, tables, Slurm
    drawing     plots, pictures and films
    page        report.html
    paper       the paper's figures and tables, one module each
    commands    one module for each command, which print what came of it
"""

from pathlib import Path

#: Where comparisons/, python/ and cases/ lie.
ROOT = Path(__file__).resolve().parents[1]
