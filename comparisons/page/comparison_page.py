"""The page of a comparison of two runs, and what it embeds for its scripts: curves and numbers at every frame, as base64 float32."""

import base64
import json

import numpy as np

from comparisons.drawing import plots, style
from comparisons.drawing.axes import half_width, long_after_budding, time_axis
from comparisons.files import write_text
from comparisons.measures.metrics import ENGINE_SECTIONS, compared, flattened, last_budding
from comparisons.measures.quantities import COMPARED, DRAWN
from comparisons.measures.words import basis
from comparisons.page import html
from comparisons.page.html import code, escaped, figures, percent, quantity, setting
from endoflow.curves import resample

SCRIPTS = ("theme.js", "data.js", "colours.js", "membrane_view.js", "charts.js", "readout.js", "player.js", "main.js")

#: Columns of the table of all output times: key, entry of a pair (or None), heading.
TIME_COLUMNS = (
    ("time_us", None, "t (µs)"),
    ("mean_distance_nm", None, "mean distance (nm)"),
    ("hausdorff_distance_nm", None, "Hausdorff (nm)"),
    ("interpolation_error_nm", None, "of that, interpolation (nm)"),
    ("neck_radius_nm", "a", "neck A (nm)"),
    ("neck_radius_nm", "b", "neck B (nm)"),
    ("bud_diameter_nm", "a", "diameter A (nm)"),
    ("bud_diameter_nm", "b", "diameter B (nm)"),
    ("concentration_l1_relative", None, "∫|Δc| dA / ∫c dA"),
    ("concentration_max", None, "max |Δc|"),
)

#: Points of each embedded curve, and about how many frames the slider has.
POINTS = 220
FRAMES = 160

#: Every how many points of a curve has a velocity arrow.
ARROW_STRIDE = 8

#: Least height (nm) of the picture of the membranes.
LEAST_HEIGHT = 60.0

#: Most points of an embedded history line.
LINE_POINTS = 500


def write_page(a, b, metrics, directory):
    """Write plots and report.html of two endoflow.Run objects and their metrics into directory (Path)."""
    labels = [metrics["runs"][key]["label"] for key in "ab"]
    drawn = plots.write_all(a, b, metrics, labels, directory)
    write_text(directory / "report.html", report_html(a, b, metrics, drawn, directory))


def report_html(a, b, metrics, drawn, directory):
    """The page's text; drawn: {plot: title}."""
    labels = [metrics["runs"][key]["label"] for key in "ab"]
    data = json.dumps(report_data(a, b, metrics), allow_nan=False, separators=(",", ":"))
    sections = html.filled(
        html.source("comparison.html"),
        sides="".join(f'<span class="ink-{key}">{escaped(label)}</span>' for key, label in zip("ab", labels)),
        canvas_label=escaped(
            f"Both membranes at the time shown: {labels[0]} left, {labels[1]} right, coloured by concentration"
        ),
        readout_heads="".join(
            f'<th scope="col" class="ink-{key}">{escaped(label)}</th>' for key, label in zip("ab", labels)
        ),
        cards=html.card_section(cards(metrics)),
        legend=legend(labels),
        metrics_table=metrics_table(metrics, labels),
        times=html.folded("All output times", times_table(metrics["times"])),
        plots=html.plots(drawn, directory),
        basis_table=basis_table(a, b, labels),
        parameters=parameters(a, b, labels),
        provenance=html.folded(html.PROVENANCE, html.provenance_table([a.record, b.record], labels)),
    )
    return html.document(
        "endoflow compare",
        title=escaped(f"{labels[0]} and {labels[1]}: endoflow comparison"),
        heading=escaped(f"{labels[0].capitalize()} and {labels[1]}"),
        finding=f'<p class="finding">{escaped(metrics["finding"])}</p>',
        subtitle=subtitle(a, b, metrics),
        warnings=html.warning_box(metrics["warnings"]),
        sections=sections,
        origin="from " + " and ".join(f"<code>{escaped(str(run.directory))}</code>" for run in (a, b)),
        scripts=SCRIPTS,
        colours=run_colours(a, b),
        data=html.embedded(data),
    )


