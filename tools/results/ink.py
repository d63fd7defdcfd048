"""The style of the documentation's figures: SVG whose text is text, legible on paper and, where the reader's screen is dark, on that."""

import hashlib
import io
import re

from comparisons.drawing.style import ENGINE_COLOURS, LINES, plt
from results import tables
from results.places import IMAGES

#: Ink, faint ink, the two engines and a third colour: on light and on dark ground.
INK, FAINT, GRID = ("#1b222c", "#e8ecf1"), ("#5a6675", "#9ba7b5"), ("#d9dee5", "#323b47")
SHARP, DIFFUSE = ENGINE_COLOURS["boundary-integral"], ENGINE_COLOURS["phase-field"]
THIRD = ("#00805e", "#2cc79b")
TINT, SECOND_TINT = ("#e2eef7", "#1d2c3a"), ("#f6ecdf", "#35291c")
COLOURS = (INK, FAINT, GRID, SHARP, DIFFUSE, THIRD, TINT, SECOND_TINT)

#: How the engines' lines look, also without colour.
SHARP_LINE = {"color": SHARP[0], "marker": "o", "markersize": 4.5, **LINES[0], "linewidth": 2}
DIFFUSE_LINE = {"color": DIFFUSE[0], "marker": "s", "markersize": 3.5, **LINES[1]}

RC = {
    "svg.fonttype": "none",
    "svg.hashsalt": "endoflow",
    "font.family": ["DejaVu Sans", "sans-serif"],
    "text.color": INK[0],
    "axes.labelcolor": INK[0],
    "axes.edgecolor": FAINT[0],
    "xtick.color": INK[0],
    "ytick.color": INK[0],
    "grid.color": GRID[0],
    "axes.facecolor": "none",
    "savefig.facecolor": "none",
    "mathtext.fontset": "dejavusans",
}


def panels(rows=1, columns=1, size=(6.4, 3.2), **options):
    """Figure and axes in the style."""
    plt.rcParams.update(RC)
    return plt.subplots(rows, columns, figsize=size, layout="constrained", **options)


def drawn_from(names):
    """What a picture says of the tables that it shows: their names and the digest of their numbers."""
    texts = []
    for name in names:
        lines = [line for line in tables.path(name).read_text("utf-8").splitlines() if not line.startswith("#")]
        texts.append(f"{name} {hashlib.sha256(chr(10).join(lines).encode()).hexdigest()[:12]}")
    return "drawn from " + ", ".join(texts) if texts else "drawn from no table"


def save(figure, name, title, names):
    """Write docs/images/NAME.svg of the tables called names."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    svg = re.sub(r"\s*<metadata>.*?</metadata>", "", buffer.getvalue(), flags=re.S)
    svg = re.sub(r"<!DOCTYPE.*?>\s*", "", svg, flags=re.S)
    head = f"<title>{title}</title>\n <desc>{drawn_from(names)}</desc>\n <style>{dark_rules()}</style>"
    svg = re.sub(r"(<svg [^>]*>)", lambda found: f"{found[1]}\n {head}", svg, count=1)
    svg = "\n".join(line.rstrip() for line in svg.splitlines()) + "\n"
    IMAGES.joinpath(f"{name}.svg").write_text(svg, "utf-8")


def dark_rules():
    """Style that puts a dark screen's colours in the place of the light ones."""
    rules = "".join(
        f'[style*="{kind}: {light.lower()}"]{{{kind}:{dark} !important}}' for light, dark in COLOURS for kind in ("fill", "stroke")
    )
    return f"text{{fill:{INK[0]}}}@media (prefers-color-scheme: dark){{text{{fill:{INK[1]}}}{rules}}}"
