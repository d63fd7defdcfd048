"""The errors this package raises on purpose."""

from __future__ import annotations

from pathlib import Path

#: What to do about a file that a run should have written.
RERUN = "repeat the run, or continue it with `endoflow run … --restart`"


class EndoflowError(Exception):
    """Base class of every error raised on purpose by this package."""


class RunDirectoryError(EndoflowError):
    """A run directory, or a file in it, is missing, corrupt or incomplete.

    The message is one line: where, what, and what to do about it.
    """

    def __init__(self, path: Path, problem: str, remedy: str):
        super().__init__(f"{path}: {problem}; {remedy}")
        self.path = path
        self.problem = problem
        self.remedy = remedy


class OutOfRangeError(EndoflowError, ValueError):
    """A quantity was asked for at a time the run does not cover."""
