"""The azimuthal modes of a run: plots, surfaces, and report.html with the membrane in space."""

import json

import numpy as np
from matplotlib.colors import LinearSegmentedColormap

from comparisons.drawing import style
from comparisons.drawing.plots import save_all
from comparisons.drawing.style import plt
from comparisons.drawing.surfaces import Revolved
from comparisons.page import html, noise_plots
from comparisons.page.html import escaped, figures, quantity
from endoflow.curves import resample

#: From the lowest mode to the highest; lightness is monotone.
MODE_COLOURS = LinearSegmentedColormap.from_list("modes", ("#8E1068", "#0072B2", "#56B4A0", "#B9C76A"))

#: What the initial shapes are called.
INITIAL_TITLES = {
    "dome": "Displaced half-way to the coat's edge",
    "edge": "Displaced at the coat's edge",
    "sheet": "The whole sheet displaced",
    "coat": "The coat's edge out of round",
    "worst": "Worst displacement",
}

#: Largest displacement at the start, nm.
INITIAL_AMPLITUDE = 0.1

#: Distance of points along the membrane in the surfaces, nm.
SPACING = 1.2

#: Smallest displacement (nm) that the histories show.
SMALLEST_SHOWN = 1e-4

#: Columns and rows of the picture of the shapes; displacement (nm) that is drawn.
PANEL_TIMES, PANEL_MODES, DRAWN_DISPLACEMENT = 4, 3, 4.0

#: Points of a meridian in the moving picture, and digits of their numbers.
POINTS, DIGITS = 90, 3

SCRIPTS = ("theme.js", "modes_view.js", "modes.js")


def write_all(modes, directory):
    """Write the plots of an endoflow.Modes into directory (Path); returns {name: title}."""
    figures = {
        "modes_rates": ("Largest growth rate of each mode", rates(modes)),
        "modes_perturbations": ("What 0.1 nm becomes", perturbations(modes)),
        "modes_shapes": ("The fastest mode's displacement, drawn 4 nm large", shapes(modes)),
    }
    if modes.noise is not None:
        figures |= noise_plots.plots(modes.noise)
    return save_all(figures, directory)


def colours(modes):
    """{m: colour}."""
    return {m: MODE_COLOURS(i / max(1, len(modes.modes) - 1)) for i, m in enumerate(modes.modes)}


def mark_budding(axes, modes):
    """A dotted line at the time of budding."""
    if modes.budding is not None:
        axes.axvline(modes.budding, color="#888888", linewidth=0.9, linestyle=":")


