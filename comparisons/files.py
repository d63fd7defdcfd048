"""Files and their names: names may hold any byte, and an error names its file.

A full disk is met while writing, where Python has forgotten the name.
"""

import codecs
import contextlib
import errno
import io
import json
import os
import re

CONTROLS = re.compile("[\x00-\x1f\x7f]")

#: Bytes of a file's name that are no UTF-8, as Python holds them.
FOREIGN_BYTES = re.compile("[\udc80-\udcff]")


def shown(path):
    """A path, or a text with paths in it, as one line: control characters are written out, as \\u000a."""
    return CONTROLS.sub(lambda found: f"\\u{ord(found[0]):04x}", str(path))


def printable(text):
    """Text (or a path) in characters alone: bytes of names that are none are written out, as \\xff."""
    return FOREIGN_BYTES.sub(lambda found: f"\\x{ord(found[0]) - 0xDC00:02x}", str(text))


def take_any_name(*streams):
    """Let text streams take names of files as they are, byte for byte, and write out what their encoding lacks."""

    def kept(error):
        part = error.object[error.start : error.end]
        foreign = FOREIGN_BYTES.fullmatch(part[0])
        if foreign:
            return bytes([ord(part[0]) - 0xDC00]), error.start + 1
        return part.encode("ascii", "backslashreplace").decode("ascii"), error.end

    codecs.register_error("names", kept)
    for stream in streams:
        if isinstance(stream, io.TextIOWrapper):  # a text in memory has no encoding
            stream.reconfigure(errors="names")


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
