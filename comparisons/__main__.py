"""Starts a command: `python3 comparisons NAME …` is what `endoflow NAME …` becomes."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

# Python put this directory in front; the package itself and the reader lie beside it.
sys.path[0:1] = [str(ROOT), str(ROOT / "python")]

from comparisons.commands import call  # noqa: E402


def drop_unwritable_output():
    """Python would write it again at its end, and end with a message and a code of its own; the command has told of it."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


if __name__ == "__main__":
    code = call(sys.argv[1:])
    drop_unwritable_output()
    sys.exit(code)
