"""CSV files that people give: columns by name in nm and µs, and the line of each row, or why not in one line.

A line of heads names the columns. Comment lines begin with #; a first line sep=; says no more than the study does. Rows whose
cells are all empty are left out, an empty cell is nan. Everything else is refused with file, line and the key of the study that would read it.
"""

import csv
import json
import math
import re
from dataclasses import dataclass

import numpy as np

from comparisons.inference.study_keys import LENGTHS, SEPARATORS, TIMES
from comparisons.inference.table_heads import HeadsRefused, columns_of
from comparisons.inference.text_file import read_text
from endoflow.history import name_and_unit

REMEDY = "save the table as CSV and give that"
RECODING = 'save it in UTF-8, or say encoding = "latin-1"'

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)

#: A line that is no row: a comment, but not a spreadsheet's word for a number that it could not compute.
COMMENT = re.compile(r"\s*#(?!(DIV/0!|N/A|NAME\?|NULL!|NUM!|REF!|VALUE!))")

#: What programs write where there is no number, in small letters.
NO_NUMBER = ("", "nan", "na", "n/a")


class TableError(ValueError):
    """A table that cannot be read; the message begins with file and line."""


@dataclass(frozen=True)
class Layout:
    """How a CSV is written, as the study's keys of the same names say; where: the [[data]] for messages."""

    where: str
    heads: dict | tuple | None = None
    ignore: tuple = ()
    separator: str = ","
    decimal: str = "."
    encoding: str = "utf-8"
    length_unit: str = "nm"
    pixel_nm: float | None = None
    time_unit: str = "µs"

    def factor(self, column):
        """What a number of a column is multiplied with to be in the unit of its name."""
        length = self.pixel_nm if self.length_unit == "pixel" else LENGTHS[self.length_unit]
        unit = name_and_unit(column)[1]
        return TIMES[self.time_unit] if unit == "µs" else length ** {"nm": 1, "nm²": 2, "nm³": 3}[unit]

    def stated_unit(self, column):
        """The unit in which the numbers of a column of lengths or times are; None of areas and volumes."""
        return {"µs": self.time_unit, "nm": self.length_unit}.get(name_and_unit(column)[1])


@dataclass(frozen=True)
class Table:
    """columns: {name: (rows,)}, nan for an empty cell; lines: the line of each row in the file."""

    path: object
    columns: dict
    lines: tuple

    def place(self, row):
        """ "file:line" of a row."""
        return f"{self.path}:{self.lines[row]}"


def read_table(path, needed, allowed, layout):
    """The Table of a CSV (Path). needed, allowed: names of columns. Raises ValueError that names file and line."""
    text = read_text(path, REMEDY, layout.encoding, RECODING)
    rows = _rows(path, text, layout)
    if not rows:
        raise TableError(f"{path}: is empty; a line of heads is needed: {', '.join(allowed)}")
    try:
        names, start = columns_of(rows, needed, allowed, layout)
    except HeadsRefused as error:
        raise TableError(f"{path}:{rows[0][0]}: {error}") from None
    columns = {name: [] for name in names if name}
    lines = []
    for line, cells in rows[start:]:
        while len(cells) > len(names) and not cells[-1]:
            cells.pop()
        if len(cells) != len(names):
            hint = _decimal_hint(cells, layout)
            raise TableError(f"{path}:{line}: has {len(cells)} cells where the heads are {len(names)}{hint}")
        for name, cell in zip(names, cells):
            if name:
                columns[name].append(_number(cell, f"{path}:{line}: {name}", layout) * layout.factor(name))
        lines.append(line)
    return Table(path, {name: np.array(values) for name, values in columns.items()}, tuple(lines))


def _rows(path, text, layout):
    """[(line, cells)] without comments and empty rows."""
    lines = ["\n" if COMMENT.match(line) else f"{line}\n" for line in text.split("\n")]
    if re.fullmatch(r"sep=.\n", lines[0]):
        lines[0] = "\n"  # a spreadsheet's note to itself
    if layout.separator == "space":
        lines = [" ".join(line.split()) + "\n" for line in lines]
    reader = csv.reader(lines, delimiter=SEPARATORS[layout.separator], strict=True, skipinitialspace=True)
    found, start = [], 1
    try:
        for cells in reader:
            cells = [cell.strip() for cell in cells]
            if any(cells):
                found.append((start, cells))
            start = reader.line_num + 1
    except csv.Error:
        what = f"its quotes do not match, or a cell is longer than {csv.field_size_limit()} letters"
        raise TableError(f"{path}:{start}: {what}") from None
    return found


def _number(cell, where, layout):
    """The number of a cell, nan for an empty one."""
    if cell.lower() in NO_NUMBER:
        return math.nan
    text = cell.replace("\N{MINUS SIGN}", "-")
    if layout.decimal == ",":
        if "." in text:
            raise TableError(f'{where} = {_quoted(cell)} has a point, where decimal = "," says that decimals follow a comma')
        text = text.replace(",", ".")
    if text.lower().lstrip("+-") in ("inf", "infinity"):
        raise TableError(f"{where} = {_quoted(cell)} is infinite; a finite number is needed")
    if not NUMBER.fullmatch(text):
        hint = '; for decimal commas say decimal = ","' if DECIMAL_COMMA.fullmatch(text) else "; an empty cell is no data"
        raise TableError(f"{where} = {_quoted(cell)} is no number{hint}")
    if math.isinf(float(text)):
        raise TableError(f"{where} = {_quoted(cell)} is too large for a number")
    return float(text)


def _decimal_hint(cells, layout):
    """What to say about a row with too many cells, every second of which may be the decimals of the one before."""
    if layout.separator == "," and all(re.fullmatch(r"[+-]?\d+", cell) for cell in cells):
        return '; decimal commas need another separator (separator = ";" and decimal = ",") or cells in quotes'
    return ""


def _quoted(cell):
    """A cell for a message."""
    return json.dumps(cell if len(cell) <= 40 else f"{cell[:40]}…", ensure_ascii=False)
