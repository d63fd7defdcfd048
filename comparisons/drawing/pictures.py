"""Pictures of single membranes: mirrored, coloured by c, with velocity arrows."""

import textwrap
from collections import namedtuple

import numpy as np
from scipy.spatial import cKDTree

from comparisons.drawing import plots, style
from comparisons.drawing.axes import distance, half_width, vertical_range
from comparisons.drawing.style import plt
from endoflow.curves import arc_length

#: Distance of arrows along the membrane, and of those in the fluid, nm.
ARROW_SPACING, FLUID_SPACING = 8.0, 9.0

#: A panel: title; Shape, or a sentence saying why there is none; arrows (r, z, u_r, u_z) or None; another Shape for a thin line, or None.
Panel = namedtuple("Panel", "title shape arrows other", defaults=(None, None))

#: Letters in a line of a panel's sentence.
WRAP = 34

#: Colour of arrows and of sentences in empty panels.
ARROW, MUTED = "#1B222C", "#777777"


def gallery(rows, margin=7.0):
    """A figure of panels. rows: [(row title, [Panel])]; margin: nm below and above all membranes."""
    shapes = [panel.shape for _, panels in rows for panel in panels if not isinstance(panel.shape, str)]
    z_range = vertical_range(shapes, margin) if shapes else (60.0, 140.0)
    rim = half_width(shapes) if shapes else 80.0
    columns = max(len(panels) for _, panels in rows)
    width = min(3.1, 12.4 / columns)
    height = len(rows) * (0.45 + width * (z_range[1] - z_range[0]) / (2 * rim)) + 0.35
    figure, grid = plt.subplots(
        len(rows),
        columns,
        figsize=(columns * width + 1.5, height),
        sharex=True,
        sharey=True,
        squeeze=False,
        layout="constrained",
    )
    coloured = None
    for line, (title, panels) in zip(grid, rows):
        line[0].set_ylabel(title, weight="bold")
        for axes in line[len(panels) :]:
            axes.set_axis_off()
        for axes, panel in zip(line, panels):
            axes.set_title(panel.title)
            axes.set(xlim=(-rim, rim), ylim=z_range, aspect="equal")
            axes.xaxis.set_major_formatter(distance)
            if isinstance(panel.shape, str):
                _say(axes, panel.shape)
                continue
            coloured = draw_membrane(axes, panel.shape, z_range, rim, line_width=2.2)
            if panel.arrows is not None:
                draw_arrows(axes, *panel.arrows)
            if panel.other is not None:
                draw_line(axes, panel.other)
    if coloured is not None:
        bar = figure.colorbar(coloured, ax=grid, label="concentration c", shrink=0.9, aspect=20, pad=0.02)
        bar.outline.set_visible(False)
    return figure


def _say(axes, sentence):
    """A sentence in an empty panel."""
    axes.text(
        0.5,
        0.5,
        textwrap.fill(sentence, WRAP),
        transform=axes.transAxes,
        ha="center",
        va="center",
        color=MUTED,
        size=7.5,
    )
    axes.grid(False)


def draw_membrane(axes, shape, z_range, rim, line_width=3.0):
    """One membrane, both half-planes; returns the coloured lines."""
    for side in (-1, 1):
        lines = plots.draw_half(axes, shape, side, z_range, rim, line_width)
    axes.set_facecolor(style.CYTOPLASM)
    axes.grid(False)
    return lines


def draw_line(axes, shape):
    """A membrane as a thin dashed line, both half-planes."""
    for side in (-1, 1):
        axes.plot(side * shape.r, shape.z, color=ARROW, linewidth=0.9, linestyle=(0, (3, 2)), zorder=4)


def arrow_length(speed, fastest):
    """Length in nm of the arrow of a speed (nm/µs): logarithmic from style.SLOWEST_ARROW (0) to `fastest` (the longest)."""
    slowest = style.SLOWEST_ARROW
    span = np.log10(max(fastest, 10 * slowest) / slowest)
    return style.LONGEST_ARROW * np.clip(np.log10(np.maximum(speed, slowest) / slowest) / span, 0, 1)


def membrane_arrows(shape):
    """Arrows (r, z, u_r, u_z) of a Shape's velocity, ARROW_SPACING nm apart along it."""
    s = arc_length(shape.r, shape.z)
    at = np.arange(0.5 * ARROW_SPACING, s[-1], ARROW_SPACING)
    return tuple(np.interp(at, s, values) for values in (shape.r, shape.z, shape.u_r, shape.u_z))


def fluid_arrows(fields):
    """Arrows (r, z, u_r, u_z) of the velocity in endoflow.Fields, on a grid FLUID_SPACING nm apart."""
    r, z = np.meshgrid(
        *(np.arange(0.5 * FLUID_SPACING, values.max(), FLUID_SPACING) for values in (fields.r, fields.z)), indexing="ij"
    )
    nearest = cKDTree(np.column_stack((fields.r, fields.z))).query(np.column_stack((r.ravel(), z.ravel())))[1]
    velocity = fields["velocity"][nearest]
    return fields.r[nearest], fields.z[nearest], velocity[:, 0], velocity[:, 1]


def draw_arrows(axes, r, z, u, w):
    """Velocities in both half-planes: direction, and magnitude on a logarithmic scale that is noted in the panel."""
    speed = np.hypot(u, w)
    fastest, slowest = float(speed.max()), style.SLOWEST_ARROW
    length = arrow_length(speed, fastest) / np.maximum(speed, 1e-300)
    look = {"color": ARROW, "angles": "xy", "scale_units": "xy", "scale": 1, "width": 0.005, "zorder": 5}
    for side in (-1, 1):
        axes.quiver(side * r, z, side * u * length, w * length, **look)
    note = f"fastest {fastest:.3g} nm/µs" if fastest >= slowest else f"all below {slowest:g} nm/µs"
    box = {"facecolor": style.CYTOPLASM, "edgecolor": "none", "pad": 1.5, "alpha": 0.85}
    axes.text(0.02, 0.97, note, transform=axes.transAxes, va="top", size=7, color=ARROW, zorder=6, bbox=box)