def rates(modes):
    """All rates, and those about zero."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.6, 3.8), layout="constrained")
    for m, colour in colours(modes).items():
        for axes in (left, right):
            axes.plot(modes.times, modes.rates[m], color=colour, marker="o", markersize=3, label=f"m = {m}")
    for axes in (left, right):
        axes.axhline(0, color="#444444", linewidth=0.8)
        axes.set_xlabel("time (µs)")
        mark_budding(axes, modes)
    left.set_title("Growth rate (1/µs)")
    right.set_title("The same about zero")
    top = max(rate.max() for rate in modes.rates.values())
    right.set_ylim(-3, max(1.0, 1.15 * top))
    left.legend(ncols=2, fontsize=8)
    return figure


def perturbations(modes):
    """The largest displacement against time, one panel for each initial shape."""
    names = modes.initial_shapes
    figure, grid = plt.subplots(
        1, len(names), figsize=(3.1 * len(names), 3.4), sharey=True, layout="constrained", squeeze=False
    )
    for axes, name in zip(grid.flat, names):
        for m, colour in colours(modes).items():
            peak = modes.perturbations[m, name]["peak_nm"]
            axes.plot(modes.times, np.where(peak > 0, peak, np.nan), color=colour, label=f"m = {m}")
        axes.axhline(INITIAL_AMPLITUDE, color="#444444", linewidth=0.8, linestyle="--")
        axes.set_title(INITIAL_TITLES.get(name, name), fontsize=9)
        axes.set_xlabel("time (µs)")
        axes.set_yscale("log")
        axes.set_ylim(bottom=SMALLEST_SHOWN)
        mark_budding(axes, modes)
    grid.flat[0].set_ylabel("largest displacement (nm)")
    grid.flat[-1].legend(fontsize=7, ncols=2)
    return figure


def shapes(modes):
    """The meridian and both sides of the fastest mode, at times up to budding, for the lowest modes."""
    chosen = np.unique(np.linspace(0, modes.last_index, PANEL_TIMES).round().astype(int))
    rows = modes.modes[:PANEL_MODES]
    meridians = [modes.meridians[i] for i in chosen]
    low = min(meridian.z.min() for meridian in meridians) - 6
    high = max(meridian.z.max() for meridian in meridians) + 6
    rim = max(meridian.r.max() for meridian in meridians)
    figure, grid = plt.subplots(
        len(rows),
        len(chosen),
        figsize=(3.1 * len(chosen), 0.5 + len(rows) * 3.1 * (high - low) / (2 * rim) + 0.25 * len(rows)),
        sharex=True,
        sharey=True,
        squeeze=False,
        layout="constrained",
    )
    for line, m in zip(grid, rows):
        line[0].set_ylabel(f"m = {m}", weight="bold")
        for axes, meridian in zip(line, meridians):
            mode = meridian.modes[m]
            axes.set_title(f"t = {meridian.time:.3g} µs, {mode.growth:+.2f}/µs".replace("-", "−"), fontsize=9)
            axes.set(xlim=(-rim, rim), ylim=(low, high), aspect="equal")
            for side in (-1, 1):
                axes.plot(side * meridian.r, meridian.z, color="#999999", linewidth=1)
                # cos(m φ) at φ = 0 and at φ = π
                amount = DRAWN_DISPLACEMENT * (1 if side > 0 or m % 2 == 0 else -1) * mode.w
                r, z = meridian.r + amount * meridian.normal_r, meridian.z + amount * meridian.normal_z
                axes.plot(side * r, z, color=style.ENGINE_COLOURS["boundary-integral"][0], linewidth=1.6)
            axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
    for axes in grid[-1]:
        axes.set_xlabel("r (nm)")
    return figure


def surface(meridian, spacing=SPACING):
    """(points, quads, arrays) of an endoflow.modes.Meridian for a .vtp file: c and each mode's displacement (nm), vectors."""
    modes = sorted(meridian.modes)
    along = [meridian.modes[m].w for m in modes]
    r, z, n_r, n_z, c, *w = resample(
        meridian.r, meridian.z, spacing, meridian.normal_r, meridian.normal_z, meridian.c, *along
    )
    revolved = Revolved(r, z)
    normal = revolved.vectors(n_r, n_z)
    arrays = {"c": revolved.around(c)}
    for m, values in zip(modes, w):
        amount = revolved.around(values) * np.cos(m * revolved.azimuth)
        arrays[f"mode_{m}_displacement_nm"] = amount[:, None] * normal
    return revolved.points, revolved.quads, arrays


def modes_html(modes, basis, drawn, directory):
    """The page of an endoflow.Modes; basis: of the run; drawn: {plot: title}, written into directory (Path)."""
    sections = [
        ("Plots", html.plots(drawn, directory)),
        (f"Largest displacement (nm) {end_text(modes)}", perturbation_table(modes)),
        ("Largest growth rates (1/µs)", rate_table(modes)),
        *([("Thermal noise", noise_plots.noise_table(modes.noise))] if modes.noise is not None else []),
        *html.common_basis_section(basis),
    ]
    data = json.dumps(report_data(modes), allow_nan=False, separators=(",", ":"))
    return html.document(
        "endoflow modes",
        title="Does the bud stay round?: endoflow modes",
        heading="Does the bud stay round?",
        subtitle=escaped(
            f"Perturbations cos mφ of an axisymmetric run, m = {modes.modes[0]} to {modes.modes[-1]}, to {modes.times[-1]:.4g} µs"
        ),
        cards=html.card_section([*cards(modes), *(noise_plots.cards(modes.noise) if modes.noise is not None else [])]),
        sections=html.source("modes.html") + html.section_texts(sections),
        origin=f"in <code>{escaped(directory)}</code>",
        scripts=SCRIPTS,
        data=html.embedded(data),
    )


