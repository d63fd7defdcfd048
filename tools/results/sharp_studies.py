"""Studies of the sharp engine and of statics: accuracy, coats of all sizes, modes, noise, branches."""

import csv

from results import measures
from results.places import ROOT
from results.study import QUIET, SHARP, TO_BUDDING, Study, Table, of_each
from results.tables import Column

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
    yield Study("refinement", 2, runs, (Table("refinement", columns, of_each("run", measures.refinement, runs)),))

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


    certified = {name: f"{SHARP} {TO_BUDDING} {change}--certify --jobs 1" for name, change in CERTIFIED.items()}
    yield Study("certificates", 2, certified, (Table("certificates", (), of_each("case", measures.certificate, certified)),))


#: What is changed in the cases whose certificates are told.
CERTIFIED = {"standard": "--until 1 ", "patch-28": "--set molecules.patch_radius=28 --until 2 "}

#: Elements of runs that are too coarse, the last one for a coat of 70 nm.
COARSE = (("80", "36"), ("60", "36"), ("50", "36"), ("40", "36"), ("30", "36"), ("20", "36"), ("80", "70"))


def alarms():
    """Runs with too few elements: what the alarm of the energy balance says of their errors."""

    def command(elements, radius, rest=""):
        own = f"--set boundary_integral.elements={elements} --set molecules.patch_radius={radius} --set output.shape_interval=20"
        return f"{SHARP} {own}{rest} --until 20"

    runs = {f"reference-{radius}": command("160", radius, " --set time.tolerance=1e-5") for radius in ("36", "70")}
    runs |= {f"{elements}-{radius}": command(elements, radius) for elements, radius in COARSE}

    def rows(made):
        return [
            {"elements": elements, "radius_nm": radius}
            | measures.alarmed(made.run(f"{elements}-{radius}"), made.run(f"reference-{radius}"))
            for elements, radius in COARSE
        ]

    columns = (
        Column("elements", "elements"),
        Column("radius_nm", "r_c, nm"),
        Column("alarm_us", "alarm at, µs", ".3g"),
        Column("before", "largest error before", ".2g"),
        Column("balance", "largest balance", ".2g"),
        Column("error", "largest error", ".2g"),
        Column("end_us", "end, µs", ".3g"),
    )
    yield Study("alarms", 3, runs, (Table("alarms", columns, rows),), failures_are_results=True)


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

    def extremes(made):
        return measures.extremes_of_radii(made.rows("twelve-radii"))

    tables = (Table("twelve-radii", columns, of_each("radius_nm", measures.patch, runs)), Table("twelve-radii-extremes", (), extremes, derived=True))
    yield Study("twelve-radii", 4, runs, tables)


def fickian():
    """Necks of the standard case with Fickian molecules."""
    runs = {"run": f"endoflow run boundary-integral cases/fickian.toml {QUIET} --set boundary_integral.accuracy=1e-4 --until 36"}

    def rows(made):
        return [{"time_us": f"{time}", "neck_nm": measures.at(made.run("run"), "neck_radius_nm", time)} for time in (2, 10, 20, 36)]

    yield Study("fickian", 1, runs, (Table("fickian", (), rows),))


def flow():
    """The fluids' velocity while the standard case buds."""
    runs = {"run": "endoflow run boundary-integral cases/standard.toml --set output.field_interval=0.2 --set output.shape_interval=0.2 --until 0.2"}
    tables = (
        Table("flow", (), lambda made: measures.flow(made.run("run"), 0.2, 4)),
        Table("flow-membrane", (), lambda made: measures.membrane(made.run("run"), 0.2)),
    )
    yield Study("flow", 1, runs, tables)


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


#: Coats whose ellipticity by thermal noise is followed, nm.
TREMBLING = (28, 36, 40, 44)


def noise():
    """Thermal noise about the standard case, and how elliptic it makes coats of other radii."""
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
            Table("noise-inherited", (), lambda made: measures.inherited_spread(made.rows("noise"), made.rows("noise-budding")), derived=True),
        ),
    )

    runs = {"run": f"{SHARP} --until 0.9"}
    runs["modes"] = "endoflow modes {run} --noise --modes 1:2 --times 11 --ensemble 200 --tables-only"
    columns = (
        Column("time_us", "time, µs", ".2f"),
        Column("height_inherited_nm", "height, ±, linear", ".2f"),
        Column("height_rms_nm", "of 200 runs", ".2f"),
        Column("neck_inherited_nm", "neck, ±, linear", ".3f"),
        Column("neck_rms_nm", "of 200 runs", ".3f"),
    )
    yield Study("noise-ensemble", 12, runs, (Table("noise-ensemble", columns, lambda made: measures.ensemble(made.directory("modes"))),))

    runs = {}
    for radius in TREMBLING:
        runs[f"run-{radius}"] = f"{SHARP} --set molecules.patch_radius={radius} {TO_BUDDING} --until 1.6"
        runs[f"{radius}"] = f"endoflow modes {{run-{radius}}} --noise --modes 1:2 --times 17 --tables-only"

    def ellipses(made):
        return [row for radius in TREMBLING for row in measures.ellipses(made.directory(f"{radius}"), radius)]

    def sections(made):
        return [{"radius_nm": f"{radius}"} | measures.section(made.directory(f"{radius}"), made.run(f"run-{radius}")) for radius in TREMBLING]

    yield Study("noise-of-radii", 5, runs, (Table("noise-of-radii", (), ellipses), Table("noise-sections", (), sections)))


def branches():
    """Stationary shapes: a tube that is pulled, and a coat that grows until it snaps through."""
    tube = "endoflow statics cases/tube.toml --set domain.height=700 --set domain.radius={} --elements {} --continue-in membrane.pole_force=100"
    runs = {f"{radius}-{elements}": tube.format(radius, elements) for radius in (80, 200) for elements in (48, 96)}
    columns = (
        Column("run", "R, nm, elements"),
        Column("beyond_300", "beyond 300 nm", "+.2e"),
        Column("at_620", "at 620 nm", "+.1e"),
    )
    shown = {"length_nm": "bud_height_nm", "force_pN": "followed_value"}
    yield Study(
        "tube",
        1,
        runs,
        (
            Table("tube", columns, of_each("run", measures.tube, runs)),
            Table("tube-branch", (), lambda made: measures.branch(made.run("80-48"), shown)),
        ),
    )

    snap = "endoflow statics cases/snap-through.toml --elements {} --continue-in molecules.patch_radius=85"
    sizes = {f"{elements}": snap.format(elements) for elements in (24, 48, 96)}
    folds = (Column("elements", "elements"), Column("fold_1", "first fold, nm", ".8f"), Column("fold_2", "second fold, nm", ".8f"))
    points = {"radius_nm": "patch_radius_nm", "height_nm": "bud_height_nm", "neck_nm": "neck_radius_nm"}
    yield Study(
        "snap-through",
        1,
        sizes,
        (
            Table("snap-through", folds, of_each("elements", measures.folds, sizes)),
            Table("snap-through-branch", (), lambda made: measures.branch(made.run("48"), points)),
        ),
    )
