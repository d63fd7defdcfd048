"""Puts the code under test on the module path, so that a test file also runs alone: python3 tests/comparisons/test_reader.py"""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COMPARE = ROOT / "comparisons" / "compare.py"

sys.path[:0] = [str(Path(__file__).resolve().parent), str(ROOT / "comparisons"), str(ROOT / "python")]
