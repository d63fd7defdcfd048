"""Puts the reader, python/endoflow, on the module path: import this first in every script that is started by itself."""

import sys
from pathlib import Path

#: Where comparisons/, python/ and cases/ lie.
ROOT = Path(__file__).resolve().parents[1]

sys.path.insert(0, str(ROOT / "python"))
