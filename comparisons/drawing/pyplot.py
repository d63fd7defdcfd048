"""matplotlib.pyplot off screen and in the project's style: whoever draws takes `plt` from here."""

import warnings

import matplotlib
import matplotlib.pyplot as plt

from comparisons.drawing import style

matplotlib.use("Agg")
matplotlib.rcParams.update(style.RC)

# A letter of a name that the font lacks is drawn as a box; pages hold the name as text.
warnings.filterwarnings("ignore", message="Glyph .* missing from current font")

__all__ = ["plt"]
