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


def scheme_constant(name):
    """A number of the scheme `production` that is no parameter, as phasefield/layer/constants.h states it."""
    text = (ROOT / "phasefield" / "layer" / "constants.h").read_text("utf-8")
    return float(re.search(rf'\{{"{name}", ([^,]+),', text)[1])
