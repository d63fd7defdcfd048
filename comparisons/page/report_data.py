"""What report.html embeds for its scripts: curves and numbers at every frame, as base64 float32."""

import base64

import numpy as np

from comparisons.drawing import style
from comparisons.measures.extent import half_width
from comparisons.measures.metrics import compared, last_budding
from comparisons.measures.time_axis import long_after_budding, time_axis
from endoflow.curves import resample

#: Points of each embedded curve, and about how many frames the slider has.
POINTS = 220
FRAMES = 160

#: Every how many points of a curve has a velocity arrow.
ARROW_STRIDE = 8

#: Least height (nm) of the picture of the membranes.
LEAST_HEIGHT = 60.0

#: Most points of an embedded history line.
LINE_POINTS = 500


def report_data(a, b, metrics):
    """The dict that report/data.js unpacks, for two endoflow.Run objects and their metrics."""
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
    for column, plot in style.HISTORY_PLOTS.items():
        lines = [(run.history["time_us"], run.history[column] * plot.factor) for run in (a, b)]
        level = style.BUDDING_NECK_RADIUS if column == "neck_radius_nm" else None
        entries.append(
            chart(plot.title, plot.unit, lines, wants_log=plot.logarithmic, level=level, from_zero=level is not None)
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
    for column, plot in style.HISTORY_PLOTS.items():
        values = [packed(run.history_at(column, times) * plot.factor) for run in (a, b)]
        rows.append({"title": plot.title, "unit": plot.unit, "values": values})
    records = compared(metrics["times"])
    output_times = [record["time_us"] for record in records]
    for key, title in (("mean_distance_nm", "Mean distance"), ("hausdorff_distance_nm", "Hausdorff distance")):
        values = np.interp(times, output_times, [record[key] for record in records])
        rows.append({"title": title, "unit": "nm", "values": [packed(values)]})
    return rows