def run_colours(a, b):
    """Style sheet rules that give each run its engine's colour, on light and on dark ground."""
    (a_light, a_dark), (b_light, b_dark) = style.colours(a, b)
    return (
        f":root {{ --run-a: {a_light}; --run-b: {b_light}; }}\n"
        f':root[data-theme="dark"] {{ --run-a: {a_dark}; --run-b: {b_dark}; }}\n'
    )


def subtitle(a, b, metrics):
    """Case name and the time both runs cover."""
    first, last = metrics["common_interval_us"]
    names = dict.fromkeys(str(run.parameters.get("case", {}).get("name", "")) for run in (a, b))
    case = " / ".join(name for name in names if name)
    return escaped((f"Case “{case}” · " if case else "") + f"compared from {first:g} to {last:g} µs")


def cards(metrics):
    """The key numbers on top: (title, ready HTML value, note, class)."""
    labels = [metrics["runs"][key]["label"] for key in "ab"]
    budding, found = metrics["budding"], metrics["summary"]
    relative = (
        f"{percent(budding['relative_difference'])} between the runs"
        if budding["difference_us"] is not None
        else "not in both runs"
    )
    worst = f"at {setting(found['max_hausdorff_distance_time_us'], 4)} µs{interpolation_note(found)}"
    return [
        (f"Budding, {labels[0]}", quantity(budding["a_us"], 4, "µs"), "neck radius below 5 nm", "ink-a"),
        (f"Budding, {labels[1]}", quantity(budding["b_us"], 4, "µs"), "neck radius below 5 nm", "ink-b"),
        ("Budding time difference", quantity(budding["difference_us"], 3, "µs"), relative, ""),
        ("Mean distance", quantity(found["time_mean_of_mean_distance_nm"], 3, "nm"), "along the curves, over time", ""),
        ("Largest Hausdorff distance", quantity(found["max_hausdorff_distance_nm"], 3, "nm"), worst, ""),
    ]


def interpolation_note(found):
    """What part of a distance may be interpolation in time, as a continuation of a sentence; found: the summary."""
    if not found["includes_interpolated_shapes"]:
        return ""
    error = found["interpolation_error_nm"]
    return ", interpolated shapes" if error is None else f"; up to {figures(error, 2)} nm of it interpolation"


def legend(labels):
    """Line samples of both runs."""
    dashes = (' stroke-width="4"', ' stroke-width="2" stroke-dasharray="6 4"')
    return "".join(
        f'<span class="key"><svg width="34" height="10" aria-hidden="true"><line x1="1" x2="33" y1="5" y2="5" '
        f'stroke="var(--run-{key})"{dash}/></svg>{escaped(label)}</span>'
        for key, label, dash in zip("ab", labels, dashes)
    )


def metrics_table(metrics, labels):
    """Every quantity at the last common time, with its largest relative difference over all times."""
    last = metrics["times"][-1]
    rows = []
    for name, one in COMPARED.items():
        entry = last[name]
        scaled = [None if entry[key] is None else entry[key] * one.factor for key in ("a", "b", "difference")]
        largest = metrics["summary"]["max_relative_difference"][name]
        cells = [
            escaped(one.label),
            *(figures(v) for v in scaled),
            percent(entry["relative_difference"]),
            percent(largest).lstrip("+"),
        ]
        rows.append(cells)
    end = f"at {setting(last['time_us'], 4)} µs"
    heads = [
        "",
        *(f"{escaped(label)}<br>{end}" for label in labels),
        f"difference<br>{end}",
        f"relative<br>{end}",
        "largest relative<br>at any time",
    ]
    return html.table(heads, rows)


def times_table(records):
    """The records of metrics.json as rows."""
    rows = [
        [figures(r[key] if entry is None else r[key][entry]) for key, entry, _ in TIME_COLUMNS] for r in records
    ]
    return html.table([heading for *_, heading in TIME_COLUMNS], rows)


