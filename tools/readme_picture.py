#!/usr/bin/env python3
"""The picture on top of the README: python3 tools/readme_picture.py DIR_A DIR_B [-o docs/images/hero.png]

Both membranes mirrored at four moments of budding, run A on the left and run B on the right half-planes.
Exit codes as `endoflow compare`.
"""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

sys.path[:0] = [str(ROOT), str(ROOT / "python")]

#: Moments shown, as fractions of the later budding time (or of the common time when no run buds).
MOMENTS = (0.06, 0.2, 0.5, 1.0)

#: Half the width (nm) of each panel: the flat membrane further out is left away.
HALF_WIDTH = 54.0


def picture(a, b):
    """The figure for two endoflow.Run objects."""
    import matplotlib.pyplot as plt
    import numpy as np

    from comparisons.drawing import plots, style
    from comparisons.measures.metrics import common_times

    labels, colours = style.labels(a, b), [light for light, _ in style.colours(a, b)]
    covered = common_times(a, b)
    budding = max((run.event_time("budding") or 0.0 for run in (a, b))) or covered[-1]
    times = np.clip(np.array(MOMENTS) * budding, covered[0], covered[-1])
    pairs = [(a.shape_at(t), b.shape_at(t)) for t in times]
    z_range = plots.vertical_range([shape for pair in pairs for shape in pair], 7.0)
    width = 13.0
    height = 0.95 + (width - 0.9) / len(times) * (z_range[1] - z_range[0]) / (2 * HALF_WIDTH)
    figure, panels = plt.subplots(1, len(times), figsize=(width, height))
    figure.subplots_adjust(left=0.01, right=0.93, bottom=0.13 / height, top=1 - 0.78 / height, wspace=0.05)
    for axes, time, pair in zip(panels, times, pairs):
        lines = plots.draw_pair(axes, pair, colours, z_range, HALF_WIDTH, line_width=4.5)
        axes.set_axis_off()
        axes.add_patch(plt.Rectangle((0, 0), 1, 1, transform=axes.transAxes, color=style.CYTOPLASM, zorder=0))
        axes.set_title(f"{time:.2f} µs", loc="center", fontsize=12, weight="normal", color="#444444")
    _scale_bar(panels[0], z_range)
    _colour_bar(figure, lines, height)
    for x, side, label, colour in ((0.465, "right", labels[0], colours[0]), (0.475, "left", labels[1], colours[1])):
        text = f"{label} ◀" if side == "right" else f"▶ {label}"
        figure.text(x, 1 - 0.22 / height, text, ha=side, va="center", fontsize=15, weight="bold", color=colour)
    return figure


def _scale_bar(axes, z_range):
    """20 nm, in the upper left corner."""
    left, low = -0.93 * HALF_WIDTH, z_range[1] - 8
    axes.plot([left, left + 20], [low, low], color="#444444", linewidth=2.5, solid_capstyle="butt", zorder=5)
    axes.text(left + 10, low - 2, "20 nm", ha="center", va="top", fontsize=10, color="#444444")


def _colour_bar(figure, lines, height):
    """The concentration scale at the right edge."""
    axes = figure.add_axes([0.94, 0.3 / height, 0.008, 1 - 1.4 / height])
    bar = figure.colorbar(lines, cax=axes, ticks=[0, 1])
    bar.outline.set_visible(False)
    bar.ax.set_yticklabels(["bare", "coated"], fontsize=10, color="#444444")
    bar.ax.tick_params(length=0)


def main(arguments):
    """Run the command; returns its exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("a", type=Path, metavar="DIR_A")
    parser.add_argument("b", type=Path, metavar="DIR_B")
    parser.add_argument(
        "-o", "--output", type=Path, default=ROOT / "docs" / "images" / "hero.png"
    )
    options = parser.parse_args(arguments)

    import endoflow
    from comparisons.measures.metrics import NoCommonTimeError

    try:
        figure = picture(endoflow.load(options.a), endoflow.load(options.b))
        options.output.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(options.output, dpi=150)
    except (endoflow.EndoflowError, NoCommonTimeError) as error:
        print(error, file=sys.stderr)
        return 4
    except OSError as error:
        print(f"{error.filename}: {error.strerror}; choose another file with -o", file=sys.stderr)
        return 4
    print(options.output)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
