"""report.html of a study: a page without links to anything outside."""

from comparisons.drawing.study_plots import TITLES
from comparisons.measures.convergence import DISTANCES
from comparisons.page import report
from comparisons.page.numbers import code, escaped, figures, quantity, setting
from comparisons.studies.sweep_table import mixed_programs
from endoflow.history import name_and_unit


def page(command, heading, subtitle, warnings, cards, sections, directory):
    """A page's text. cards: [(title, ready HTML value, note)]; sections: [(heading, ready HTML)]; directory: Path."""
    boxes = "".join(
        f"<div><dt>{escaped(title)}</dt><dd>{value}<small>{escaped(note)}</small></dd></div>"
        for title, value, note in cards
    )
    return report.page(
        command,
        title=escaped(f"{heading}: {command}"),
        heading=escaped(heading),
        subtitle=escaped(subtitle),
        warnings=report.warnings(warnings),
        cards=boxes,
        sections="\n".join(f"<section><h2>{escaped(title)}</h2>{body}</section>" for title, body in sections),
        origin=f"in <code>{escaped(directory)}</code>",
        scripts=("theme.js", "study.js"),
    )


def convergence_html(metrics, case_name, parameters, drawn, directory):
    """The page of an ε → 0 study.

    parameters: of the case, {"section.key": value}; drawn: {plot: title}.
    """
    epsilons = ", ".join(f"{run['epsilon_nm']:g}" for run in metrics["runs"])
    sections = [
        ("Plots", "".join(report.plot(directory / f"{name}.svg", title) for name, title in drawn.items())),
        ("Fitted orders", orders_table(metrics)),
        ("Limits for ε → 0", LIMITS_NOTE + limits_table(metrics)),
        ("Distances and errors", records_table(metrics)),
        ("Runs", runs_table(metrics)),
        ("What the numbers rest on", basis_table(metrics)),
        ("Parameters of the case", parameters_table(parameters)),
    ]
    return page(
        "endoflow converge",
        "Phase field to sharp membrane",
        f"Case “{case_name}” · ε = {epsilons} nm",
        metrics["warnings"],
        cards(metrics),
        sections,
        directory,
    )


LIMITS_NOTE = (
    '<p class="note">v0 of v0 + a ε^p fitted to the phase-field values alone. Its error is, with four or more ε, the '
    "larger of the fit’s 95 % half width and the change when the largest ε is left out; with three ε the whole distance "
    "from the smallest ε to the limit.</p>"
)


def cards(metrics):
    """The key numbers on top: (title, ready HTML value, note)."""
    last = metrics["times_us"][-1]
    found = []
    for name in DISTANCES:
        entry = entry_of(metrics["orders"], name, last)
        if entry is not None:
            title = TITLES[name].split(" (")[0]
            found.append((f"{title}: order", figures(entry["order"], 3), f"at {last:.4g} µs, {interval(entry)}"))
    smallest = metrics["records"][-1]
    title = f"Mean distance, ε = {smallest['epsilon_nm']:g} nm"
    found.append((title, quantity(smallest["mean_distance_nm"], 3, "nm"), f"at {smallest['time_us']:.4g} µs"))
    budding = entry_of(metrics["limits"], "budding_time_us", None)
    sharp = metrics["sharp"]["budding_time_us"]
    found.append(("Budding, sharp", quantity(sharp, 4, "µs"), "neck radius below 5 nm"))
    if budding is not None and budding["value"] is not None:
        found.append(("Budding, ε → 0", quantity(budding["value"], 4, "µs"), f"± {figures(budding['error'], 2)} µs"))
    return found


def entry_of(entries, name, time):
    """The entry of `orders` or `limits` for a quantity and time, or None."""
    return next((e for e in entries if (e["quantity"], e["time_us"]) == (name, time)), None)


def interval(entry):
    """The 95 % interval of an order in words."""
    return "from two ε" if entry["low"] is None else f"95 %: {entry['low']:.2f} … {entry['high']:.2f}"


def orders_table(metrics):
    """Fitted orders with their intervals."""
    rows = [
        (
            "",
            [
                escaped(TITLES[e["quantity"]].split(" (")[0]),
                setting(e["time_us"], 4),
                figures(e["order"], 3),
                "–" if e["low"] is None else f"{e['low']:.2f} … {e['high']:.2f}",
                ", ".join(f"{value:.2f}" for value in e["local"]),
            ],
        )
        for e in metrics["orders"]
    ]
    return report.table(["error of", "t (µs)", "order", "95 % interval", "between neighbouring ε"], rows)


