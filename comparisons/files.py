"""Writing files such that an error names the file: a full disk is met while writing, where Python has forgotten the name."""

import contextlib
import json


@contextlib.contextmanager
def named(path):
    """Gives an OSError raised inside the name `path` when it has none."""
    try:
        yield
    except OSError as error:
        if error.filename is not None:
            raise
        raise OSError(error.errno, error.strerror or str(error), str(path)) from None


def write_text(path, text):
    """Write a text file (Path) in UTF-8."""
    with named(path):
        path.write_text(text, encoding="utf-8")


def write_json(path, content):
    """Write a dict as JSON; NaN is an error."""
    write_text(path, json.dumps(content, indent=2, allow_nan=False) + "\n")
