"""What a comparison found and what its numbers rest on, in words."""

import math
import re
from collections import Counter

from endoflow.alarms import alarms_of

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

#: What a run does not say.
NOT_RECORDED = "not recorded by the version that made the run"

#: Most different entries that are named one by one where many runs are described together.
NAMED = 4


def with_powers(text):
    """Text with its numbers "1.2e-07" as "1.2·10⁻⁷"."""
    return re.sub(r"(?<=\d)e([+-]\d+)\b", lambda found: f"·10{str(int(found[1])).translate(SUPERSCRIPTS)}", text)


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


def counted(words):
    """ "3 finished, 1 failed": how often each word is there, in the order of their appearance."""
    return ", ".join(f"{count} {word}" for word, count in Counter(words).items())


def rounded_up(value):
    """Two digits of a positive number, never less than it."""
    if value <= 0:
        return "0"
    place = 10.0 ** (math.floor(math.log10(value)) - 1)
    return with_powers(f"{math.ceil(value / place * (1 - 1e-12)) * place:.2g}")


def basis(record):
    """{what: value} of a run.json (dict): curvature convention, resolution reached, alarms."""
    return {
        "curvature convention": record["parameters"]["membrane"].get("curvature_convention", "–"),
        "resolution": with_powers(record.get("resolution", NOT_RECORDED)),
        "alarms": (", ".join(alarm.name for alarm in alarms_of(record)) or "none") if "alarms" in record else NOT_RECORDED,
    }


def common_basis(records):
    """[(what, value)] of many runs together, from their run.json (dicts); [] without any.

    Different conventions and resolutions are named side by side, alarms with the number of runs that raised them.
    """
    found = [basis(record) for record in records]
    if not found:
        return []
    conventions, resolutions = (listed([one[what] for one in found]) for what in ("curvature convention", "resolution"))
    names = [one["alarms"] for one in found if one["alarms"] != "none"]
    counts = ", ".join(f"{name} ({names.count(name)} of {len(found)} runs)" for name in dict.fromkeys(names))
    return [("curvature convention", conventions), ("resolution", resolutions), ("alarms", counts or "none")]


def listed(texts):
    """Different texts in the order of their appearance; of many the first and the last."""
    different = [*dict.fromkeys(texts)]
    if len(different) > NAMED:
        return f"{different[0]} … {different[-1]} ({len(different)} different ones)"
    return "; ".join(different)