def limits_table(metrics):
    """Extrapolated values beside the sharp ones."""
    rows = []
    for e in metrics["limits"]:
        value = (
            f"{figures(e['value'], 5)} ± {figures(e['error'], 2)}" if e["value"] is not None else escaped(e["reason"])
        )
        inside = e["difference"] is not None and abs(e["difference"]) <= e["error"]
        verdict = "–" if e["difference"] is None else "yes" if inside else "no"
        cells = [escaped(TITLES[e["quantity"]]), setting(e["time_us"], 4), value, figures(e["order"], 3)]
        rows.append(
            ("", [*cells, "0" if e["sharp"] == 0 else figures(e["sharp"], 5), figures(e["difference"], 3), verdict])
        )
    heads = ["", "t (µs)", "limit", "p", "sharp", "limit − sharp", "within its error"]
    return report.table(heads, rows)


def records_table(metrics):
    """Every record: distances, and the phase field's value with its difference from the sharp one."""
    pairs = ("neck_radius_nm", "membrane_area_nm2", "volume_extracellular_nm3", "bending_energy_pN_nm")
    rows = []
    for r in metrics["records"]:
        cells = [setting(r["time_us"], 4), f"{r['epsilon_nm']:g}", *(figures(r[name], 3) for name in DISTANCES)]
        cells += [f"{figures(r[name]['b'], 5)}<br><small>{signed(r[name]['difference'])}</small>" for name in pairs]
        rows.append(("", cells))
    heads = ["t (µs)", "ε (nm)", *(TITLES[name] for name in DISTANCES), *(TITLES[name] for name in pairs)]
    note = '<p class="note">Small: difference from the sharp run.</p>'
    return note + report.table(heads, rows)


def signed(value):
    """A difference with its sign."""
    return "–" if value is None else ("+" if value > 0 else "") + figures(value, 3)


def runs_table(metrics):
    """The runs: resolution, state, cost."""
    rows = []
    for run in [metrics["sharp"], *metrics["runs"]]:
        cells = [
            escaped(run["label"]),
            setting(run.get("cell_size_nm"), 4),
            setting(run["state"]),
            setting(run["exit_reason"]),
        ]
        cells += [figures(run["end_us"]), figures(run["budding_time_us"]), figures(run.get("wall_s"), 3)]
        rows.append(("", [*cells, f"<code>{escaped(run['directory'])}</code>"]))
    heads = ["", "cells (nm)", "state", "ended with", "end (µs)", "budding (µs)", "wall (s)", "directory"]
    return report.table(heads, rows)


def basis_table(metrics):
    """Convention, resolution and alarms of the runs."""
    runs = [metrics["sharp"], *metrics["runs"]]
    rows = [("", [escaped(run["label"]), *map(escaped, run["basis"].values())]) for run in runs]
    return report.table(["", *map(escaped, runs[0]["basis"])], rows, "text")


def parameters_table(parameters):
    """All parameters that the runs share."""
    rows = [("", [code(key), setting(value)]) for key, value in parameters.items()]
    return report.table(["", "value"], rows, "text")


def heading(column):
    """A table's column as ready HTML: a parameter's key as it is, else name and unit."""
    if "." in column:
        return f"<code>{escaped(column)}</code>"
    name, unit = name_and_unit(column)
    return escaped(name if unit == "1" else f"{name} ({unit})")


def common_basis_section(basis):
    """[(heading, ready HTML)] of what many runs rest on, from basis.common_basis; empty without runs."""
    rows = [("", [escaped(what), escaped(value)]) for what, value in basis]
    return [("What the numbers rest on", report.table(["", ""], rows, "text"))] if rows else []


def sweep_html(rows, keys, convention, basis, drawn, directory):
    """The page of a sweep: its rows (as of sweep_table) over the varied keys; basis: of its runs; drawn: {plot: title}."""
    failed = [f"{row['directory']} failed: {row['exit_reason']}" for row in rows if row["state"] == "failed"]
    alarmed = [f"{row['directory']}: accuracy alarm: {row['alarms']}" for row in rows if row["alarms"]]
    mixed = [sentence] if (sentence := mixed_programs(rows)) else []
    heads = [column for column in rows[0] if column != "directory"]
    body = report.table([heading(column) for column in heads], [("", [setting(row[column], 5) for column in heads]) for row in rows])
    plots = "".join(report.plot(directory / f"{name}.svg", title) for name, title in drawn.items())
    subtitle = f"{len(rows)} runs · curvature convention {convention} · {'with' if alarmed else 'no'} accuracy alarms"
    sections = [("Plots", plots)] * bool(plots) + [("Runs", body)] + common_basis_section(basis)
    return page("endoflow sweep", " and ".join(keys), subtitle, failed + alarmed + mixed, [], sections, directory)
