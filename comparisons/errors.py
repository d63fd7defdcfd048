"""Exit codes, the error that ends a command with one of them, and names of files in messages, which may hold any byte."""

import codecs
import io
import re

BAD_INPUT, RUN_FAILED, IO_FAILURE, INTERRUPTED = 2, 3, 4, 130

CONTROLS = re.compile("[\x00-\x1f\x7f]")

#: Bytes of a file's name that are no UTF-8, as Python holds them.
FOREIGN_BYTES = re.compile("[\udc80-\udcff]")


class StudyError(Exception):
    """Ends the command with one line on stderr and an exit code: 2 bad input, 3 a run failed, 4 input or output."""

    exit_code = BAD_INPUT

    def __init__(self, message, exit_code=None):
        super().__init__(message)
        self.exit_code = self.exit_code if exit_code is None else exit_code


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
