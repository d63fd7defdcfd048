"""Studies of vesicles, of the smooth case, and of the paper's items."""

from results import measures
from results.study import QUIET, Study, Table
from results.tables import Column


def vesicles():
    """A closed prolate vesicle relaxes, in both engines."""
    case = "cases/closed_vesicle.toml --set domain.spheroid_polar_axis=73.62 --set domain.spheroid_equatorial_axis=26.37 --until 5"
    runs = {engine: f"endoflow run {engine} {case} {QUIET}" for engine in ("boundary-integral", "phase-field")}
    columns = (
        Column("time_us", "t, µs"),
        Column("energy_sharp_pN_nm", "energy, sharp, pN nm", ".2f"),
        *(Column(name, name, "+.3%") for name in ("energy", "height", "volume")),
    )

    def rows(made):
        return measures.relaxation(made.run("boundary-integral"), made.run("phase-field"), (0.01, 0.1, 0.5, 1, 5))

    yield Study("vesicle", 4, runs, (Table("vesicle", columns, rows),))


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

    tables = (Table("smooth-case", (), rows), Table("smooth-case-limits", columns, limits, derived=True))
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

    yield Study("printed", 120, {"run": "endoflow run phase-field cases/printed.toml --until 6.8"}, (Table("paper-printed", (), printed),))
