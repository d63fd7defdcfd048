"""Files that commands write. An error names its file, also one met while writing, where Python has forgotten the name."""

import contextlib
import csv
import errno
import json
import os
from decimal import Decimal, InvalidOperation

from comparisons.errors import printable


@contextlib.contextmanager
def named(path):
    """Gives an OSError raised inside the name `path` when it has none."""
    try:
        yield
    except OSError as error:
        if error.filename is not None:
            raise
        raise OSError(error.errno, error.strerror or str(error), str(path)) from None


def require_writable(directory):
    """Raises OSError when a directory (Path) can neither be written to nor made: before the work for what it is to hold."""
    there = directory
    while not os.path.lexists(there) and there != there.parent:
        there = there.parent
    if not there.is_dir() or not os.access(there, os.W_OK | os.X_OK):
        raise OSError(errno.EACCES, "is not a writable directory", str(there))


def write_text(path, text):
    """Write a text file (Path) in UTF-8."""
    with named(path):
        path.write_text(printable(text), encoding="utf-8", errors="backslashreplace")


def write_json(path, content):
    """Write a dict as JSON; NaN is an error."""
    write_text(path, json.dumps(content, indent=2, allow_nan=False) + "\n")


def write_table(path, rows):
    """Write rows, list of {column: value}, as CSV."""
    with named(path), open(path, "w", newline="", encoding="utf-8", errors="surrogateescape") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(rows[0])
        writer.writerows([cell(value) for value in entry.values()] for entry in rows)


def cell(value):
    """A value as text: numbers with 12 digits, None as nothing, an apostrophe before what spreadsheets would compute."""
    if value is None:
        return ""
    text = f"{value:.12g}" if isinstance(value, float) else str(value)
    return f"'{text}" if text.startswith(("=", "+", "-", "@")) and as_number(text) is None else text


def as_number(text):
    """The finite number a text spells, or None."""
    try:
        number = Decimal(text)
    except InvalidOperation:
        return None
    return float(number) if number.is_finite() else None
