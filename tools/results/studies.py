"""The studies: the runs behind each, for how long they keep two cores, and the tables that they give.

A run's command ends where its directory is added; {LABEL} stands for the directory of another run of the same study.
"""

import csv
from dataclasses import dataclass
from typing import Callable

from results import measures
from results.places import ROOT
from results.tables import Column


@dataclass(frozen=True)
class Table:
    """A file of docs/results/data. rows: (Made) → rows as dicts; derived: from other tables alone."""

    name: str
    columns: tuple
    rows: Callable
    derived: bool = False


@dataclass(frozen=True)
class Study:
    """minutes: for which all its runs keep two cores; runs: {label: command}."""

    name: str
    minutes: float
    runs: dict
    tables: tuple


QUIET = "--set output.field_interval=0"
SHARP = f"endoflow run boundary-integral cases/standard.toml {QUIET}"
DIFFUSE = f"endoflow run phase-field cases/standard.toml {QUIET}"
TO_BUDDING = "--set output.stop_at_budding=true"

#: Times (µs) at which the engines' histories of the standard case are compared.
TIMES = (0.0005, 0.02, 0.1, 0.2, 0.4, 0.6, 0.8, 1, 2, 5, 10, 14, 20)

NECKS = (Column("neck_nm", "neck, nm", ".3f"), Column("neck_sharp_nm", "sharp", ".3f"), Column("neck", "difference", "+.2%"))
BALANCES = tuple(Column(name, name, "+.2%") for name in measures.COMPARED)


def standard():
    """Both engines' runs of the standard case to 20 µs."""
    yield Study(
        "standard-sharp",
        1,
        {"to-20": f"{SHARP} --until 20"},
        (
            Table(
                "standard-sharp",
                (Column("run"), Column("budding_us", "budding, µs", ".6f"), Column("neck_1_nm", "neck at 1 µs, nm", ".3f")),
                lambda made: [{"run": "to-20"} | measures.shape_of_standard(made.run("to-20")) | measures.cost(made.run("to-20"))],
            ),
            Table("standard-energy", (), lambda made: measures.energy(made.run("to-20"))),
            Table("standard-shape", (), lambda made: measures.membrane(made.run("to-20"), 0.5)),
        ),
    )

    def said(made):
        sharp, diffuse = made.run("sharp"), made.run("to-20")
        budding = measures.shape_of_standard(diffuse)["budding_us"]
        late = budding / sharp.event_time("budding") - 1
        return [{"run": "to-20", "budding_us": budding, "late": late} | measures.cost(diffuse) | measures.kept(diffuse)]

    yield Study(
        "standard-diffuse",
        9,
        {"sharp": f"{SHARP} --until 20", "to-20": f"mpirun -n 2 {DIFFUSE} --until 20", "one-process": f"{DIFFUSE} --until 20"},
        (
            Table(
                "standard-differences",
                (Column("time_us", "time, µs"), *BALANCES, *NECKS),
                lambda made: measures.differences(made.run("sharp"), made.run("to-20"), TIMES),
            ),
            Table("standard-diffuse", (Column("run"), Column("budding_us", "budding, µs", ".5f"), Column("late", "late", "+.2%")), said),
            Table(
                "scaling",
                (Column("processes", "processes"), Column("wall_s", "wall time, s", ".0f"), Column("cpu_s", "CPU time, s", ".0f")),
                lambda made: [
                    {"processes": processes} | {name: made.run(label).record[name] for name in ("wall_s", "cpu_s")}
                    for processes, label in (("1", "one-process"), ("2", "to-20"))
                ],
            ),
        ),
    )


#: The relatives of the standard case: what they change, their end (µs), whether that is budding.
RELATIVES = {
    "molecules.patch_radius=28": (3, True),
    "molecules.patch_radius=32": (3, True),
    "molecules.patch_radius=44": (3, True),
    "molecules.patch_radius=60": (3, True),
    "fluid.viscosity_intracellular=1e-3": (3, True),
    "fluid.viscosity_intracellular=5e-2": (6, True),
    "molecules.interface_width=0.6": (3, True),
    "molecules.interface_width=2.4": (3, True),
    "membrane.constitutive_law=coarse-grained": (3, True),
    "membrane.constitutive_law=lumped": (3, True),
    "domain.radius=120": (3, True),
    "molecules.transport=fickian": (0.5, False),
    "molecules.transport=advection": (0.5, False),
    "membrane.curvature_convention=consistent": (1, False),
    "molecules.patch_radius=20": (3, False),
    "membrane.bending_stiffness_coated=300": (2.2, False),
}

