"""Studies of loads, of coats that grow and of domains that their edge closes, by the sharp engine and statics."""

from results import load_measures, measures
from results.places import ROOT
from results.study import ENGINES, QUIET, Study, Table, of_each
from results.tables import Column, numbers

GROWING = f"endoflow run boundary-integral cases/growing-coat.toml {QUIET}"
#: The same case at rest: without exchange, and without its pool.
AT_REST = "endoflow statics cases/growing-coat.toml --set molecules.exchange=none --set molecules.edge_speed=0 --set molecules.pool_area=0"

#: Radii of coats (nm) at which a growing one is compared with one at rest.
RESTING = ("20.8", "21.7", "22.7", "23.2")


def growth():
    """A coat that grows through the fold of its stationary shapes, at three speeds; flat coats that grow."""
    ends = {"1e-3": 12000, "6e-4": 12000, "2.5e-4": 28000}
    runs = {v: f"{GROWING} --set molecules.edge_speed={v} --until {end}" for v, end in ends.items()}
    branch = {"fold": f"{AT_REST} --continue-in molecules.patch_radius=30"}
    rests = {f"rest-{radius}": f"{AT_REST} --set molecules.patch_radius={radius}" for radius in RESTING}

    def rows(made):
        fold = measures.folds(made.run("fold"))["fold_1"]
        return [{"speed_nm_per_us": v} | load_measures.speed(made.run(v), fold) for v in runs]

    def beside(made):
        return [
            {"radius_nm": radius} | load_measures.beside_rest(made.run("1e-3"), made.run(f"rest-{radius}")) for radius in RESTING
        ]

    columns = (
        Column("speed_nm_per_us", "v, nm/µs"),
        Column("budding_us", "budding, µs", ".1f"),
        Column("coat_nm", "r_c, nm", ".5f"),
        Column("beyond_nm", "beyond the fold, nm", ".5f"),
        Column("cpu_s", "CPU, s", ".0f"),
        Column("balance", "energy balance, at most", ".0e"),
    )
    shown = (
        Column("radius_nm", "r_c of equal mass, nm"),
        Column("time_us", "t, µs", ".0f"),
        Column("neck_radius_nm", "neck, nm", ".4f"),
        Column("neck_radius_nm_at_rest", "statics", ".4f"),
        Column("bud_height_nm", "height, nm", ".3f"),
        Column("bud_height_nm_at_rest", "statics", ".3f"),
    )
    yield Study(
        "growth-speeds",
        2,
        branch | runs | rests,
        (
            Table("growth-speeds", columns, rows),
            Table("growth-at-rest", shown, beside),
            Table("growth-power", (), lambda made: load_measures.passing(made.rows("growth-speeds")), derived=True),
        ),
    )

    flat = "--set membrane.spontaneous_curvature=0 --set boundary_integral.elements=80 --set molecules.exchange=edge --set molecules.edge_speed=1e-3"
    each = {"advection": "--set time.tolerance=1e-6 --until 7152", "cahn-hilliard": "--set time.tolerance=1e-4 --until 8000"}
    flats = {
        transport: f"endoflow run boundary-integral cases/standard.toml {QUIET} {flat} --set molecules.transport={transport} {rest}"
        for transport, rest in each.items()
    }
    columns = (
        Column("transport", "transport"),
        Column("tolerance", "tolerance", ".0e"),
        Column("end_us", "at, µs", ".0f"),
        Column("radius_nm", "radius, nm", ".3f"),
        Column("expected_nm", "expected", ".3f"),
    )
    yield Study("flat-coats", 2, flats, (Table("flat-coats", columns, of_each("transport", load_measures.flat_coat, flats)),))


def line_tension():
    """A domain that its line tension closes, and one that comes to rest as a dome."""
    case = "cases/line-tension.toml --set output.stop_at_budding=false"
    runs = {
        "default": f"endoflow run boundary-integral {case} {QUIET} --until 7.4",
        "fine": f"endoflow run boundary-integral {case} {QUIET} --set boundary_integral.elements=120 --until 10",
    }
    dome = (
        f"{case} --set molecules.line_energy=40 --set membrane.spontaneous_curvature=0.01 "
        "--set membrane.bending_stiffness_coated=150 --set membrane.rim_tension=0.05"
    )
    rests = {"dome": f"endoflow run boundary-integral {dome} {QUIET} --until 60", "rest": f"endoflow statics {dome}"}

    def domes(made):
        return [{"run": "dome"} | load_measures.at_rest(made.run("dome"), made.run("rest"))]

    tables = (Table("line-tension", (), of_each("run", load_measures.closing, runs)), Table("line-tension-dome", (), domes))
    yield Study("line-tension", 1, runs | rests, tables)


#: Tensions (pN/nm) whose stationary shapes are followed, by the names of their runs.
FOLLOWED = {"half": "0.5", "one": "1", "two": "2"}


def pit():
    """A coat that grows and matures under tension, pulled by actin on a ring, with a collar, in both engines."""
    runs = {engine: f"endoflow run {engine} cases/pit.toml" for engine in ENGINES}
    columns = (
        Column("time_us", "t, µs"),
        Column("height_sharp_nm", "height, sharp, nm", ".3f"),
        *(Column(name, name, "+.2%") for name in ("height", "neck", "volume", "energy", "load power")),
    )
    events = (
        Column("event", "event"),
        Column("sharp_us", "sharp, µs", ".5f"),
        Column("diffuse_us", "diffuse, µs", ".5f"),
        Column("later", "later by", "+.2%"),
    )

    def rows(made):
        return load_measures.engines_beside(*(made.run(engine) for engine in runs), (0.01, 0.1, 0.3, 0.5, 0.7, 0.9))

    def of_events(made):
        sharp, diffuse = (made.run(engine) for engine in runs)
        found = [(name, sharp.event_time(name), diffuse.event_time(name)) for name in ("collar", "budding")]
        return [{"event": name, "sharp_us": one, "diffuse_us": other, "later": other / one - 1} for name, one, other in found]

    yield Study("pit", 10, runs, (Table("pit", columns, rows), Table("pit-events", events, of_events)))


