"""Puts the code under test on the module path, so that a test file also runs alone: python3 tests/comparisons/test_reader.py"""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

#: What is started as `endoflow NAME …`.
COMPARISONS = str(ROOT / "comparisons")

sys.path[:0] = [str(Path(__file__).resolve().parent), str(ROOT / "tests"), str(ROOT), str(ROOT / "python")]
