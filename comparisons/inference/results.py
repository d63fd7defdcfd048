"""infer.json (schema_version 1), posterior.csv, predictive.csv and pits.csv of a study. Values are in the parameters' own units.

infer.json:

    schema_version        1
    study                 {file, case, engine, seed, version}
    runs                  {total, failed, alarmed, first_alarm}: of the engine, also those of earlier calls; alarmed ones left
                          the bounds of an accurate run
    warnings              [text]
    unknowns              [{name, unit, best, linear_low, linear_high, median, low, high, prior_low, prior_high, at_limit,
                          needs_runs}]: best fit with the 90 % interval of the linearised posterior, posterior median with its
                          90 % interval, whether the best fit lies at a limit of the prior
    covariance            of the unknowns at the best fit, linearised, in the order of `unknowns`; of logarithms where the prior
                          is logarithmic
    fit                   {chi_square, degrees_of_freedom, p_value, evaluations, outcome, data, outside, pits}: `outside` data have
                          no counterpart in the run; those without any number there count neither for χ² nor for the degrees; each
                          of `pits`, which were seen once, takes a degree for its time
    directions            [{combination, deviation, shrinkage, verdict, vector}], see comparisons/inference/sensitivity.py
    posterior             {samples, effective, autocorrelation, acceptance, converged, budding_time_us: {median, low, high} or null}
    emulator              {degree, runs, excluded, error, check: {size, worst, unlike, runs}, crowded}: errors in those of the data
    calibration           see comparisons/inference/calibration.py; only with --calibrate. truth: the directory of --truth, or null
    sensitivity           see comparisons/inference/sensitivity.py; only with --sensitivity

posterior.csv: one sample in a row, a column for each unknown. predictive.csv: column, time_us, low, median, high (90 % band).
pits.csv, of pits that were seen once: place (file and line), low, median and high of their time in the run (µs, 90 %), misfit (distance
from the best fit's path, in errors).
"""

import math

import numpy as np
from scipy.stats import chi2

from comparisons.files import write_table
from comparisons.inference.course import BUDDED, batch_of, values_at, within_course
from comparisons.inference.pipeline import ACCURATE, CROWD
from comparisons.inference.sampling import LENGTH
from comparisons.inference.sensitivity import directions
from comparisons.inference.study_keys import MEASURABLE

#: Samples in posterior.csv.
WRITTEN_SAMPLES = 4000

#: Ends of a 90 % interval: quantiles, and standard deviations of a normal one.
LOW, HIGH, DEVIATIONS = 0.05, 0.95, 1.6449

#: Samples and times of a band; it is drawn where this fraction of the samples has the quantity.
BAND_SAMPLES, BAND_TIMES, BAND_EXISTS = 400, 120, 0.95

#: A best fit nearer to a limit of its prior than this, in the prior's coordinate, lies at the limit.
AT_LIMIT = 0.01

#: A fit with a smaller probability is worth a warning.
LEAST_P_VALUE = 1e-3


def head(problem, file):
    """The part of infer.json that says what was studied; file: the study's path."""
    study, case = problem.study, problem.parameters["case"]["name"]
    return {"schema_version": 1, "study": {"file": str(file), "case": case, "engine": study.engine, "seed": study.seed}}


def runs_entry(simulator):
    """The entry `runs` of infer.json, of a Simulator."""
    return {
        "total": len(simulator.courses_by_name),
        "failed": len(simulator.failures),
        "alarmed": len(simulator.alarmed),
        "first_alarm": next(iter(simulator.alarmed.values()), None),
    }


