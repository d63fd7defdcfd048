"""Plots, cards and table of the thermal noise about a run, for the page of `endoflow modes`."""

import numpy as np

from comparisons.drawing import style
from comparisons.drawing.axes import distance, mark_time
from comparisons.drawing.style import plt
from comparisons.page import html
from comparisons.page.html import figures, quantity, table

#: Panels of the picture of the membrane with its noise.
PANELS = 4

COLOUR, INHERITED = style.ENGINE_COLOURS["boundary-integral"][0], style.ENGINE_COLOURS["phase-field"][0]


def part(noise, modes):
    """What an endoflow.Noise is on the page, an html.Part; modes: the azimuthal modes of the picture in space."""
    plots = {
        "noise_histories": ("Thermal noise: one standard deviation about the run", histories(noise)),
        "noise_spreads": ("Thermal noise that the axisymmetric run does not have", spreads(noise)),
        "noise_shapes": ("The membrane with one standard deviation of its thermal noise", shapes(noise)),
    }
    frames = [frame(meridian, modes) for meridian in noise.meridians]
    return html.Part(plots, cards(noise), [("Thermal noise", noise_table(noise))], frames)


def frame(meridian, modes):
    """What the picture in space needs of a moment: the spread by each mode over its largest value, and that, nm."""
    sigmas = [meridian.rms[m] for m in modes]
    _, _, *noise = html.curves(meridian.r, meridian.z, *(sigma / sigma.max() for sigma in sigmas))
    return {"noise": noise, "sigmas": [float(f"{sigma.max():.3g}") for sigma in sigmas]}


def mark_times(axes, noise):
    """Dotted lines at budding, and where linear noise ends."""
    mark_time(axes, noise.budding)
    mark_time(axes, noise.linear_until, "--")


def histories(noise):
    """Neck and height with their bands: all noise, and what fluctuations of the start have left."""
    figure, panels = plt.subplots(1, 2, figsize=(10.6, 3.8), layout="constrained")
    quantities = (("Neck radius (nm)", "neck_radius_nm", "neck"), ("Height of the pole (nm)", "height_nm", "height"))
    for axes, (title, column, name) in zip(panels, quantities):
        mean = noise.table[column]
        for kind, colour, label in (("rms", COLOUR, "± σ"), ("inherited", INHERITED, "± σ of the start's alone")):
            spread = noise.table[f"{name}_{kind}_nm"]
            axes.fill_between(noise.times, mean - spread, mean + spread, color=colour, alpha=0.3, linewidth=0, label=label)
        axes.plot(noise.times, mean, color=COLOUR)
        if noise.ensemble is not None:
            drawn = {"color": INHERITED, "fmt": "none", "capsize": 2, "linewidth": 1}
            spread = noise.ensemble[f"{name}_rms_nm"]
            axes.errorbar(noise.ensemble["time_us"], mean, spread, label="of nonlinear runs from random starts", **drawn)
        axes.set(title=title, xlabel="time (µs)")
        mark_times(axes, noise)
    panels[0].set_ylim(bottom=0)
    panels[1].legend(fontsize=8, loc="lower right")
    return figure


def spreads(noise):
    """Sideways motion, and ellipticity of bud and neck."""
    figure, panels = plt.subplots(1, 3, figsize=(10.6, 3.4), layout="constrained")
    quantities = (
        ("Sideways motion, σ of x (nm)", "sideways_rms_nm", "sideways_inherited_nm"),
        ("Ellipticity of the bud, σ", "ellipticity_rms", "ellipticity_inherited"),
        ("Ellipticity of the neck, σ", "neck_ellipticity_rms", "neck_ellipticity_inherited"),
    )
    for axes, (title, total, inherited) in zip(panels, quantities):
        axes.plot(noise.times, noise.table[total], color=COLOUR, label="all noise")
        axes.plot(noise.times, noise.table[inherited], color=INHERITED, linestyle="--", label="of the start's alone")
        axes.set(title=title, xlabel="time (µs)")
        axes.set_ylim(bottom=0)
        mark_times(axes, noise)
    panels[0].legend(fontsize=8)
    return figure


def shapes(noise):
    """Meridians with the band of all modes along their normals, at times up to budding."""
    chosen = np.unique(np.linspace(0, noise.last_index, PANELS).round().astype(int))
    figure, panels = plt.subplots(
        1, len(chosen), figsize=(10.6, 3.4), sharex=True, sharey=True, squeeze=False, layout="constrained"
    )
    for axes, meridian in zip(panels.flat, (noise.meridians[i] for i in chosen)):
        edges = [
            (meridian.r + side * meridian.total * meridian.normal_r, meridian.z + side * meridian.total * meridian.normal_z)
            for side in (1, -1)
        ]
        for mirror in (-1, 1):
            (outer_r, outer_z), (inner_r, inner_z) = edges
            band_r, band_z = np.concatenate((outer_r, inner_r[::-1])), np.concatenate((outer_z, inner_z[::-1]))
            axes.fill(mirror * band_r, band_z, color=COLOUR, alpha=0.3, linewidth=0)
            axes.plot(mirror * meridian.r, meridian.z, color=COLOUR, linewidth=1.2)
        axes.set(title=f"t = {meridian.time:.3g} µs", xlabel="r (nm)", aspect="equal")
        axes.xaxis.set_major_formatter(distance)
    return figure


def cards(noise):
    """Key numbers: (title, ready HTML value, note)."""
    found = []
    if noise.budding is not None:
        note = f"one standard deviation, σ(neck)/|dn/dt| at {noise.budding:.4g} µs and {noise.temperature:g} K"
        found.append(("Spread of the budding time", quantity(noise.budding_spread, 3, "µs"), note))
    if np.isfinite(noise.table["neck_rms_nm"]).any():
        never = noise.linear_until is None
        note = "the neck's spread stays below a third" if never else "the neck's spread is a third of its radius"
        found.append(("Linear noise ends", quantity(noise.linear_until, 3, "µs"), note))
    return found


def noise_table(noise):
    """Every spread at every time."""
    names = [name for name in noise.table if name != "time_us"]
    rows = [
        [f"{time:.4g}", *("–" if np.isnan(value := noise.table[name][i]) else figures(float(value), 3) for name in names)]
        for i, time in enumerate(noise.times)
    ]
    return table(["t (µs)", *(name.replace("_", " ") for name in names)], rows)
