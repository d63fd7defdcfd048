"""The study of `endoflow infer` with data whose truth is known."""

import json

from results.study import QUIET, Study, Table
from results.tables import Column

#: The unknowns, by their names in the study, and their true values.
TRUTH = {"coat stiffness": "1100", "cytosol viscosity": "0.011"}

#: Samples of the posterior that are kept.
SAMPLES = 600


def found(made):
    """infer.json."""
    return json.loads((made.directory("infer") / "infer.json").read_text("utf-8"))


def unknowns(made):
    """Truth, best fit and 90 % interval of each unknown, and its prior."""
    kept = ("best", "median", "low", "high", "prior_low", "prior_high")
    return [{"unknown": one["name"], "truth": float(TRUTH[one["name"]])} | {key: one[key] for key in kept} for one in found(made)["unknowns"]]


def fit(made):
    """χ², the emulator's error, runs, and what of the unknowns' combinations is known."""
    record = found(made)
    row = {"data": "necks", "chi_square": record["fit"]["chi_square"], "degrees": record["fit"]["degrees_of_freedom"]}
    row |= {"runs": record["runs"]["total"], "emulator": record["emulator"]["check"]["worst"]}
    for which, one in zip(("first", "second"), record["directions"]):
        row |= {f"{which}_combination": one["combination"], f"{which}_shrinkage": one["shrinkage"]}
    return [row]


def calibration(made):
    """How often regions hold the truth."""
    record = found(made)["calibration"]
    worst = min(one["p_value"] for one in record["ranks"])
    return [{"level": f"{one['level']:g}"} | {key: one[key] for key in ("held", "by_chance_low", "by_chance_high")} | {"least_p": worst} for one in record["coverage"]]


def sensitivity(made):
    """Sobol indices, of the stiffness and of the viscosity."""
    rows = []
    for one in found(made)["sensitivity"]:
        row = {"result": one["result"], "mean": one["mean"], "deviation": one["deviation"]}
        for name, of in zip(("stiffness", "viscosity"), one["unknowns"]):
            row |= {f"{name}_first": of["first"], f"{name}_total": of["total"]}
        rows.append(row)
    return rows


def samples(made):
    """Samples of the posterior, evenly taken from the chain."""
    rows = made.csv("infer", "posterior.csv")
    return [{"sample": f"{number}"} | rows[number * len(rows) // SAMPLES] for number in range(SAMPLES)]


def inference():
    """Two unknowns from thirty neck radii of a run of the sharp engine."""
    set_true = f"--set membrane.bending_stiffness_coated={TRUTH['coat stiffness']} --set fluid.viscosity_intracellular={TRUTH['cytosol viscosity']}"
    coarse = "--set boundary_integral.elements=40 --set time.tolerance=1e-3"
    runs = {
        "truth": f"endoflow run boundary-integral cases/standard.toml {QUIET} {coarse} {set_true} --until 0.7",
        "data": "python3 tools/results/noisy_necks.py {truth}",
        "infer": "endoflow infer {data}/study.toml --calibrate 100 --sensitivity --jobs 1",
    }
    interval = (
        Column("unknown", "unknown"),
        Column("truth", "truth"),
        Column("best", "best", ".4g"),
        Column("low", "90 % interval, from", ".4g"),
        Column("high", "to", ".4g"),
    )
    held = (
        Column("level", "region"),
        Column("held", "holds the truth", ".0%"),
        Column("by_chance_low", "by chance, 95 %, from", ".0%"),
        Column("by_chance_high", "to", ".0%"),
    )
    shown = {"stiffness_first": "coat stiffness, alone", "stiffness_total": "in all", "viscosity_first": "cytosol viscosity, alone", "viscosity_total": "in all"}
    sobol = (
        Column("result", "result"),
        Column("mean", "mean", ".4g"),
        Column("deviation", "deviation", ".2g"),
        *(Column(name, title, ".3f") for name, title in shown.items()),
    )
    tables = (
        Table("inference", interval, unknowns),
        Table("inference-fit", (), fit),
        Table("inference-calibration", held, calibration),
        Table("inference-sensitivity", sobol, sensitivity),
        Table("inference-posterior", (), samples),
    )
    yield Study("inference", 6, runs, tables)
