"""Studies of vesicles, of the smooth case, and of the paper's items."""

import numpy as np

from endoflow.curves import local_cubic
from results import measures
from results.study import ENGINES, QUIET, Study, Table
from results.tables import Column

#: Other vesicles with the area of a sphere of 40 nm: semi-axes (nm), polar and equatorial, end (µs) and other settings.
VESICLES = {
    "prolate-0.9": (60.529, 30.848, 5),
    "prolate-0.95": (53.381, 33.749, 5),
    "oblate-0.6": (13.68, 52.98, 0.5, "--set phase_field.epsilon=1.7"),
}


def relaxing(engine, polar, equatorial, end, *settings):
    """The command of a spheroid that relaxes."""
    axes = f"--set domain.spheroid_polar_axis={polar} --set domain.spheroid_equatorial_axis={equatorial}"
    return " ".join((f"endoflow run {engine} cases/closed_vesicle.toml", axes, *settings, f"--until {end} {QUIET}"))


def vesicles():
    """Closed vesicles relax, in both engines."""
    runs = {engine: relaxing(engine, 73.62, 26.37, 5) for engine in ENGINES}
    columns = (
        Column("time_us", "t, µs"),
        Column("energy_sharp_pN_nm", "energy, sharp, pN nm", ".2f"),
        *(Column(name, name, "+.3%") for name in ("energy", "height", "volume")),
    )

    def rows(made):
        return measures.relaxation(*map(made.run, ENGINES), (0.01, 0.1, 0.5, 1, 5))

    def kept(made):
        diffuse = made.run("phase-field")
        area = diffuse.history["membrane_area_nm2"]
        return [{"run": "diffuse"} | measures.cost(diffuse) | {"area": float(np.abs(area / area[0] - 1).max())}]

    yield Study("vesicle", 4, runs, (Table("vesicle", columns, rows), Table("vesicle-kept", (), kept)))

    others = {f"{engine}-{name}": relaxing(engine, *given) for name, given in VESICLES.items() for engine in ENGINES}
    columns = (
        Column("vesicle", "shape, reduced volume"),
        Column("axes_nm", "semi-axes, nm"),
        Column("time_us", "t, µs"),
        *(Column(name, name, "+.3%") for name in ("energy", "height", "volume")),
    )

    def ends(made):
        found = []
        for name, (polar, equatorial, end, *_) in VESICLES.items():
            (row,) = measures.relaxation(*(made.run(f"{engine}-{name}") for engine in ENGINES), (end,))
            found.append({"vesicle": name.replace("-", ", "), "axes_nm": f"{polar}, {equatorial}"} | row)
        return found

    yield Study("vesicle-shapes", 15, others, (Table("vesicle-shapes", columns, ends),))


def smooth():
    """A coat with a smooth edge, five uniform layers."""
    layers = "--epsilon 2.4,1.7,1.2,0.85,0.6 --times 0.1,0.25,0.5,1 --until 1.4"
    settings = f"{QUIET} --set output.shape_interval=0.05 --set time.tolerance=2e-5 --jobs 1 --processes 1"
    runs = {"converge": f"endoflow converge cases/asymptotic.toml {layers} {settings}"}

    def rows(made):
        found = made.csv("converge", "converge.csv")
        return [{"time_us": row.pop("time_us"), "epsilon_nm": row.pop("epsilon_nm")} | row for row in found]

    columns = (
        Column("quantity", "quantity"),
        Column("time_us", "time, µs"),
        Column("sharp", "sharp", ".6g"),
        Column("order", "order", ".2f"),
        Column("limit", "limit", "+.2%"),
        Column("power", "p", ".1f"),
    )

    def limits(made):
        return measures.smooth_limits(made.rows("smooth-case"))

    def late(made):
        """How late each layer buds."""
        found = [row for row in made.rows("smooth-case") if row["time_us"] == 1 and row["budding_time_us"] is not None]
        return [{"epsilon_nm": f"{row['epsilon_nm']:g}", "late": row["budding_time_us"] / row["budding_time_sharp_us"] - 1} for row in found]

    tables = (
        Table("smooth-case", (), rows),
        Table("smooth-case-limits", columns, limits, derived=True),
        Table("smooth-case-late", (), late, derived=True),
    )
    yield Study("smooth-case", 30, runs, tables)


