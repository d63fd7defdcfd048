"""Where things are, and the numerics revision of these sources."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
DATA = DOCS / "results" / "data"
IMAGES = DOCS / "images"
RUNS = ROOT / "out" / "results"


def numerics_revision():
    """The engines' revision as shared/support/version.h states it."""
    text = (ROOT / "shared" / "support" / "version.h").read_text("utf-8")
    return int(re.search(r"numerics_revision = (\d+);", text).group(1))


def all_pages():
    """README.md and the pages of docs/."""
    return [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))]
