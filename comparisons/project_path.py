"""Puts the reader, python/endoflow, on the module path: import this first in every script that is started by itself."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