#: The items of `endoflow reproduce` whose tables the pages use: {item: table}.
ITEMS = {
    "table2": "table2", "fig3": "fig3", "fig4": "fig4", "fig5": "fig5-fig6-fig7", "figA2": "figA2",
    "mobility": "mobility", "attribution": "attribution", "timescale": "timescale", "inertia": "inertia",
}  # fmt: skip


def paper():
    """The paper's items as `endoflow reproduce` makes them."""
    runs = {"items": f"endoflow reproduce {' '.join(ITEMS)} --full --jobs 1"}

    columns = {
        "table2": (
            Column("parameter", "column"),
            Column("printed_value", "value", ".4g"),
            Column("unit", "unit"),
            Column("time_us", "at, µs", ".3g"),
            Column("paper_change_percent", "paper, %", ".2f"),
            Column("signed_change_percent", "here, %", "+.2f"),
        ),
        "timescale": (
            Column("reading", "reading"),
            Column("meaning", "meaning"),
            Column("area_at_0.5_us_nm2", "area at 0.5 µs, nm²", ",.0f"),
            Column("slowdown", "paper slower by", ".3g"),
            Column("budding_time_us", "neck of 5 nm at, µs", ".3g"),
        ),
    }

    def table(item, name):
        return Table(f"paper-{name}", columns.get(name, ()), lambda made: made.csv("items", f"{item}/{item}.csv"))

    yield Study("paper", 600, runs, tuple(table(*one) for one in ITEMS.items()))

    def printed(made):
        return measures.history(made.run("run"), 0.05)

    beside = (
        Column("time_us", "time, µs"),
        Column("area_nm2", "area, nm²", ",.0f"),
        Column("area_sharp_nm2", "sharp", ",.0f"),
        Column("volume_nm3", "volume gained, nm³", ",.0f"),
        Column("volume_sharp_nm3", "sharp", ",.0f"),
        Column("slower", "slower by", ".2f"),
        Column("strain", "largest strain", ".1%"),
        Column("force_pN", "net vertical force, pN", ",.0f"),
    )
    tables = (
        Table("paper-printed", (), printed),
        Table("paper-printed-times", beside, lambda made: slower(made.rows("paper-printed"), made.rows("standard-history")), derived=True),
    )
    yield Study("printed", 120, {"run": "endoflow run phase-field cases/printed.toml --until 6.8"}, tables)


#: Times (µs) at which the printed numerics is compared with the sharp membrane.
PRINTED_TIMES = (0.1, 0.2, 0.3, 0.4, 0.5)


def slower(printed, sharp):
    """The printed numerics beside the sharp membrane: rows of both histories. Slower by: the time over that of the same sharp area."""
    names = {"area_nm2": "membrane_area_nm2", "volume_nm3": "volume_extracellular_nm3", "strain": "area_strain_max", "force_pN": "net_vertical_force_pN"}
    times, early = (np.array([row["time_us"] for row in rows]) for rows in (printed, sharp))
    area, volume = (np.array([row[name] for row in sharp]) for name in ("area_nm2", "volume_nm3"))

    def between(x, y, place):
        return float(local_cubic(x, y, np.array([place]))[0])

    rows = []
    for time in PRINTED_TIMES:
        row = {"time_us": f"{time:g}"}
        row |= {name: between(times, np.array([one[column] for one in printed]), time) for name, column in names.items()}
        row |= {"area_sharp_nm2": between(early, area, time), "volume_sharp_nm3": between(early, volume, time)}
        rows.append(row | {"slower": time / np.exp(between(area, np.log(early), row["area_nm2"]))})
    return rows
