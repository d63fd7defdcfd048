"""Studies of the standard case and its relatives by both engines, of thin layers, and of the diffuse engine's numerical parameters."""

from results import measures
from results.study import DIFFUSE, SHARP, TO_BUDDING, Study, Table
from results.tables import Column

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
            Table("standard-history", (), lambda made: measures.early(made.run("to-20"))),
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


#: The relatives of the standard case: what they change, and their end (µs), unless they bud before.
RELATIVES = {
    "molecules.patch_radius=28": 3,
    "molecules.patch_radius=32": 3,
    "molecules.patch_radius=44": 3,
    "molecules.patch_radius=60": 3,
    "fluid.viscosity_intracellular=1e-3": 3,
    "fluid.viscosity_intracellular=5e-2": 6,
    "molecules.interface_width=0.6": 3,
    "molecules.interface_width=2.4": 3,
    "membrane.constitutive_law=coarse-grained": 3,
    "membrane.constitutive_law=lumped": 3,
    "domain.radius=120": 3,
    "molecules.transport=fickian": 0.5,
    "molecules.transport=advection": 0.5,
    "membrane.curvature_convention=consistent": 1,
    "molecules.patch_radius=20": 3,
    "membrane.bending_stiffness_coated=300": 2.2,
}

#: What belongs to a change that is made of several keys.
TOGETHER = {"domain.radius=120": "--set domain.height=240 --set domain.membrane_height=120"}


def relatives():
    """Both engines, one change of the standard case at a time."""
    runs = {}
    for change, end in RELATIVES.items():
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