def fit_results(problem, inference, units):
    """The part of infer.json that comes from the data; units: {key: unit} of parameters."""
    fit, posterior, trained = inference.fit, inference.posterior, inference.trained
    known = np.isfinite(fit.residuals)
    freedom = max(0, int(known.sum()) - len(problem.unknowns) - (len(problem.pits) if known[problem.of_pits].any() else 0))
    batch = trained.batch(posterior.x[:, : problem.engine_count])
    covered = problem.covered(batch_of([fit.course]), fit.x[None, :])[0]
    factor, offset = problem.clocks(posterior.x)
    budding = batch.end * factor[:, 0] + offset[:, 0] if batch.outcome == BUDDED else None
    return {
        "unknowns": unknown_table(problem, fit, posterior, units),
        "covariance": (np.outer(*2 * [[p.scale for p in problem.priors]]) * fit.covariance).tolist(),
        "fit": {
            "chi_square": fit.chi_square,
            "degrees_of_freedom": freedom,
            "p_value": float(chi2.sf(fit.chi_square, freedom)) if freedom else None,
            "evaluations": fit.evaluations,
            "outcome": fit.course.outcome,
            "data": len(problem.data),
            "outside": int(np.sum(~covered)),
            "pits": len(problem.pits),
        },
        "directions": [
            {
                "combination": one.words,
                "deviation": one.deviation if math.isfinite(one.deviation) else None,
                "shrinkage": one.shrinkage,
                "verdict": one.verdict,
                "vector": one.vector.tolist(),
            }
            for one in directions(problem, fit.jacobian)
        ],
        "posterior": {
            "samples": len(posterior.x),
            "effective": _finite(posterior.effective),
            "autocorrelation": _finite(posterior.autocorrelation),
            "acceptance": posterior.acceptance,
            "converged": posterior.converged,
            "budding_time_us": None if budding is None else interval(budding),
        },
        "emulator": {
            **emulator_results(problem, trained),
            "check": {key: _finite(value) for key, value in vars(inference.check).items()},
            "crowded": inference.crowded,
        },
    }


def _finite(value):
    return value if math.isfinite(value) else None


def emulator_results(problem, trained):
    """Degree, runs and error of an emulator; the error is the largest over the data, in errors of the data."""
    error = float(np.max(trained.errors / problem.errors)) if len(problem.data) else None
    return {
        "degree": trained.emulator.degree,
        "runs": len(trained.emulator.points),
        "excluded": trained.excluded,
        "error": error,
    }


def unknown_table(problem, fit, posterior, units):
    """The entries of `unknowns`, in the order of Problem.unknowns."""
    deviations = np.sqrt(np.diag(fit.covariance))
    entries = []
    for i, (unknown, prior) in enumerate(zip(problem.unknowns, problem.priors)):
        ends = np.clip(fit.x[i] + DEVIATIONS * deviations[i] * np.array([-1, 1]), prior.lowest, prior.highest)
        linear = prior.value(ends)
        timelike = unknown.time_offset or not (unknown.key or unknown.scales)
        entries.append(
            {
                "name": unknown.name,
                "unit": "µs" if timelike else units.get(unknown.key, ""),
                "best": float(prior.value(fit.x[i])),
                "linear_low": float(linear[0]),
                "linear_high": float(linear[1]),
                **interval(prior.value(posterior.x[:, i])),
                "prior_low": float(prior.value(prior.lowest)),
                "prior_high": float(prior.value(prior.highest)),
                "at_limit": bool(min(fit.x[i] - prior.lowest, prior.highest - fit.x[i]) < AT_LIMIT),
                "needs_runs": i < problem.engine_count,
            }
        )
    return entries


def interval(values):
    """{median, low, high} of samples (n,): a 90 % interval."""
    low, median, high = np.quantile(values, (LOW, 0.5, HIGH))
    return {"median": float(median), "low": float(low), "high": float(high)}


def bands(problem, inference):
    """{column: (times, low, median, high)} of the measured curves, each (n,), in the data's time; nan where hardly any sample
    has the quantity."""
    x = inference.posterior.x[np.linspace(0, len(inference.posterior.x) - 1, BAND_SAMPLES).astype(int)]
    batch = inference.trained.batch(x[:, : problem.engine_count])
    factor, offset = problem.clocks(x)
    found = {}
    for column in MEASURABLE:
        times = [datum.time for datum in problem.data if datum.column == column]
        if not times:
            continue
        grid = np.linspace(min(0, *times), 1.15 * max(times), BAND_TIMES)
        own = (grid[None, :] - offset) / factor
        values = np.where(within_course(batch, column, own), values_at(batch, column, own), np.nan)
        enough = np.isfinite(values).mean(axis=0) >= BAND_EXISTS
        band = np.full((3, BAND_TIMES), np.nan)
        band[:, enough] = np.nanquantile(values[:, enough], (LOW, 0.5, HIGH), axis=0)
        found[column] = (grid, *band)
    return found