def loaded():
    """A tube that is pulled, and the standard case under tension and pressure with a coat that grows, in both engines."""
    tube = (
        "cases/tube.toml --set domain.height=200 --set domain.membrane_height=60 --set molecules.interface_width=6 "
        "--set molecules.patch_radius=40 --set membrane.pole_force=60"
    )
    coat = (
        "cases/standard.toml --set membrane.rim_tension=0.05 --set fluid.pressure_difference=1e-4 --set molecules.exchange=edge "
        "--set molecules.edge_speed=50 --set molecules.pool_area=6000 --set output.stop_at_budding=true"
    )
    tubes = {engine: f"endoflow run {engine} {tube} {QUIET} --until 3" for engine in ENGINES}
    columns = (
        Column("time_us", "time, µs"),
        Column("height_sharp_nm", "height, sharp, nm", ".3f"),
        Column("height", "difference", "+.2%"),
        Column("speed_sharp_nm_per_us", "speed, sharp, nm/µs", ".2f"),
        Column("speed", "difference", "+.2%"),
    )

    def rows(made):
        return load_measures.pulled(*map(made.run, ENGINES), (0.01, 0.5, 1, 2.5))

    def kept(made):
        return [{"run": "diffuse"} | measures.kept(made.run("phase-field"))]

    yield Study("pulled-tube", 20, tubes, (Table("pulled-tube", columns, rows), Table("pulled-tube-kept", (), kept)))

    coats = {engine: f"endoflow run {engine} {coat} {QUIET} --until 6" for engine in ENGINES}

    def largest(made):
        return [{"case": "loaded-coat"} | measures.largest_differences(*map(made.run, ENGINES))]

    yield Study("loaded-coat", 10, coats, (Table("loaded-coat", (), largest),))


def phase_diagram():
    """What becomes of ready-made coats under tension, over the coat's radius and the tension."""
    case = "cases/phase-diagram.toml"
    runs = {
        name: f"endoflow statics {case} --set molecules.patch_radius=18 --set membrane.rim_tension={tension} --continue-in molecules.patch_radius=44"
        for name, tension in FOLLOWED.items()
    }
    vary = "--vary molecules.patch_radius=18:44 --vary membrane.rim_tension=0:3 --levels 1 --until 3"
    folds = " ".join(f"--folds {{{name}}}" for name in FOLLOWED)
    runs["map"] = f"endoflow map {case} {vary} {folds} --jobs 1"

    def stationary(made):
        return [{"tension_pN_per_nm": tension} | load_measures.stationary(made.run(name)) for name, tension in FOLLOWED.items()]

    columns = (
        Column("tension_pN_per_nm", "σ, pN/nm"),
        Column("fold_1", "first fold, nm", ".2f"),
        Column("fold_2", "second fold, nm", ".2f"),
        Column("closes", "neck closes, nm", ".2f"),
    )
    yield Study(
        "phase-diagram",
        5,
        runs,
        (
            Table("phase-diagram", (), lambda made: load_measures.outcomes(made.csv("map", "map.csv"))),
            Table("phase-diagram-boundaries", (), lambda made: load_measures.boundaries(made.csv("map", "boundaries.csv"))),
            Table("phase-diagram-counts", (), lambda made: load_measures.counts(made.csv("map", "map.csv"))),
            Table("phase-diagram-folds", columns, stationary),
        ),
    )


def stationary():
    """Stationary shapes of the paper's parameters: a coat of 22 nm with its molecules in three ways, and where branches end."""
    case = "endoflow statics cases/statics.toml"
    ways = {"disc-mass": f"{case} --disc-mass", "equilibrium": case, "frozen": f"{case} --set molecules.transport=advection"}
    larger, bent = "--continue-in molecules.patch_radius=30", "--continue-in membrane.spontaneous_curvature=0.1"
    ends = {f"{name}-coat": f"{command} {larger}" for name, command in ways.items()}
    ends |= {"curvature-22": f"{case} --set membrane.spontaneous_curvature=0.01 {bent}"}
    ends |= {"curvature-36": f"endoflow statics cases/standard.toml --set membrane.spontaneous_curvature=0.01 {bent}"}
    columns = (
        Column("molecules", "molecules"),
        Column("neck_radius_nm", "neck nm", ".6f"),
        Column("bud_diameter_nm", "diameter nm", ".6f"),
        Column("membrane_area_nm2", "area nm²", ".4f"),
        Column("curve_length_nm", "length nm", ".5f"),
        Column("apex_height_nm", "height nm", ".6f"),
    )
    names = [column.name for column in columns[1:]]

    def shapes(made):
        text = (ROOT / "tests" / "reference" / "statics.csv").read_text("utf-8")
        reference = numbers(line for line in text.splitlines() if not line.startswith("#"))[0]
        first = {"molecules": "reference"} | {name: reference[name.replace("apex_height", "apex_height_above_rim")] for name in names}
        return [first] + [{"molecules": way} | {name: float(made.run(way).history[name][-1]) for name in names} for way in ways]

    tables = (
        Table("stationary-shapes", columns, shapes),
        Table("stationary-ends", (), of_each("branch", load_measures.stationary, ends)),
    )
    yield Study("stationary", 1, ways | ends, tables)
