"""CSV files that people give: columns by name in nm and µs, and the line of each row, or why not in one line.

A line of heads names the columns. Comment lines begin with #; a first line sep=; says no more than the study does. Rows whose
cells are all empty are left out, an empty cell is nan. Everything else is refused with file, line and the key of the study that
would read it.
"""

import csv
import json
import math
import re
import unicodedata
from dataclasses import dataclass

import numpy as np

from comparisons.inference.study_keys import SEPARATORS, unknown
from comparisons.inference.study_values import LENGTHS, TIMES, unit_of_text
from comparisons.inference.text_file import read_text
from comparisons.measures.coat import COAT
from endoflow.history import name_and_unit

REMEDY = "save the table as CSV and give that"
RECODING = 'save it in UTF-8, or say encoding = "latin-1"'
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)

#: A line that is no row: a comment, but not a spreadsheet's word for a number that it could not compute.
COMMENT = re.compile(r"\s*#(?!(DIV/0!|N/A|NAME\?|NULL!|NUM!|REF!|VALUE!))")

#: What programs write where there is no number, in small letters.
NO_NUMBER = ("", "nan", "na", "n/a")

#: A head with a unit in parentheses or brackets, and what is a number where heads belong.
WITH_UNIT = re.compile(r"(.*\S)\s*[(\[]\s*([^()\[\]]*?)\s*[)\]]")
HEAD_NUMBER = re.compile(r"[+-]?\d[\d.,]*(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)

#: Most heads that a message lists.
MOST_LISTED = 12

#: Longest head or cell that a message shows whole.
LONGEST = 60

#: Columns that tell what a table is.
FIRST_COLUMNS = {
    "outlines": ("pit", "r_nm", "z_nm"),
    "contour": ("r_nm", "z_nm"),
    "file": ("time_us",),
    "pits": (next(iter(COAT)),),
}


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
        powers = {"nm": 1, "nm²": 2, "nm³": 3, "1/nm": -1, "°": 0, "1": 0}
        return TIMES[self.time_unit] if unit == "µs" else length ** powers[unit]

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


class HeadsRefused(ValueError):
    """Heads that say not what the columns are; the message says what they are and which key would help."""


def columns_of(rows, needed, allowed, layout):
    """(name of each column, "" for one that is no data; index of the first row of numbers) of rows [(line, cells)].

    needed, allowed: names of columns; layout: a csv_table.Layout. Raises HeadsRefused.
    """
    cells = rows[0][1]
    _require_separator(rows, allowed, layout)
    if isinstance(layout.heads, tuple):
        names, start = _given(cells, allowed, layout), 0
    else:
        while cells and not cells[-1]:
            cells.pop()
        names, start = _named(cells, needed, allowed, layout), 1
    present = [name for name in names if name]
    twice = [name for name in present if present.count(name) > 1]
    if twice:
        raise HeadsRefused(f"the column {twice[0]} is there twice; leave one out")
    missing = [name for name in needed if name not in names]
    if missing:
        raise HeadsRefused(f"lacks the column {missing[0]}; known: {', '.join(allowed)}; its heads are {_listed(cells)}")
    return names, start


def _given(cells, allowed, layout):
    """Names of the columns of a file without heads, as the study lists them."""
    for name in layout.heads:
        if name and name not in allowed:
            raise HeadsRefused(f'heads: {unknown(name, allowed)}; "" for a column that is no data')
    if len(layout.heads) != len(cells):
        raise HeadsRefused(f"has {len(cells)} columns where heads lists {len(layout.heads)}")
    return list(layout.heads)


def _named(cells, needed, allowed, layout):
    """Names of the columns by their heads."""
    own = layout.heads or {}
    for name, head in own.items():
        if name not in allowed:
            raise HeadsRefused(f"heads: {unknown(name, allowed)}")
        if head not in cells:
            raise HeadsRefused(f"heads: {name} = {_quoted(head)} is none of its heads {_listed(cells)}")
    for head in layout.ignore:
        if head not in cells:
            raise HeadsRefused(f"ignore: {_quoted(head)} is none of its heads {_listed(cells)}")
    if all(HEAD_NUMBER.fullmatch(cell) for cell in cells):
        names = json.dumps(list(needed))
        remedy = f"say heads = {names}, the columns in their order, in {layout.where}"
        raise HeadsRefused(f"has numbers where the heads belong; {remedy}")
    by_head = {head: name for name, head in own.items()}
    names = []
    for cell in cells:
        name = "" if cell in layout.ignore else by_head.get(cell, cell)
        if name and name not in allowed or not name and cell not in layout.ignore:
            raise HeadsRefused(_complaint(cell, cells, allowed, layout))
        if name:
            _require_unit(name, cell, layout)
        names.append(name)
    return names


def _require_separator(rows, allowed, layout):
    """Refuses a table of one column that another separator would cut into columns with heads that say something."""
    cells, numbers = rows[0][1], rows[1][1] if len(rows) > 1 else []
    if len(cells) > 1:
        return
    for name, separator in SEPARATORS.items():
        parts = [part.strip() for part in cells[0].split(separator)]
        if name == layout.separator or len(parts) < 2 or not any(guess(part, allowed)[0] for part in parts):
            continue
        keys = [f'separator = "{name}"']
        if name != "," and layout.decimal == "." and (len(numbers) > 1 or any("," in cell for cell in numbers)):
            keys.append('decimal = ","')
        raise HeadsRefused(f"its heads are one cell, {_listed(cells)}; say {' and '.join(keys)} in {layout.where}")


def _require_unit(name, head, layout):
    """Refuses a head whose unit in parentheses is not that of its numbers."""
    stated, found = layout.stated_unit(name), WITH_UNIT.fullmatch(head)
    unit = unit_of_text(found[2]) if found else stated
    if stated is not None and unit != stated and unit in (*LENGTHS, *TIMES):
        key = "time_unit" if unit in TIMES else "length_unit"
        raise HeadsRefused(f'{_quoted(head)} is in {unit}, and {name} is taken for {stated}; say {key} = "{unit}"')


def _complaint(head, cells, allowed, layout):
    """What is said about a head that is not known: which keys would read the file."""
    guesses, units = {}, {}
    for cell in cells:
        name, unit = guess(cell, allowed)
        if name and name != cell and name not in guesses:
            guesses[name] = cell
            if unit and unit != layout.stated_unit(name):
                units["time_unit" if unit in TIMES else "length_unit"] = unit
    text = f"unknown head {_quoted(head)}; its heads are {_listed(cells)}; known: {', '.join(allowed)}"
    if guesses:
        pairs = ", ".join(f"{name} = {_quoted(cell)}" for name, cell in guesses.items())
        keys = [f"heads = {{ {pairs} }}", *(f'{key} = "{unit}"' for key, unit in units.items())]
        return f"{text}; say {' and '.join(keys)} in {layout.where}"
    others = [kind for kind, columns in FIRST_COLUMNS.items() if columns[0] not in allowed and set(columns) <= set(cells)]
    if others:
        return f"{text}; a table with {' and '.join(FIRST_COLUMNS[others[0]])} is given as {others[0]} = …"
    if not set(cells) & set(allowed):
        pairs = ", ".join(f'{name} = "…"' for name in allowed[:2])
        return f"{text}; say heads = {{ {pairs} }} with its own heads; lines before these must begin with #"
    free = [f"heads = {{ {name} = {_quoted(head)} }} if it is that, or " for name in allowed if name not in cells]
    return f"{text}; say {(free or [''])[0]}ignore = [{_quoted(head)}] in {layout.where}"


def guess(head, allowed):
    """(name, unit) that a head may stand for, None for what it does not tell: "r (nm)", "Time [ns]", "neck radius"."""
    found = WITH_UNIT.fullmatch(head)
    base, unit = (found[1], unit_of_text(found[2])) if found else (head, None)
    words = re.sub(r"\W+", "_", unicodedata.normalize("NFKC", base).lower()).strip("_")
    if words not in allowed:
        stem, _, last = words.rpartition("_")
        if unit is None and unit_of_text(last) in (*LENGTHS, *TIMES):
            words, unit = stem, unit_of_text(last)
        stems = {name_and_unit(name)[0].replace(" ", "_"): name for name in allowed}
        words = stems.get(words)
    return words, unit if unit in (*LENGTHS, *TIMES) else None


def _listed(cells):
    """Heads in quotes."""
    return ", ".join(map(_quoted, cells[:MOST_LISTED])) + (" …" if len(cells) > MOST_LISTED else "")


def _quoted(text):
    """A head or a cell in quotes, a long one cut."""
    return json.dumps(text if len(text) <= LONGEST else f"{text[:LONGEST]}…", ensure_ascii=False)
