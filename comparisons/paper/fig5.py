"""Fig. 5: shapes at 20 µs for patches of different radius."""

from comparisons import BOUNDARY_INTEGRAL, PHASE_FIELD
from comparisons.drawing import style
from comparisons.drawing.pictures import Panel, gallery
from comparisons.paper import patch_sweep
from comparisons.paper.figures import ended_because, sharp_of, with_line
from comparisons.paper.item import Printed, Result, is_run, last_time, quick_remark, state_of
from comparisons.paper.patch_sweep import STATIONARY, name_of
from comparisons.studies.sweep_table import engines_of

TITLE = "Fig. 5: stationary shapes by patch radius"

#: Panels of one row.
PER_ROW = 6

wanted = patch_sweep.wanted


def panel(radius, run, sharp=None):
    """The Panel of a run; sharp: the run of the sharp engine, for a dashed line, or None."""
    title = f"r_c = {radius} nm"
    if not is_run(run):
        return Panel(title, state_of(run))
    time = min(STATIONARY, last_time(run))
    if time < STATIONARY:
        title += f", {time:.3g} µs" + ended_because(run)
    return with_line(Panel(title, run.shape_at(time)), sharp, time)


def panels_of(runs, engine):
    """Rows of panels of an engine."""
    of_radii = {r: runs[name_of(r)] for r in sorted(patch_sweep.RADII)}
    panels = [panel(r, own[engine], sharp_of(own, engine)) for r, own in of_radii.items() if engine in own]
    return [(style.ENGINE_NAMES[engine], panels[i : i + PER_ROW]) for i in range(0, len(panels), PER_ROW)]


def by_shape(rows, engine):
    """Radii of each morphology in words."""
    found = {}
    for row in rows:
        if row["engine"] == engine and row["shape"]:
            found.setdefault(row["shape"], []).append(row["patch_radius_nm"])
    return "; ".join(f"{shape}: {', '.join(map(str, radii))}" for shape, radii in found.items()) or "–"


def result(runs, quick):
    """See item.Result."""
    rows = patch_sweep.table(runs)
    engines = engines_of(rows)

    def at(radius, column, digits=3):
        found = {r["engine"]: r[column] for r in rows if r["patch_radius_nm"] == radius}
        return {e: "–" if v is None else v if isinstance(v, str) else f"{v:.{digits}g}" for e, v in found.items()}

    printed = [
        Printed(
            "shapes by patch radius, nm",
            "no neck up to 20; nearly spherical with a neck 28–40; mushroom-like above 40",
            {engine: by_shape(rows, engine) for engine in engines},
        ),
        Printed("roundness of the bud at 36 nm (1: sphere)", "nearly spherical", at(36, "roundness")),
        Printed("rise of the underside at 36 nm, nm", "–", at(36, "underside_rise_nm", 2)),
        Printed("rise of the underside at 60 nm, nm", "mushroom-like", at(60, "underside_rise_nm", 2)),
        Printed("roundness of the bud at 60 nm", "mushroom-like", at(60, "roundness")),
    ]
    remarks = [
        "Without pressure difference and flow, a stationary shape with an open neck exists only up to r_c ≈ 25.6 nm "
        "(endoflow statics); from about 29 nm on the sharp neck closes. So above that the shapes at 20 µs are not "
        "stationary: the bud hardly changes any more, its neck keeps draining. The paper calls them stationary.",
        f"“Mushroom” is counted here where the underside rises by more than {patch_sweep.DENT:g} nm between the coat's edge "
        "and the neck; that rise grows steadily with r_c and passes this limit where the paper sees the change. Roundness is "
        "the volume above the neck over that of the sphere of equal area.",
        *quick_remark(quick),
    ]
    figures = {}
    for engine, name in ((BOUNDARY_INTEGRAL, "fig5"), (PHASE_FIELD, "fig5_phase_field")):
        if engine in engines:
            title = f"Shapes at {STATIONARY:g} µs or at the run's end, {style.ENGINE_NAMES[engine]}"
            title += "; dashed: the sharp membrane" if engine == PHASE_FIELD else ""
            figures[name] = (title, gallery(panels_of(runs, engine)))
    return Result(rows, figures, printed, remarks)
