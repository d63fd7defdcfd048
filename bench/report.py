"""bench.md and what the terminal shows."""

import measurements


def section(name, figure):
    """Lines of Markdown about one measurement."""
    if "skipped" in figure:
        return [f"Skipped: {figure['skipped']}."]
    return WRITERS[name](figure)


def kernels(figure):
    """A table of rates."""
    rates = figure["pairs_per_second_and_core"]
    rows = [f"| {kernel.replace('_', ' ')} | {rate:.2e} |" for kernel, rate in rates.items()]
    return ["| ring kernel | pairs per second and core |", "| --- | --- |", *rows]


def run(figure):
    """Totals of a run and its phases."""
    steps, budding = figure["steps"], figure["budding_time_us"]
    lines = [
        f"{figure['wall_s']:.2f} s wall, {figure['cpu_s']:.2f} s CPU to {figure['end_us']:.6g} µs "
        f"({figure['exit_reason']}); {steps['accepted']} steps, {steps['rejected']} rejected; "
        f"{figure['processes']} processes, {figure['threads']} threads",
        "" if budding is None else f"budding time {budding:.7f} µs",
        "",
        "| phase | wall, s | CPU, s | share of CPU |",
        "| --- | --- | --- | --- |",
    ]
    for phase, spent in sorted(figure["phases"].items(), key=lambda item: -item[1]["cpu_s"]):
        share = spent["cpu_s"] / figure["cpu_s"]
        lines.append(f"| {phase} | {spent['wall_s']:.2f} | {spent['cpu_s']:.2f} | {share:.0%} |")
    return lines


def patch_sweep(figure):
    """One line."""
    return [
        f"{figure['wall_s']:.1f} s wall, {figure['cpu_s']:.1f} s CPU; {figure['finished']} of {figure['runs']} runs "
        f"finished (budding or {figure['until_us']:g} µs)"
    ]


def phase_field_schemes(figure):
    """CPU time of both schemes."""
    rows = [
        f"| {to['time_us']:.4g} | {to['cpu_s']:.4g} | {to['steps']} | "
        f"{to['paper_cpu_s']:.4g} | {to['ratio']:.3g} |"
        for to in figure["to"]
    ]
    return [
        f"`paper`: {figure['paper_measured_cpu_s']:.3g} s CPU to {figure['paper_measured_to_us']:g} µs, then "
        f"{figure['paper_cpu_s_per_step']:.3g} s per step of at most {1e3 * figure['paper_longest_step_us']:g} ns. "
        f"`production` ended: {figure['exit_reason']}.",
        "",
        "| to, µs | `production`: CPU s | steps | `paper`: CPU s, at least | ratio, at least |",
        "| --- | --- | --- | --- | --- |",
        *rows,
    ]


def scaling(figure):
    """A row for each number of processes."""
    rows = []
    for on in figure["on"]:
        counts = [on["solver"][name] for name in ("unknowns_between_processes", "iterations", "factorisations")]
        cells = [str(on["processes"]), f"{on['wall_s']:.1f}", f"{on['times_as_fast']:.2f}", *map("{:g}".format, counts)]
        rows.append(f"| {' | '.join(cells)} |")
    return [
        f"Standard case to {figure['until_us']:g} µs.",
        "",
        "| processes | wall, s | times as fast | unknowns that parts share | iterations | factorisations |",
        "| --- | --- | --- | --- | --- | --- |",
        *rows,
    ]


WRITERS = {
    "kernels": kernels,
    "to_budding": run,
    "to_the_end": run,
    "patch_sweep": patch_sweep,
    "phase_field_schemes": phase_field_schemes,
    "scaling": scaling,
}


def markdown(found):
    """All of bench.md."""
    at = found["machine"]
    lines = [
        "# What the engines cost",
        "",
        f"{at['processor']}, {at['cores']} cores, {at['system']}; commit {at['commit']}, {at['date']}. "
        f"Load {at['load_at_start']:.2f} at the start, {at['load_at_end']:.2f} at the end (the bench's own included). "
        f"Medians of {found['repeats']}" + (" (quick: shorter runs)." if found["quick"] else "."),
    ]
    for name, figure in found["figures"].items():
        lines += ["", f"## {name.replace('_', ' ')}", "", measurements.ALL[name].__doc__, "", *section(name, figure)]
    return "\n".join(lines) + "\n"
