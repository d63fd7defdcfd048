"""history.csv: one row per accepted time step."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from .arrays import Array
from .curves import hermite
from .errors import RERUN, RunDirectoryError

#: Words at the end of a column's name that spell its unit; `per` starts the denominator.
UNIT_WORDS = {"nm": "nm", "nm2": "nm²", "nm3": "nm³", "us": "µs", "s": "s", "pN": "pN", "deg": "°"}

#: Bytes that hold the last row of a history.csv.
TAIL = 8192


def unit_of(column: str) -> str:
    """Unit of a history column as text, from its name: "x_pN_nm_per_us" is in "pN nm/µs"; "1" for a number without unit."""
    return name_and_unit(column)[1]


def name_and_unit(column: str) -> tuple[str, str]:
    """A column's name in words, and its unit: "bud_height_nm" is ("bud height", "nm"); "1" for a number without unit."""
    words = column.split("_")
    start = len(words)
    while start > 1 and (words[start - 1] in UNIT_WORDS or words[start - 1] == "per"):
        start -= 1
    above, _, below = " ".join(words[start:]).partition("per")
    above, below = (" ".join(UNIT_WORDS[word] for word in part.split()) for part in (above, below))
    return " ".join(words[:start]), f"{above or '1'}/{below}" if below else above or "1"


def read_history(path: Path, columns: Iterable[str] = ("time_us",)) -> dict[str, Array]:
    """Read a history.csv into {column name: float array (rows,)}; empty cells become nan. `columns`: those it must have.

    Raises RunDirectoryError when the file is missing, lacks a column, has a malformed row, or when time runs backwards.
    """
    try:
        text = path.read_bytes().decode("utf-8")
        rows = [row for row in csv.reader(text.splitlines(keepends=True)) if row]
    except FileNotFoundError:
        raise RunDirectoryError(path, "the file is missing", RERUN) from None
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise RunDirectoryError(path, f"cannot be read as CSV ({error})", RERUN) from None
    if len(rows) < 2:
        raise RunDirectoryError(path, "holds no time step", RERUN)
    header = [name.strip() for name in rows[0]]
    missing = [name for name in columns if name not in header]
    if missing:
        raise RunDirectoryError(
            path, f"lacks the column(s) {', '.join(missing)}", "is this a directory of `endoflow run`?"
        )
    table = np.array([_parse_row(path, number, row, header) for number, row in enumerate(rows[1:], start=2)])
    if not text.endswith("\n"):  # its last number may be cut short and look like one
        raise RunDirectoryError(path, f"line {len(rows)} is torn", RERUN)
    history = {name: table[:, column] for column, name in enumerate(header)}
    if not (np.diff(history["time_us"]) >= 0).all():  # also catches nan
        raise RunDirectoryError(path, "time_us does not increase from row to row", RERUN)
    return history


def time_reached(path: Path) -> float:
    """Time (µs) of the last complete row of a history.csv, from its end alone; 0 before the first, and without a file."""
    try:
        with open(path, "rb") as file:
            file.seek(max(0, file.seek(0, os.SEEK_END) - TAIL))
            rows = file.read().decode("ascii", "replace").split("\n")[:-1]
        return float(rows[-1].split(",")[0])
    except (OSError, ValueError, IndexError):
        return 0.0


def interpolated(times: Array, values: Array, at: float | Array) -> Any:
    """`values` of the rows at `times` as a function of time, at one (number or array); nan outside and beside gaps.

    Cubic in each step, with slopes by which it overshoots nowhere: weighted harmonic means of the secants' (Fritsch &
    Butland, SIAM J. Sci. Stat. Comput. 5, 300 (1984)). Third order in the step, second beside extrema, gaps and
    the ends. A single row holds at its own time.
    """
    linear = np.interp(at, times, values, left=np.nan, right=np.nan)  # knows the rows themselves and the gaps
    if len(times) < 2:
        return linear
    steps = np.diff(times)
    with np.errstate(divide="ignore", invalid="ignore"):
        secants = np.diff(values) / steps
        before, after, first, second = secants[:-1], secants[1:], steps[:-1], steps[1:]
        means = 3 * (first + second) / ((2 * second + first) / before + (second + 2 * first) / after)
    inner = np.where(before * after > 0, means, 0.0)
    inner = np.where(np.isfinite(before), np.where(np.isfinite(after), inner, before), after)
    slopes = np.concatenate([secants[:1], inner, secants[-1:]])

    cubic = hermite(times, values, slopes, np.asarray(at))
    return np.where(np.isin(at, times) | np.isnan(linear), linear, cubic)


def _parse_row(path: Path, number: int, row: list[str], header: list[str]) -> list[float]:
    """Cells of one row as floats; `number` is its line in the file."""
    if len(row) != len(header):
        raise RunDirectoryError(path, f"line {number} has {len(row)} cells where the header has {len(header)}", RERUN)
    try:
        return [float(cell) if cell.strip() else np.nan for cell in row]
    except ValueError as error:
        raise RunDirectoryError(path, f"line {number}: {error}", RERUN) from None
