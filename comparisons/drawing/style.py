"""How runs and quantities look and are called: one definition for plots and report. Whoever draws takes `plt` from here."""

import warnings

import matplotlib
import matplotlib.pyplot as plt  # noqa: F401
from matplotlib.colors import LinearSegmentedColormap

from comparisons.errors import printable, shown

#: Colour of each engine (Okabe and Ito, safe for colour-blind readers) on light and on dark ground.
ENGINE_COLOURS = {"boundary-integral": ("#0072B2", "#4DB2EC"), "phase-field": ("#D55E00", "#FF9248")}
SECOND_RUN_COLOUR = ("#00805E", "#2CC79B")
ENGINE_NAMES = {"boundary-integral": "boundary integral", "phase-field": "phase field", "statics": "stationary shape"}

#: Lines of run A and run B: a thin dashed line on a thick one, so that both show where they coincide, and without colour.
LINES = ({"linestyle": "-", "linewidth": 2.8}, {"linestyle": (0, (4, 2)), "linewidth": 1.6})

#: Marker and line of each engine: both show where they coincide.
LOOKS = {
    "boundary-integral": {"marker": "o", "markersize": 7, **LINES[0]},
    "phase-field": {"marker": "s", "markersize": 4, **LINES[1]},
}

#: Concentration c from 0 (bare membrane) to 1 (coated), on light and on dark ground. Lightness is monotone in c.
CONCENTRATION_STOPS = ("#A9B4C0", "#A678B4", "#8E1068")
CONCENTRATION_STOPS_DARK = ("#8A9BB0", "#B98AD0", "#FF8AD0")
CONCENTRATION = LinearSegmentedColormap.from_list("concentration", CONCENTRATION_STOPS)

#: Ground tints: extracellular fluid (below and inside the bud) and cytoplasm.
EXTRACELLULAR, CYTOPLASM = "#E2EEF7", "#FCFBF7"

#: Velocity arrows are logarithmic: none up to this speed (nm/µs); length (nm) of the fastest one.
SLOWEST_ARROW, LONGEST_ARROW = 0.03, 14.0

#: Neck radius (nm) that counts as budded.
BUDDING_NECK_RADIUS = 5.0

#: Times (µs) of the paper's figures.
PAPER_TIMES = (2.90, 7.46, 14.02, 16.98)

#: Off screen, in the project's style.
RC = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.8,
    "axes.edgecolor": "#444444",
    "axes.grid": True,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "lines.linewidth": 1.8,
    "lines.solid_capstyle": "round",
    "figure.dpi": 200,
    "savefig.facecolor": "white",
    "svg.hashsalt": "endoflow",
    "svg.fonttype": "path",
}

matplotlib.use("Agg")
matplotlib.rcParams.update(RC)

# A letter of a name that the font lacks is drawn as a box; pages hold the name as text.
warnings.filterwarnings("ignore", message="Glyph .* missing from current font")


def literal(text):
    """A text from outside, as a picture's text: a dollar begins no formula there."""
    return text.replace("$", r"\$")


def labels(a, b):
    """Display names of two endoflow.Run objects: the engines, or engine and directory when both used the same one."""
    names = [ENGINE_NAMES.get(run.engine, run.engine) for run in (a, b)]
    if names[0] == names[1]:
        names = [f"{name} ({printable(shown(run.directory.resolve().name))})" for name, run in zip(names, (a, b))]
    return tuple(names) if names[0] != names[1] else (f"{names[0]} A", f"{names[1]} B")


def colours(a, b):
    """((light, dark), (light, dark)) colours of two runs."""
    first = ENGINE_COLOURS.get(a.engine, ENGINE_COLOURS["boundary-integral"])
    second = ENGINE_COLOURS.get(b.engine, ENGINE_COLOURS["phase-field"])
    return first, (SECOND_RUN_COLOUR if first == second else second)
