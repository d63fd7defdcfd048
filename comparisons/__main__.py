"""Starts a command: `python3 comparisons NAME …` is what `endoflow NAME …` becomes."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

# Python put this directory in front; the package itself and the reader lie beside it.
sys.path[0:1] = [str(ROOT), str(ROOT / "python")]

from comparisons.commands.guard import call  # noqa: E402

if __name__ == "__main__":
    sys.exit(call(sys.argv[1:]))
