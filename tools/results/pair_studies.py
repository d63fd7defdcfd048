"""Studies of loads by both engines, of closed vesicles, and of molecules that come from a fluid."""

from results import load_measures, measures
from results.study import QUIET, Study, Table, of_each
from results.tables import Column

ENGINES = ("boundary-integral", "phase-field")


def of_both(command, label="{engine}"):
    """{label: command} of both engines; command: what stands behind the engine's name."""
    return {label.format(engine=engine): f"endoflow run {engine} {command}" for engine in ENGINES}


def pair(made, label="{engine}"):
    """Both engines' runs of a label, the sharp one first."""
    return [made.run(label.format(engine=engine)) for engine in ENGINES]


#: Semi-axes (nm) of vesicles with the area of a sphere of 40 nm, by their reduced volumes.
PROLATE = {"0.8": (73.62, 26.37), "0.9": (60.529, 30.848), "0.95": (53.381, 33.749)}
OBLATE = (13.68, 52.98)


def vesicles():
    """Closed vesicles that relax, in both engines."""

    def case(axes, rest):
        polar, equatorial = axes
        return f"cases/closed_vesicle.toml --set domain.spheroid_polar_axis={polar} --set domain.spheroid_equatorial_axis={equatorial} {rest} {QUIET}"

    runs = {}
    for volume, axes in PROLATE.items():
        runs |= of_both(case(axes, "--until 5"), f"{{engine}}-{volume}")
    runs |= of_both(case(OBLATE, "--set phase_field.epsilon=1.7 --until 0.5"), "{engine}-oblate")
    columns = (
        Column("time_us", "t, µs"),
        Column("energy_sharp_pN_nm", "energy, sharp, pN nm", ".2f"),
        *(Column(name, name, "+.3%") for name in ("energy", "height", "volume")),
    )
    shown = (Column("reduced_volume", "reduced volume"), *(Column(name, name, "+.3%") for name in ("energy", "height", "volume")))

    def rows(made):
        return measures.relaxation(*pair(made, "{engine}-0.8"), (0.01, 0.1, 0.5, 1, 5))

    def ends(made):
        return [{"reduced_volume": volume} | load_measures.vesicle(*pair(made, f"{{engine}}-{volume}")) for volume in PROLATE]

    def oblate(made):
        return [{"run": "oblate"} | load_measures.vesicle(*pair(made, "{engine}-oblate"))]

    tables = (Table("vesicle", columns, rows), Table("vesicles-end", shown, ends), Table("vesicle-oblate", (), oblate))
    yield Study("vesicle", 13, runs, tables)


def loads():
    """A tube that is pulled, a growing coat under tension and pressure, and a domain that its edge closes."""
    tube = (
        "cases/tube.toml --set domain.height=200 --set domain.membrane_height=60 --set molecules.interface_width=6 "
        f"--set molecules.patch_radius=40 --set membrane.pole_force=60 {QUIET} --until 3"
    )
    columns = (
        Column("time_us", "time, µs"),
        Column("height_sharp_nm", "height, sharp, nm", ".3f"),
        Column("height", "difference", "+.2%"),
        Column("speed_sharp_nm_per_us", "speed, sharp, nm/µs", ".2f"),
        Column("speed", "difference", "+.2%"),
    )
    tables = (
        Table("pulled-tube", columns, lambda made: load_measures.pulled(*pair(made), (0.01, 0.5, 1, 2.5))),
        Table("pulled-tube-kept", (), lambda made: [{"run": "tube"} | load_measures.cost_of_both(*pair(made))]),
    )
    yield Study("pulled-tube", 9, of_both(tube), tables)


#: Diffusivities of the molecules in the fluid (nm²/µs); without one they come from a reservoir.
BULK = ("1e6", "2e4", "2e3")


def fluids():
    """A small coat that takes its molecules from a fluid, or from a reservoir."""
    case = (
        "endoflow run phase-field cases/standard.toml --set domain.radius=40 --set domain.height=40 --set domain.membrane_height=20 "
        "--set molecules.patch_radius=16 --set molecules.interface_width=3 --set phase_field.epsilon=2.4 --set phase_field.cell_size=2.5 "
        "--set phase_field.far_refinements=2 --set molecules.exchange=reservoir --set molecules.on_rate=500 --set molecules.off_rate=200 "
        f"--set molecules.molecule_area=50 {QUIET} --until 5e-4"
    )
    bulk = "--set molecules.bulk=intracellular --set molecules.bulk_concentration=5e-4 --set molecules.bulk_diffusivity"
    runs = {"reservoir": case} | {diffusivity: f"{case} {bulk}={diffusivity}" for diffusivity in BULK}
    columns = (
        Column("diffusivity", "D_b, nm²/µs", ".0e"),
        Column("gained_nm2", "coat gained, nm²", ".2f"),
        Column("molecules", "molecules in the fluid", ".2f"),
        Column("supply", "c_b/c_∞ at the membrane", ".3f"),
        Column("corrected_nm2", "put right, nm²", ".2f"),
        Column("balance", "fluid and membrane balanced to", ".0e"),
        Column("steps", "steps", ".0f"),
    )
    yield Study("bulk", 4, runs, (Table("bulk", columns, of_each("diffusivity", load_measures.from_fluid, runs)),))