#: What belongs to a change that is made of several keys.
TOGETHER = {"domain.radius=120": "--set domain.height=240 --set domain.membrane_height=120"}


def relatives():
    """Both engines, one change of the standard case at a time."""
    runs = {}
    for change, (end, _) in RELATIVES.items():
        rest = " ".join(filter(None, (f"--set {change}", TOGETHER.get(change), TO_BUDDING, f"--until {end}")))
        runs |= {f"sharp-{change}": f"{SHARP} {rest}", f"diffuse-{change}": f"mpirun -n 2 {DIFFUSE} {rest}"}

    def rows(made):
        return [
            {"change": change} | measures.largest_differences(made.run(f"sharp-{change}"), made.run(f"diffuse-{change}"))
            for change in RELATIVES
        ]

    columns = (
        Column("change", "change"),
        Column("budding_sharp_us", "budding, sharp, µs", ".5f"),
        Column("budding_us", "diffuse, µs", ".5f"),
        Column("late", "late", "+.2%"),
        *(Column(name, name, ".2%") for name in ("area", "volume", "energy", "neck")),
    )
    yield Study("relatives", 75, runs, (Table("relatives", columns, rows),))


LAYERS = (1.2, 0.85, 0.6, 0.42)


def layers():
    """Uniform layers of the standard case, and what the diffuse engine's numerical parameters do."""
    fine = "--set phase_field.production.thinning=0 --set time.tolerance=2e-5 --until 0.95"
    converged = "--set boundary_integral.elements=140 --set time.tolerance=1e-8 --until 0.95"
    runs = {"sharp": f"{SHARP} {converged}"}
    runs |= {
        f"{e}": f"mpirun -n 2 {DIFFUSE} {TO_BUDDING} {fine} --set phase_field.epsilon={e} --set phase_field.cell_size={e}" for e in LAYERS
    }

    def rows(made):
        return [{"epsilon_nm": f"{e}"} | measures.thin_layer(made.run("sharp"), made.run(f"{e}")) for e in LAYERS]

    columns = (
        Column("epsilon_nm", "ε, nm"),
        Column("budding_us", "budding, µs", ".6f"),
        Column("late", "late", ".3%"),
        *(Column(f"neck_{time}", f"neck at {time} µs", ".2%") for time in (0.4, 0.6, 0.8)),
        Column("steps", "steps"),
        Column("cpu_s", "CPU time, s", ".0f"),
    )

    def fits(made):
        return measures.limits(made.rows("thin-layers"))

    def orders(made):
        rows = made.rows("thin-layers")
        found = {name: measures.local_orders(rows, name) for name in ("late", "neck_0.4", "energy_0.25")}
        pairs = zip(LAYERS, LAYERS[1:])
        return [{"between": f"{a}-{b}"} | {name: float(values[i]) for name, values in found.items()} for i, (a, b) in enumerate(pairs)]

    limit = (Column("fit", "fit"), Column("limit", "limit", "+.2%"), Column("order", "order", ".2f"))
    order = (Column("between", "ε, nm"), Column("late", "budding", ".2f"), Column("neck_0.4", "neck", ".2f"), Column("energy_0.25", "energy", ".2f"))
    yield Study(
        "thin-layers",
        45,
        runs,
        (
            Table("thin-layers", columns, rows),
            Table("thin-layers-limits", limit, fits, derived=True),
            Table("thin-layers-orders", order, orders, derived=True),
        ),
    )

    yield Study("numerical-parameters", 20, *numerical_parameters())


#: Half of each default of a uniform layer of 1.2 nm; of the tolerance a tenth.
HALVES = {
    "time.tolerance": "1e-5",
    "phase_field.production.profile_relaxation": "36.5",
    "phase_field.production.tension_alignment": "0.015",
    "phase_field.production.stretching_alignment": "25.8",
    "phase_field.production.strain_relaxation": "2.575",
    "phase_field.cell_size": "0.8",
}


