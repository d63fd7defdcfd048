"""What a comparison of two runs found, in one sentence."""

import math

from comparisons.measures.powers import with_powers


def finding(a, b, labels, budding, summary):
    """The sentence for two endoflow.Run objects, their display names, and the entries of these names of metrics.json."""
    resting = [run.engine == "statics" for run in (a, b)]
    if all(resting):
        return f"The two stationary shapes differ by at most {rounded_up(summary['max_hausdorff_distance_nm'])} nm."
    if any(resting):
        run, label = (b, labels[1]) if resting[0] else (a, labels[0])
        distance = rounded_up(summary["final_hausdorff_distance_nm"])
        return f"At {number(run.shape_times[-1])} µs the {label} run is within {distance} nm of the stationary shape."
    distance = f"the membranes never differ by more than {rounded_up(summary['max_hausdorff_distance_nm'])} nm"
    if summary["includes_interpolated_shapes"]:
        distance += ", shapes interpolated in time included"
    times = [budding["a_us"], budding["b_us"]]
    if times == [None, None] and a.shapes[0].closed and b.shapes[0].closed:
        return f"Two closed membranes, compared until {number(last_common(a, b))} µs: {distance}."
    return f"{buds(a, b, labels, budding)}; {distance}."


def buds(a, b, labels, budding):
    """Whether and when membranes with a rim bud."""
    plural = "engines" if a.engine != b.engine else "runs"
    times = [budding["a_us"], budding["b_us"]]
    if None not in times:
        first, second = (f"{label} at {number(time)} µs" for label, time in zip(labels, times))
        relative = abs(budding["relative_difference"])
        apart = f"{with_powers(f'{100 * relative:.2g}')} % apart" if relative > 0 else "at the same time"
        return f"Both {plural} bud: {first}, {second}, {apart}"
    if times == [None, None]:
        return f"Neither of the {plural} buds by {number(last_common(a, b))} µs"
    early, late = (0, 1) if times[1] is None else (1, 0)
    end = number((a, b)[late].shape_times[-1])
    before = (a, b)[late].shape_times[-1] < times[early]
    other = f"ends before, at {end} µs" if before else f"does not until {end} µs"
    return f"{labels[early].capitalize()} buds at {number(times[early])} µs, {labels[late]} {other}"


def last_common(a, b):
    """The last time (µs) that the shapes of both runs cover."""
    return min(a.shape_times[-1], b.shape_times[-1])


def number(value):
    """Four digits."""
    return with_powers(f"{value:.4g}")


def rounded_up(value):
    """Two digits of a positive number, never less than it."""
    if value <= 0:
        return "0"
    place = 10.0 ** (math.floor(math.log10(value)) - 1)
    return with_powers(f"{math.ceil(value / place * (1 - 1e-12)) * place:.2g}")