def pit_rows(problem, inference):
    """Rows of pits.csv: of each sample of the posterior one time is drawn for each pit."""
    x = inference.posterior.x[np.linspace(0, len(inference.posterior.x) - 1, BAND_SAMPLES).astype(int)]
    errors = np.hypot(problem.errors, inference.trained.errors)
    fractions = np.random.default_rng(problem.study.seed).random((len(x), len(problem.pits)))
    found = problem.pit_times(inference.trained.batch(x[:, : problem.engine_count]), errors, fractions)
    own = iter(inference.fit.residuals[problem.of_pits])
    misfits = [math.hypot(*(next(own) for _ in pit.data)) for pit in problem.pits]
    rows = []
    for pit, times, misfit in zip(problem.pits, found.T, misfits):
        numbers = {f"{name}_us": value for name, value in interval(times).items()}
        rows.append({"place": pit.place, **numbers, "misfit": misfit})
    return rows


def write_tables(problem, inference, bands, directory):
    """Write posterior.csv, predictive.csv and pits.csv into directory (Path); bands: as of bands()."""
    x = inference.posterior.x
    chosen = problem.display(x[np.linspace(0, len(x) - 1, min(len(x), WRITTEN_SAMPLES)).astype(int)])
    write_table(directory / "posterior.csv", [dict(zip(problem.names, map(float, row))) for row in chosen])
    rows = []
    for column, curves in bands.items():
        for row in zip(*curves):
            numbers = (None if np.isnan(value) else float(value) for value in row)
            rows.append({"column": column, **dict(zip(("time_us", "low", "median", "high"), numbers))})
    if rows:
        write_table(directory / "predictive.csv", rows)
    if problem.pits:
        write_table(directory / "pits.csv", pit_rows(problem, inference))


def warnings(results):
    """What a reader must know before trusting a study's results (the dict of infer.json)."""
    found, runs = [], results["runs"]
    if runs["alarmed"]:
        what = f"{runs['alarmed']} of {runs['total']} runs left the bounds of an accurate run"
        found.append(f"{what}; one: {runs['first_alarm']}")
    fit, emulator, posterior = (results.get(name) for name in ("fit", "emulator", "posterior"))
    if fit is None:
        return found
    if chi2.sf(fit["chi_square"], max(1, fit["degrees_of_freedom"])) < LEAST_P_VALUE:
        found.append(
            f"the best fit misses the data by more than their errors allow: χ² = {fit['chi_square']:.4g} for "
            f"{fit['degrees_of_freedom']} degrees of freedom; the model, the case or the errors are not those of the data"
        )
    at_limit = [one["name"] for one in results["unknowns"] if one["at_limit"]]
    if at_limit:
        found.append(f"the best fit lies at a limit of its prior: {', '.join(at_limit)}; widen it if more is possible")
    if fit["outside"]:
        where = "where the best run has no such number (before its neck, after its end)"
        found.append(f"{fit['outside']} of {fit['data']} data lie {where}")
    check = emulator["check"]
    if check["size"] is None or check["size"] > ACCURATE or check["unlike"]:
        found.append(
            "the emulator differs from the engine at samples of the posterior "
            f"({check['unlike']} of {check['runs']} runs end differently); take narrower priors"
        )
    if emulator["crowded"] > CROWD:
        found.append("the posterior reaches beyond the region of the emulator: its intervals are too narrow")
    if not posterior["converged"]:
        found.append(f"the chain is shorter than {LENGTH} autocorrelation times: intervals are uncertain")
    loose = [one["combination"] for one in results["directions"] if one["verdict"] == "not separated"]
    if loose:
        found.append("the data do not separate " + "; nor ".join(loose) + ": what is said of these comes from the priors")
    return found
