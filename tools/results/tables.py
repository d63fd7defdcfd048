"""docs/results/data/*.csv: a table of numbers, with what made it in comment lines above."""

import csv
import io
from dataclasses import dataclass, field

import numpy as np

from results.writing import as_number, written
from results.places import DATA

REVISION, COMMIT, COMMAND, RECORDED, STUDY = "numerics revision", "commit", "command", "recorded at commit", "study"


@dataclass(frozen=True)
class Column:
    """A column: its name in the file; its title in pages, None where pages do not show it; how its numbers are written."""

    name: str
    title: str = None
    form: str = ".10g"


@dataclass
class Stored:
    """A table as its file has it. about: {word: text} of the comment lines; commands: those that made it; rows: dicts."""

    about: dict = field(default_factory=dict)
    commands: list = field(default_factory=list)
    rows: list = field(default_factory=list)

    @property
    def revision(self):
        """The numerics revision that made it; 0 for one older than revisions are counted."""
        return int(self.about.get(REVISION, 0))

    @property
    def recorded(self):
        """The commit whose pages the numbers were taken from; None of a table that `make results` made."""
        return self.about.get(RECORDED)

    def row(self, key):
        """The row whose first cell, or whose first two joined by "+", are the key, blanks being underscores. Raises KeyError."""
        for row in self.rows:
            first, second = [*row.values(), None][:2]
            parts = key.partition("+")
            if same(key, first) or (same(parts[0], first) and same(parts[2], second)):
                return row
        raise KeyError(key)


def same(key, value):
    """Whether a part of a marker names a cell: as a number, or as a text whose blanks are underscores."""
    return as_number(key) == value if isinstance(value, float) else key == str(value).replace(" ", "_")


def path(name):
    """The file of a table."""
    return DATA / f"{name}.csv"


def read(name):
    """The Stored table of a name; None where there is none."""
    if not path(name).exists():
        return None
    stored, lines = Stored(), []
    for line in path(name).read_text("utf-8").splitlines():
        if line.startswith("# "):
            word, _, text = line[2:].partition(": ")
            if word == COMMAND:
                stored.commands.append(text)
            else:
                stored.about[word] = text
        else:
            lines.append(line)
    stored.rows = numbers(lines)
    return stored


def columns(name, *wanted, **where):
    """Columns of a table as arrays, nan where cells are empty, of the rows whose cells are those of where."""
    rows = [row for row in read(name).rows if all(row[key] == value for key, value in where.items())]
    return [np.array([np.nan if row[key] is None else float(row[key]) for row in rows]) for key in wanted]


def numbers(lines):
    """The rows of a CSV's lines as dicts, cells as as_number() has them."""
    return [{key: as_number(text) for key, text in row.items()} for row in csv.DictReader(lines)]


def write(name, about, commands, rows):
    """Write a table. rows: dicts with the same keys, the first of which names the row."""
    text = io.StringIO()
    for word, value in about.items():
        print(f"# {word}: {value}", file=text)
    for command in commands:
        print(f"# {COMMAND}: {command}", file=text)
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(rows[0])
    for row in rows:
        writer.writerow([cell(value) for value in row.values()])
    DATA.mkdir(parents=True, exist_ok=True)
    path(name).write_text(text.getvalue(), "utf-8")


def cell(value):
    """A value as the file has it: ten digits, empty where it does not exist."""
    if value is None or value != value:
        return ""
    return value if isinstance(value, str) else f"{value:.10g}"


def markdown(columns, rows):
    """A table in Markdown of the columns (Column) that have a title."""
    shown = [column for column in columns if column.title is not None]
    head = [[column.title for column in shown], ["---"] * len(shown)]
    cells = [[written(row[column.name], column.form) for column in shown] for row in rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in head + cells)