def basis_table(a, b, labels):
    """What the numbers of both runs rest on."""
    of_a, of_b = basis(a.record), basis(b.record)
    rows = [[escaped(what), escaped(of_a[what]), escaped(of_b[what])] for what in of_a]
    return html.table(["", *map(escaped, labels)], rows, "text")


def parameters(a, b, labels):
    """All parameters of both runs; those that differ are marked, an engine's own only between runs of one engine."""
    flat_a, flat_b = flattened(a.parameters), flattened(b.parameters)
    rows, marked = [], []
    for number, key in enumerate(dict.fromkeys([*flat_a, *flat_b])):
        values = flat_a.get(key), flat_b.get(key)
        if values[0] != values[1] and (a.engine == b.engine or key.split(".")[0] not in ENGINE_SECTIONS):
            marked.append(number)
        rows.append([code(key), *map(setting, values)])
    table = html.table(["", *map(escaped, labels)], rows, "text", marked)
    return html.folded("All parameters of both runs", table, unfolded=bool(marked))


def report_data(a, b, metrics):
    """The dict that assets/data.js unpacks, for two endoflow.Run objects and their metrics."""
    times = frame_times(metrics)
    pairs = [(a.shape_at(t), b.shape_at(t)) for t in times]
    output_times = [record["time_us"] for record in metrics["times"] if not record["interpolated"]]
    return {
        "times": packed(times),
        "interpolated": [int(not np.isclose(output_times, t, rtol=1e-9, atol=1e-9).any()) for t in times],
        "startTime": start_time(metrics),
        "points": POINTS,
        "rim": float(half_width([shape for pair in pairs for shape in pair])),
        "closed": pairs[0][0].closed,
        "heightRange": height_range(pairs),
        "concentrationStops": [style.CONCENTRATION_STOPS, style.CONCENTRATION_STOPS_DARK],
        "runs": [packed_curves([pair[side] for pair in pairs]) for side in (0, 1)],
        "arrows": arrow_scale(pairs),
        "charts": charts(a, b, metrics),
        "timeAxis": time_axis(metrics),
        "readout": readout(a, b, metrics, times),
    }


def packed(values):
    """Base64 text of values (any shape) as little-endian float32."""
    return base64.b64encode(np.asarray(values, dtype="<f4").tobytes()).decode("ascii")


