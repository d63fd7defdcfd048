"""report.html of a run's azimuthal modes, with the membrane in space."""

import json

import numpy as np

from comparisons.drawing.mode_plots import INITIAL_AMPLITUDE, INITIAL_TITLES
from comparisons.page import report
from comparisons.page.numbers import escaped, figures, quantity
from comparisons.page.study_report import common_basis_section
from endoflow.curves import resample

#: Points of a meridian in the moving picture, and digits of their numbers.
POINTS, DIGITS = 90, 3

SCRIPTS = ("theme.js", "modes_view.js", "modes.js")


def modes_html(modes, basis, drawn, directory):
    """The page of an endoflow.Modes; basis: of the run; drawn: {plot: title}, written into directory (Path)."""
    boxes = "".join(
        f"<div><dt>{escaped(title)}</dt><dd>{value}<small>{escaped(note)}</small></dd></div>"
        for title, value, note in cards(modes)
    )
    plots = "".join(report.plot(directory / f"{name}.svg", title) for name, title in drawn.items())
    sections = [
        ("Plots", plots),
        (f"Largest displacement (nm) {end_text(modes)}", perturbation_table(modes)),
        ("Largest growth rates (1/µs)", rate_table(modes)),
        *common_basis_section(basis),
    ]
    data = json.dumps(report_data(modes), allow_nan=False, separators=(",", ":")).replace("</", "<\\/")
    return report.page(
        "endoflow modes",
        title="Does the bud stay round?: endoflow modes",
        heading="Does the bud stay round?",
        subtitle=escaped(
            f"Perturbations cos mφ of an axisymmetric run, m = {modes.modes[0]} to {modes.modes[-1]}, to {modes.times[-1]:.4g} µs"
        ),
        warnings="",
        cards=boxes,
        sections=report.source("modes.html")
        + "\n".join(f"<section><h2>{escaped(title)}</h2>{body}</section>" for title, body in sections),
        origin=f"in <code>{escaped(directory)}</code>",
        scripts=SCRIPTS,
        data=f'<script type="application/json" id="report-data">{data}</script>',
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
        rows.append(("", [escaped(title), *(figures(value, 3) for value in values)]))
    return report.table([f"{INITIAL_AMPLITUDE:g} nm at the start", *(f"m = {m}" for m in modes.modes)], rows)


def rate_table(modes):
    """The rate of each mode at each time."""
    rows = [
        ("", [f"{time:.4g}", *(figures(float(modes.rates[m][i]), 4) for m in modes.modes)])
        for i, time in enumerate(modes.times)
    ]
    return report.table(["t (µs)", *(f"m = {m}" for m in modes.modes)], rows)


def report_data(modes):
    """What the picture in space needs: for each time the meridian and the modes, POINTS numbers each."""

    def rounded(values):
        return [round(float(value), DIGITS) for value in values]

    frames = []
    for meridian in modes.meridians:
        chosen = [meridian.modes[m] for m in modes.modes]
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
                "worst": [rounded(values) for values in w[count:]],
                "rates": [float(f"{shapes.growth:.4g}") for shapes in chosen],
                "peaks": [float(f"{np.abs(shapes.worst).max():.3g}") for shapes in chosen],
            }
        )
    return {"modes": modes.modes, "frames": frames, "start": modes.last_index, "budding": modes.budding}
