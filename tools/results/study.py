"""What a study and a table are, and what commands of many studies begin with.

A run's command ends where its directory is added; {LABEL} stands for the directory of another run of the same study.
"""

from dataclasses import dataclass
from typing import Callable


@dataclass(frozen=True)
class Table:
    """A file of docs/results/data. rows: (Made) → rows as dicts; derived: from other tables alone."""

    name: str
    columns: tuple
    rows: Callable
    derived: bool = False


@dataclass(frozen=True)
class Study:
    """minutes: for which all its runs keep two cores; runs: {label: command}; failures_are_results: a solver may stop."""

    name: str
    minutes: float
    runs: dict
    tables: tuple
    failures_are_results: bool = False


def of_each(key, measure, labels):
    """The rows of a Table with one for each run: {key: label}, then what measure(run) says."""
    return lambda made: [{key: label} | measure(made.run(label)) for label in labels]


QUIET = "--set output.field_interval=0"
ENGINES = ("boundary-integral", "phase-field")
SHARP = f"endoflow run boundary-integral cases/standard.toml {QUIET}"
DIFFUSE = f"endoflow run phase-field cases/standard.toml {QUIET}"
TO_BUDDING = "--set output.stop_at_budding=true"