def end_text(modes):
    """ "at budding", or the last time."""
    return f"at {'budding' if modes.budding is not None else 'the end'}, {modes.times[modes.last_index]:.4g} µs"


def cards(modes):
    """The key numbers on top: (title, ready HTML value, note)."""
    round_modes = [m for m in modes.modes if m > 1]
    found = []
    for title, chosen in (("Sideways motion, m = 1", [m for m in modes.modes if m == 1]), ("Shape, m ≥ 2", round_modes)):
        if not chosen:
            continue
        m, index = max(
            ((m, int(np.argmax(modes.rates[m]))) for m in chosen), key=lambda entry: modes.rates[entry[0]][entry[1]]
        )
        note = f"largest growth rate: m = {m} at {modes.times[index]:.3g} µs"
        found.append((title, quantity(float(modes.rates[m][index]), 3, "1/µs"), note))
        peaks = {
            (m, name): modes.perturbations[m, name]["peak_nm"][modes.last_index]
            for m in chosen
            for name in modes.initial_shapes
        }
        m, name = max(peaks, key=peaks.get)
        note = f"at most, {end_text(modes)}: m = {m}, “{name}” in the table below"
        found.append((f"{INITIAL_AMPLITUDE:g} nm becomes", quantity(float(peaks[m, name]), 3, "nm"), note))
    return found


def perturbation_table(modes):
    """What every initial shape of 0.1 nm has become by budding."""
    rows = []
    for name in modes.initial_shapes:
        values = [float(modes.perturbations[m, name]["peak_nm"][modes.last_index]) for m in modes.modes]
        title = f"{INITIAL_TITLES.get(name, name)} (“{name}”)"
        rows.append([escaped(title), *(figures(value, 3) for value in values)])
    return html.table([f"{INITIAL_AMPLITUDE:g} nm at the start", *(f"m = {m}" for m in modes.modes)], rows)


def rate_table(modes):
    """The rate of each mode at each time."""
    rows = [
        [f"{time:.4g}", *(figures(float(modes.rates[m][i]), 4) for m in modes.modes)]
        for i, time in enumerate(modes.times)
    ]
    return html.table(["t (µs)", *(f"m = {m}" for m in modes.modes)], rows)


def report_data(modes):
    """What the picture in space needs: for each time the meridian and the modes, POINTS numbers each."""

    def rounded(values):
        return [round(float(value), DIGITS) for value in values]

    frames = []
    noisy = [None] * len(modes.meridians) if modes.noise is None else modes.noise.meridians
    for meridian, noise in zip(modes.meridians, noisy):
        chosen = [meridian.modes[m] for m in modes.modes]
        sigmas = [] if noise is None else [noise.rms[m] for m in modes.modes]
        length = np.concatenate(([0], np.cumsum(np.hypot(np.diff(meridian.r), np.diff(meridian.z)))))[-1]
        r, z, n_r, n_z, c, *w = resample(
            meridian.r,
            meridian.z,
            length / (POINTS - 1) * (1 + 1e-9),
            meridian.normal_r,
            meridian.normal_z,
            meridian.c,
            *(shapes.w for shapes in chosen),
            *(shapes.worst / max(np.abs(shapes.worst).max(), 1e-300) for shapes in chosen),
            *(sigma / sigma.max() for sigma in sigmas),
        )
        count = len(chosen)
        frames.append(
            {
                "time": meridian.time,
                "r": rounded(r),
                "z": rounded(z),
                "nr": rounded(n_r),
                "nz": rounded(n_z),
                "c": rounded(c),
                "fastest": [rounded(values) for values in w[:count]],
                "worst": [rounded(values) for values in w[count : 2 * count]],
                "rates": [float(f"{shapes.growth:.4g}") for shapes in chosen],
                "peaks": [float(f"{np.abs(shapes.worst).max():.3g}") for shapes in chosen],
            }
        )
        if noise is not None:
            frames[-1] |= {
                "noise": [rounded(values) for values in w[2 * count :]],
                "sigmas": [float(f"{sigma.max():.3g}") for sigma in sigmas],
            }
    return {"modes": modes.modes, "frames": frames, "start": modes.last_index, "budding": modes.budding}
