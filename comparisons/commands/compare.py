"""`endoflow compare DIR_A DIR_B [-o DIR]`: metrics.json, plots and report.html from two finished runs.

Exit codes: 0 done; 2 bad command line, or runs with no interval of time in common; 4 a run cannot be read or the output
cannot be written; 130 interrupted.
"""

import sys

import endoflow
from comparisons.drawing import style
from comparisons.errors import shown
from comparisons.files import require_writable, write_json
from comparisons.measures.along import side_by_side
from comparisons.measures.metrics import compare_runs
from comparisons.page import comparison_page


def write_comparison(a, b, output):
    """Compare two run directories (Path) and write everything into the directory output (Path); returns the metrics."""
    run_a, run_b = side_by_side(endoflow.load(a), endoflow.load(b))
    require_writable(output)
    metrics = compare_runs(run_a, run_b, style.labels(run_a, run_b))
    output.mkdir(parents=True, exist_ok=True)
    write_json(output / "metrics.json", metrics)
    comparison_page.write_page(run_a, run_b, metrics, output)
    return metrics


def summary_lines(metrics, output):
    """What the terminal shows at the end, as a list of lines."""
    first, last = metrics["common_interval_us"]
    found, budding = metrics["summary"], metrics["budding"]
    labels = [metrics["runs"][key]["label"] for key in "ab"]
    interpolation = found["interpolation_error_nm"]
    share = f" (up to {interpolation:.2g} nm of it interpolation)" if interpolation else ""
    worst = found["max_hausdorff_distance_time_us"]
    times = ["none" if budding[key] is None else f"{budding[key]:.5g} µs" for key in ("a_us", "b_us")]
    return [
        metrics["finding"],
        f"budding time         {times[0]} ({labels[0]}), {times[1]} ({labels[1]})",
        f"compared             at {found['times_compared']} times, {first:.4g} to {last:.4g} µs",
        f"mean distance        {found['time_mean_of_mean_distance_nm']:.3g} nm",
        f"Hausdorff distance   at most {found['max_hausdorff_distance_nm']:.3g} nm, at {worst:.4g} µs{share}",
        f"at the end           {found['final_mean_distance_nm']:.3g} nm on average, "
        f"{found['final_hausdorff_distance_nm']:.3g} nm at most",
        f"report               {shown(output / 'report.html')}",
    ]


def run(options):
    """Run the command; returns its exit code."""
    metrics = write_comparison(options.a, options.b, options.output)
    for warning in metrics["warnings"]:
        print(f"endoflow compare: warning: {shown(warning)}", file=sys.stderr)
    print("\n".join(summary_lines(metrics, options.output)))
    return 0
