"""The pages of the documentation in reading order, and the commands in them."""

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

#: Order of the pages below docs/ by groups; any others follow in the order of their names.
GROUPS = {
    "Start": ("index", "overview", "install", "tutorial-1", "tutorial-2", "tutorial-3", "gallery", "which-engine", "is-it-right", "troubleshooting"),
    "Use": ("case-files", "parameters-biology", "outputs", "studies", "inference", "paper", "paraview", "python", "web"),
    "Theory and methods": (
        "model", "boundary-integral", "phase-field", "phase-field-paper", "statics", "modes", "noise", "verification", "decisions",
    ),
    "Results": (
        "results/standard-case", "results/sharp-refinement", "results/smooth-case", "results/paper", "results/vesicles", "results/growing-coats",
        "results/loads", "results/inference", "results/modes",
    ),
    "Development": ("architecture", "developer-guide", "extending", "roadmap"),
}  # fmt: skip
ORDER = tuple(name for group in GROUPS.values() for name in group)

#: Pages for users, and pages that are the program's own tables, which a test compares with it.
USER_PAGES = GROUPS["Start"] + GROUPS["Use"]
REFERENCE = ("parameters",)

#: A fenced block with an optional comment above it.
FENCE = re.compile(r"^(?:<!-- (?P<mark>[^\n]*?) -->\n+)?```(?P<kind>\w*)\n(?P<text>.*?)^```$", re.M | re.S)
INDENTED = re.compile(r"^    (?P<line>(?:build/|mpirun|endoflow |make |python3 )(?:[^\\\n]|\\\n|\\.)*)$", re.M)


@dataclass(frozen=True)
class Block:
    """A block of a page. kind: "sh", "python", …; mark: the comment above it, "" without; indented ones are parse-only."""

    page: Path
    kind: str
    mark: str
    text: str


def pages():
    """Paths of all pages below docs/, in reading order."""
    found = {str(path.relative_to(ROOT / "docs").with_suffix("")): path for path in (ROOT / "docs").rglob("*.md")}
    names = [name for name in ORDER if name in found]
    return [found[name] for name in names + sorted(set(found) - set(names))]


def blocks(page):
    """The blocks of a page (Path) in their order."""
    text = page.read_text(encoding="utf-8")
    fenced = [Block(page, m["kind"], m["mark"] or "", m["text"]) for m in FENCE.finditer(text)]
    rest = FENCE.sub("", text)
    return fenced + [Block(page, "sh", "parse only: indented", m["line"] + "\n") for m in INDENTED.finditer(rest)]


def title(page):
    """The first heading of a page (Path), without markup."""
    return re.search(r"^# (.*)$", page.read_text(encoding="utf-8"), re.M).group(1).replace("`", "")
