"""What a directory is that holds no run."""

from __future__ import annotations

from pathlib import Path

#: The file by which a result is known, and what it is called.
MARKS = (
    ("sweep.csv", "a sweep"),
    ("map.csv", "a map"),
    ("converge.csv", "a convergence study"),
    ("infer.json", "an inference"),
    ("modes.csv", "the modes of a run"),
    ("runs.csv", "reproduced figures"),
    ("metrics.json", "a comparison"),
    ("report.html", "a page"),
)

#: How many folders deep studies keep their runs.
DEPTH = 4


def what_else(directory: Path) -> str:
    """What to do instead with a directory without run.json: what it holds, and a run below it if there is one."""
    found = next((what for name, what in MARKS if (directory / name).is_file()), None)
    below = first_run(directory)
    if below is not None:
        return (f"it holds {found}; " if found else "") + f"give the directory of a run, such as {below}"
    return f"it holds {found}, give the directory of a run" if found else "is this a directory of `endoflow run`?"


def first_run(directory: Path) -> Path | None:
    """The first run among the folders below, in alphabetical order; None without one."""
    for depth in range(1, DEPTH + 1):
        runs = sorted(path.parent for path in directory.glob("*/" * depth + "run.json"))
        if runs:
            return runs[0]
    return None
