"""matplotlib.pyplot off screen and in the project's style: whoever draws takes `plt` from here."""

import matplotlib
import matplotlib.pyplot as plt

from comparisons.drawing import style

matplotlib.use("Agg")
matplotlib.rcParams.update(style.RC)

__all__ = ["plt"]