def numerical_parameters():
    """(runs, tables): what the diffuse engine's numerical parameters do to the budding time."""
    uniform = f"mpirun -n 2 {DIFFUSE} {TO_BUDDING} --set phase_field.production.thinning=0 --until 0.95"
    runs = {"as-it-is": uniform} | {key: f"{uniform} --set {key}={value}" for key, value in HALVES.items()}

    def rows(made):
        usual = made.run("as-it-is").event_time("budding")
        return [{"key": key, "change": made.run(key).event_time("budding") / usual - 1} for key in HALVES]

    columns = (Column("key", "key"), Column("change", "change of the budding time", "+.3%"))
    return runs, (Table("numerical-parameters", columns, rows),)


#: Elements, tolerance, quadrature points.
REFINED = (
    ("40", "1e-6", "8"), ("60", "1e-6", "8"), ("80", "1e-4", "8"), ("80", "1e-6", "8"),
    ("80", "1e-8", "8"), ("80", "1e-6", "12"), ("110", "1e-6", "8"), ("140", "1e-8", "12"),
)  # fmt: skip


def known_budding():
    """{case: (changes, end, converged time)} of tests/reference/converged_budding.csv."""
    text = (ROOT / "tests" / "reference" / "converged_budding.csv").read_text("utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return {row["case"]: (row["settings"], row["end_us"], float(row["budding_us"])) for row in rows}


def accuracy():
    """The sharp engine: fixed elements, refined; elements that it chooses."""
    once = "--set output.shape_interval=1"
    own = "--set boundary_integral.elements={} --set time.tolerance={} --set boundary_integral.quadrature_order={} --until 1"
    runs = {"-".join(one): f"{SHARP} {once} {own.format(*one)}" for one in REFINED}
    columns = (
        Column("run"),
        Column("elements", "elements", ".0f"),
        Column("tolerance", "tolerance", ".0e"),
        Column("points", "points", ".0f"),
        Column("budding_us", "budding, µs", ".8f"),
        Column("neck_nm", "neck, nm", ".6f"),
        Column("area_nm2", "area, nm²", ".4f"),
        Column("steps", "steps", ".0f"),
        Column("strain", "largest strain", ".0e"),
    )
    yield Study(
        "refinement", 2, runs, (Table("refinement", columns, lambda made: [{"run": name} | measures.refinement(made.run(name)) for name in runs]),)
    )

    known = known_budding()
    cases = {
        name: " ".join([SHARP, once, TO_BUDDING, *(f"--set {one}" for one in changes.split()), f"--until {end}"])
        for name, (changes, end, _) in known.items()
    }
    columns = (
        Column("case", "case"),
        Column("elements", "elements"),
        Column("budding_us", "budding, µs", ".6f"),
        Column("converged_us", "converged, µs", ".6f"),
        Column("off", "off by", ".1e"),
        Column("estimate", "estimate", ".1e"),
        Column("cpu_s", "processor time, s", ".1f"),
    )
    yield Study(
        "chosen-resolution",
        1,
        cases,
        (
            Table(
                "chosen-resolution",
                columns,
                lambda made: [{"case": name} | measures.chosen_resolution(made.run(name), known[name][2]) for name in cases],
            ),
        ),
    )


RADII = (20, 24, 28, 32, 36, 38, 40, 44, 48, 52, 56, 60)


def radii():
    """The sharp engine with twelve coats to 20 µs."""
    runs = {f"{radius}": f"{SHARP} --set molecules.patch_radius={radius} --until 20" for radius in RADII}
    columns = (
        Column("radius_nm", "r_c, nm"),
        Column("budding_us", "budding, µs", ".4f"),
        Column("diameter_nm", "lateral diameter at the end, nm", ".2f"),
        Column("neck_nm", "neck, nm", ".3f"),
        Column("height_nm", "height, nm", ".2f"),
        Column("shape", "shape"),
        Column("end_us", "end, µs", ".2f"),
    )
    yield Study(
        "twelve-radii",
        4,
        runs,
        (Table("twelve-radii", columns, lambda made: [{"radius_nm": name} | measures.patch(made.run(name)) for name in runs]),),
    )


#: Coats whose perturbations are followed, nm.
PERTURBED = (24, 28, 36, 38, 40, 42, 44, 52)


def modes():
    """Perturbations without axial symmetry, of the standard case and of other coats."""
    runs = {"run": f"{SHARP} --set boundary_integral.elements=80 --until 1", "modes": "endoflow modes {run} --times 6 --tables-only"}
    numbers = (1, 2, 3, 4, 5, 8)
    initials = ("dome", "edge", "sheet", "coat", "worst")
    yield Study(
        "modes",
        3,
        runs,
        (
            Table(
                "modes",
                (Column("initial", "at the start"), *(Column(f"m{m}", f"m = {m}", ".2g") for m in numbers)),
                lambda made: measures.perturbations(made.directory("modes"), initials),
            ),
            Table(
                "modes-rates",
                (Column("time_us", "time, µs"), *(Column(f"m{m}", f"m = {m}", "+.3f") for m in numbers)),
                lambda made: measures.rates(made.directory("modes")),
            ),
        ),
    )

    runs = {}
    for radius in PERTURBED:
        runs[f"run-{radius}"] = f"{SHARP} --set molecules.patch_radius={radius} {TO_BUDDING} --until 1.6"
        runs[f"{radius}"] = f"endoflow modes {{run-{radius}}} --times 7 --modes 1:4 --tables-only"
    columns = (
        Column("radius_nm", "r_c, nm"),
        Column("budding_us", "budding, µs", ".3f"),
        *(Column(f"rate_m{m}", f"largest rate, m = {m}, 1/µs", "+.2f") for m in (1, 2, 3)),
        Column("most_m2_nm", "`coat` of 0.1 nm, m = 2, at most, nm", ".2g"),
        *(Column(f"end_m{m}_nm", f"m = {m}, at the end", ".2g") for m in (2, 3)),
        Column("gain_m2", "largest gain, m = 2", ".2g"),
    )
    yield Study(
        "modes-of-radii",
        10,
        runs,
        (
            Table(
                "modes-of-radii",
                columns,
                lambda made: [{"radius_nm": f"{radius}"} | measures.perturbed(made.directory(f"{radius}")) for radius in PERTURBED],
            ),
        ),
    )


def noise():
    """Thermal noise about the standard case."""
    runs = {"run": f"{SHARP} --until 0.9", "modes": "endoflow modes {run} --noise --modes 1:4 --times 13 --tables-only"}
    columns = (
        Column("time_us", "time, µs"),
        Column("height_nm", "height, nm", ".1f"),
        Column("height_rms_nm", "±", ".2f"),
        Column("height_inherited_nm", "inherited", ".2f"),
        Column("neck_radius_nm", "neck, nm", ".2f"),
        Column("neck_rms_nm", "±", ".2f"),
        Column("neck_inherited_nm", "inherited", ".2f"),
        Column("sideways_rms_nm", "sideways, nm", ".2f"),
        Column("ellipticity_rms", "ellipticity of the bud", ".3f"),
        Column("neck_ellipticity_rms", "of the neck", ".3f"),
    )
    yield Study(
        "noise",
        3,
        runs,
        (
            Table("noise", columns, lambda made: measures.noise(made.directory("modes"), (0, 0.15, 0.3, 0.45, 0.6, 0.826, 0.9))),
            Table("noise-budding", (), lambda made: [{"run": "standard"} | measures.noise_of_budding(made.directory("modes"))]),
        ),
    )


#: Fold of the growing coat's stationary shapes, nm, by `endoflow statics` (docs/results/growing-coats.md).
FOLD = 23.3861


def growth():
    """A coat that grows through the fold of its stationary shapes, at three speeds."""
    ends = {"1e-3": 12000, "6e-4": 12000, "2.5e-4": 28000}
    runs = {
        v: f"endoflow run boundary-integral cases/growing-coat.toml {QUIET} --set molecules.edge_speed={v} --until {end}"
        for v, end in ends.items()
    }
    columns = (
        Column("speed_nm_per_us", "v, nm/µs"),
        Column("budding_us", "budding, µs", ".1f"),
        Column("coat_nm", "r_c, nm", ".5f"),
        Column("beyond_nm", "beyond the fold, nm", ".5f"),
        Column("cpu_s", "CPU, s", ".0f"),
        Column("balance", "energy balance, at most", ".0e"),
    )
    yield Study(
        "growth-speeds",
        2,
        runs,
        (Table("growth-speeds", columns, lambda made: [{"speed_nm_per_us": v} | measures.speed(made.run(v), FOLD) for v in runs]),),
    )


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


GROUPS = (standard, relatives, layers, accuracy, radii, modes, noise, growth, vesicles, smooth, paper)

STUDIES = tuple(study for group in GROUPS for study in group())

#: {table: its columns}.
COLUMNS = {table.name: table.columns for study in STUDIES for table in study.tables}
