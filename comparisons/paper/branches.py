"""Branches of stationary shapes, by `endoflow statics --continue-in`, for items of other papers."""

import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import endoflow
from comparisons import ROOT
from comparisons.errors import RUN_FAILED, StudyError
from comparisons.studies.members import program
from endoflow.errors import last_word


@dataclass(frozen=True)
class Branch:
    """columns: {name: array} of its rows, in the branch's order; folds: values of the key there; ended: why it ends."""

    columns: dict
    folds: list
    ended: str


def followed(case, key, end, settings):
    """The Branch of cases/CASE.toml with settings {section.key: text} in a key, to its value `end`. Raises StudyError."""
    with tempfile.TemporaryDirectory() as scratch:
        directory = Path(scratch) / "branch"
        words = [str(program()), "statics", str(ROOT / "cases" / f"{case}.toml"), "-o", str(directory)]
        for name, value in settings.items():
            words += ["--set", f"{name}={value}"]
        done = subprocess.run([*words, "--continue-in", f"{key}={end:g}"], capture_output=True, text=True, check=False)
        if not (directory / "run.json").exists() or done.returncode not in (0, RUN_FAILED):
            raise StudyError(last_word(done.stderr), RUN_FAILED)
        run = endoflow.load(directory)
    notes = run.record["notes"].get("branch")
    if notes is None:
        raise StudyError(last_word(done.stderr), RUN_FAILED)
    return Branch(dict(run.history), [fold["value"] for fold in notes["folds"]], notes["ended_because"])
