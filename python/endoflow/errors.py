"""The errors this package raises on purpose."""

from __future__ import annotations

import re
from pathlib import Path

#: What to do about a file that a run should have written.
RERUN = "repeat the run, or continue it with `endoflow run … --restart`"


def one_line(text: str) -> str:
    """The text with its control characters written out: a message is one line, whatever a file is called."""
    return "".join(f"\\u{ord(c):04x}" if ord(c) < 0x20 or ord(c) == 0x7F else c for c in text)


#: How the program's own words begin.
SPOKEN = re.compile(r"endoflow( [a-z-]+)?: ")

#: A line that says nothing, such as mpirun's rules of dashes.
EMPTY = re.compile(r"[\s\-=*]*")


def last_word(text: str) -> str:
    """Why a command failed, from all it wrote to stderr: one line, "" when there is none.

    The last line that the program spoke; else the first paragraph between a launcher's rules of dashes; else the last line.
    """
    lines = [line.strip() for line in text.splitlines()]
    spoken = [line for line in lines if SPOKEN.match(line)]
    if spoken:
        return spoken[-1].removeprefix("endoflow: ")
    told = [line for line in lines if not EMPTY.fullmatch(line)]
    if not told or not any(line.startswith("-----") for line in lines):
        return told[-1] if told else ""
    start = lines.index(told[0])
    end = next((i for i in range(start, len(lines)) if EMPTY.fullmatch(lines[i])), len(lines))
    return " ".join(lines[start:end]).rstrip(":")


class EndoflowError(Exception):
    """Base class of every error raised on purpose by this package. exit_code: of a command that ends with it."""

    exit_code = 4


class RunDirectoryError(EndoflowError):
    """A run directory, or a file in it, is missing, corrupt or incomplete.

    The message is one line: where, what, and what to do about it.
    """

    def __init__(self, path: Path, problem: str, remedy: str):
        super().__init__(one_line(f"{path}: {problem}; {remedy}"))
        self.path = path
        self.problem = problem
        self.remedy = remedy


class OutOfRangeError(EndoflowError, ValueError):
    """A quantity was asked for at a time the run does not cover."""