def frame_times(metrics):
    """Times (µs) of the frames: half of them before budding if that is early; output times where they are near."""
    first, last = metrics["common_interval_us"]
    if last <= first:
        return np.array([last])
    parts = [np.linspace(first, last, FRAMES)]
    split = 1.25 * (last_budding(metrics) or 0)
    if long_after_budding(metrics) and first < split < last:
        parts = [np.linspace(first, split, FRAMES // 2), np.linspace(split, last, FRAMES // 2)]
    output_times = np.array([record["time_us"] for record in metrics["times"]])
    return np.unique(np.concatenate([moved_to_output_times(part, output_times) for part in parts]))


def moved_to_output_times(times, output_times):
    """Evenly spaced times (n,), each replaced by the nearest output time when that is within half a spacing."""
    nearest = output_times[np.argmin(np.abs(output_times[:, None] - times), axis=0)]
    return np.where(np.abs(nearest - times) <= 0.5 * (times[1] - times[0]), nearest, times)


def start_time(metrics):
    """The output time (µs) the report opens with: shortly before budding, else the end."""
    wanted = 0.75 * last_budding(metrics) if last_budding(metrics) else metrics["common_interval_us"][1]
    return min((record["time_us"] for record in metrics["times"]), key=lambda time: abs(time - wanted))


def height_range(pairs):
    """Lowest and highest z (nm) shown: room around all shapes, and enough of it for a membrane that stays flat."""
    z = np.concatenate([shape.z for pair in pairs for shape in pair])
    lowest = z.min() - 10
    return [float(lowest), float(max(z.max() + 10, lowest + LEAST_HEIGHT))]


def packed_curves(shapes):
    """r, z, c of shapes at POINTS points each and u_r, u_z at every ARROW_STRIDE-th of them, frame after frame."""
    fields = [even_points(shape) for shape in shapes]
    curves = {name: packed([frame[i] for frame in fields]) for i, name in enumerate(("r", "z", "c"))}
    arrows = {name: packed([frame[i][::ARROW_STRIDE] for frame in fields]) for i, name in ((3, "u_r"), (4, "u_z"))}
    return {**curves, **arrows}


def arrow_scale(pairs):
    """How velocities (nm/µs) become arrows (nm): logarithmic from `slowest`, of length 0, to `fastest`, the longest."""
    fastest = max(float(np.hypot(shape.u_r, shape.u_z).max()) for pair in pairs for shape in pair)
    slowest = style.SLOWEST_ARROW
    scale = {"slowest": slowest, "fastest": max(fastest, 10 * slowest), "longest": style.LONGEST_ARROW}
    return {"stride": ARROW_STRIDE, **scale}


def even_points(shape):
    """r, z, c, u_r, u_z (POINTS,) of a Shape at equal arc length."""
    fine = resample(shape.r, shape.z, 0.1, shape.c, shape.u_r, shape.u_z)
    at = np.linspace(0, len(fine[0]) - 1, POINTS)
    return [np.interp(at, np.arange(len(values)), values) for values in fine]


def charts(a, b, metrics):
    """One entry per chart: the histories of both runs, then the distances."""
    entries = []
    for column, plot in DRAWN.items():
        lines = [(run.history["time_us"], run.history[column] * plot.factor) for run in (a, b)]
        level = style.BUDDING_NECK_RADIUS if column == "neck_radius_nm" else None
        entries.append(
            chart(plot.title, plot.plot_unit, lines, wants_log=plot.logarithmic, level=level, from_zero=level is not None)
        )
    records = compared(metrics["times"])
    time = np.array([record["time_us"] for record in records])
    lines = [
        (time, np.array([record[key] for record in records])) for key in ("hausdorff_distance_nm", "mean_distance_nm")
    ]
    entries.append(chart("Distance: Hausdorff, mean", "nm", lines, neutral=True, from_zero=True))
    return entries


def chart(title, unit, lines, wants_log=False, level=None, from_zero=False, neutral=False):
    """One chart; lines is a list of (time, value) arrays, which are thinned."""
    kept = [thinned(time, value) for time, value in lines]
    values = np.concatenate([value[np.isfinite(value)] for _, value in kept])
    return {
        "title": title,
        "unit": unit,
        "logarithmic": bool(wants_log and values.size and values.min() > 0 and values.max() > 10 * values.min()),
        "level": level,
        "fromZero": from_zero,
        "neutral": neutral,
        "lines": [{"time": packed(time), "value": packed(value)} for time, value in kept],
    }


def thinned(time, value):
    """At most LINE_POINTS of the points (time, value), evenly chosen, first and last kept."""
    keep = np.linspace(0, len(time) - 1, min(len(time), LINE_POINTS)).round().astype(int)
    return time[keep], value[keep]


def readout(a, b, metrics, times):
    """Rows of the table beside the membranes: title, unit, values at each frame of run A and B, or one of both together."""
    rows = []
    for column, plot in DRAWN.items():
        values = [packed(run.history_at(column, times) * plot.factor) for run in (a, b)]
        rows.append({"title": plot.title, "unit": plot.plot_unit, "values": values})
    records = compared(metrics["times"])
    output_times = [record["time_us"] for record in records]
    for key, title in (("mean_distance_nm", "Mean distance"), ("hausdorff_distance_nm", "Hausdorff distance")):
        values = np.interp(times, output_times, [record[key] for record in records])
        rows.append({"title": title, "unit": "nm", "values": [packed(values)]})
    return rows
