"""Figures that explain: the domain with a membrane of the standard case in it, and the diffuse layer's weights."""

import numpy as np
from scipy.integrate import trapezoid

from results import ink, tables
from results.places import scheme_constant


def domain():
    """The cylinder, both fluids, the membrane at 0.5 µs with its coat, its normal, the pin band."""
    rows = tables.read("standard-shape").rows
    r, z, c = (np.array([row[key] for row in rows]) for key in ("r_nm", "z_nm", "c"))
    figure, axes = ink.panels(size=(4.6, 4.6))
    axes.fill_between((0, 80), 0, 160, color=ink.SECOND_TINT[0])
    axes.fill(np.append(r, (80, 0)), np.append(z, (0, 0)), color=ink.TINT[0])
    axes.plot(r, z, color=ink.FAINT[0], linewidth=2)
    coat = c > 0.5
    axes.plot(r[coat], z[coat], color=ink.DIFFUSE[0], linewidth=4, solid_capstyle="butt")
    axes.plot((80, 80), (z[-1] - 5, z[-1] + 5), color=ink.INK[0], linewidth=5, solid_capstyle="butt")
    axes.axvline(0, color=ink.FAINT[0], linewidth=1, linestyle="-.")
    foot = int(np.argmin(np.abs(r - 55) + (z > z[-1] + 8) * 99))
    axes.annotate("n", (r[foot], z[foot] + 16), ha="center", va="bottom")
    axes.annotate("", (r[foot], z[foot] + 16), (r[foot], z[foot]), arrowprops={"arrowstyle": "->", "color": ink.INK[0]})
    for text, place in (("cell: ν₂, φ < 0", (40, 142)), ("extracellular: ν₁, φ > 0", (40, 18)), ("pin band", (76, z[-1] - 12)), ("coat", (26, z.max() + 3))):
        axes.annotate(text, place, ha="right" if text == "pin band" else "center")
    axes.annotate("membrane flows in at the rim", (78, z[-1] - 24), ha="right")
    axes.set_xlim(-2, 84)
    axes.set_ylim(-2, 162)
    axes.set_aspect("equal")
    axes.grid(visible=False)
    axes.set_xlabel("r (nm)")
    axes.set_ylabel("z (nm)")
    return figure


def layer():
    """δ, δ_Γ (equal viscosities), δ_N and δ_E through the layer, and on a logarithmic axis where they are cut."""
    w2, w4, weight_cut, tail_cut = map(scheme_constant, ("equal_square", "equal_fourth", "weight_cut", "tail_cut"))
    x = np.linspace(-6, 6, 961)
    phi = np.tanh(x / np.sqrt(2))
    w = (1 - phi**2) ** 2
    delta = 3 / (4 * np.sqrt(2)) * w

    def weight(w2, w4):
        return (1 - w2 / 5 - 3 * w4 / 35 + w2 * phi**2 + w4 * phi**4) * delta * w / (w + weight_cut)

    def moments(values):
        return np.array([trapezoid(values * np.abs(x) ** power, x) for power in (2, 3)])

    membrane, none = weight(w2, w4), moments(weight(0, 0))
    by_coefficient = np.column_stack([moments(weight(1, 0)) - none, moments(weight(0, 1)) - none])
    normal = weight(*np.linalg.solve(by_coefficient, -none))
    energy = delta * w / (w + tail_cut)
    energy /= trapezoid(energy, x)
    looks = ((delta, "δ", ink.FAINT, "-", 3), (membrane, "$δ_Γ$", ink.SHARP, "-", 1.6), (normal, "$δ_N$", ink.THIRD, "-", 1.2), (energy, "$δ_E$", ink.DIFFUSE, "--", 1.6))
    figure, grid = ink.panels(1, 2, (7.2, 2.9))
    for axes, size in zip(grid, (np.asarray, np.abs)):
        for values, label, colour, line, width in looks:
            axes.plot(x, size(values), label=label, color=colour[0], linestyle=line, linewidth=width)
        axes.set_xlabel("ψ/ε")
    grid[0].set_title("weights times ε")
    grid[0].set_xlim(-4, 4)
    grid[0].legend()
    grid[1].set_title("their size")
    grid[1].set_yscale("log")
    grid[1].set_ylim(1e-9, 5)
    return figure


#: {name of the file: (title, what draws it, the tables it shows)}.
SCHEMATICS = {
    "domain": ("The domain in the meridian plane, with the membrane of the standard case at 0.5 µs", domain, ("standard-shape",)),
    "layer": ("The weights of the diffuse layer", layer, ()),
}
