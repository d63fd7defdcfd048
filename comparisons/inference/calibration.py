"""Does the machinery tell the truth? Ranks of true values among posterior samples, and how often regions hold them.

Simulation-based calibration (Talts et al., arXiv:1804.06788): true values are drawn from the priors, data from a run with
them and from the errors; then the ranks of true values among independent samples of the posterior are uniform, and a region
of 90 % holds the truth in 90 % of the cases. The runs that make the data are not those that the emulator is made from.
With the data of one run of the other engine, and errors drawn anew, the same counts show what the engines' difference does.
"""

from dataclasses import dataclass

import numpy as np
from scipy.stats import binom, chisquare

import endoflow
from comparisons.errors import BAD_INPUT, StudyError
from comparisons.inference.best_fit import prior_precision
from comparisons.inference.course import CourseError, batch_of, course_of
from comparisons.inference.emulator import slopes
from comparisons.inference.sampling import Density, ensemble, highest_density_level

#: Samples among which a true value is ranked, and groups of ranks.
SAMPLES, GROUPS = 99, 10

#: Regions whose coverage is counted.
LEVELS = (0.5, 0.9)

#: Walkers and steps of a case: many walkers and few steps cost least. The first half of the steps is left out.
WALKERS, STEPS = 100, 400


@dataclass(frozen=True)
class Case:
    """truth (unknowns,) in x, ranks (unknowns,) 0 … SAMPLES, held: whether the region of each level holds the truth."""

    truth: np.ndarray
    ranks: np.ndarray
    held: tuple


def truths(problem, count, seed):
    """Coordinates (count, unknowns) drawn from the priors."""
    return problem.points(np.random.default_rng(seed).random((count, len(problem.unknowns))))


def truth_of_run(problem, directory):
    """(coordinates (unknowns,), Course) of a run of either engine, made outside of the study. Raises StudyError."""
    try:
        run = endoflow.load(directory)
        return problem.coordinates(run.parameters), course_of(run, problem.columns, problem.contours)
    except (endoflow.EndoflowError, CourseError) as error:
        raise StudyError(f"--truth {directory}: {error}", BAD_INPUT) from None


def calibrate(problem, trained, truth, course, seed):
    """The Case of a truth (unknowns,) whose run is `course`; None when that run failed or ended unlike those of the emulator."""
    if course is None or course.outcome != trained.outputs.outcome:
        return None
    generator = np.random.default_rng(seed)
    noise = generator.standard_normal(len(problem.data)) * problem.errors
    exact = problem.drawn(batch_of([course]), truth[None, :], generator)[0]
    density = Density(problem, trained, exact + noise)
    jacobian = slopes(problem, trained, truth)
    covariance = np.linalg.inv(jacobian.T @ jacobian + prior_precision(problem))
    sampler, state = ensemble(density, truth, covariance, seed, WALKERS)
    sampler.run_mcmc(state, STEPS, skip_initial_state_check=True)
    x, levels = sampler.get_chain(discard=STEPS // 2, flat=True), sampler.get_log_prob(discard=STEPS // 2, flat=True)
    chosen = np.linspace(0, len(x) - 1, SAMPLES).astype(int)
    own = float(density(truth[None, :])[0])
    return Case(
        truth,
        np.sum(x[chosen] < truth, axis=0),
        tuple(own >= highest_density_level(levels, level) for level in LEVELS),
    )


def calibration(problem, simulator, trained, count, directory, say):
    """The entry `calibration` of infer.json, of `count` cases; directory: of a run whose parameters are true, or None.

    say(text) is told each stage. Raises StudyError when no case is like the emulator's runs.
    """
    seed = problem.study.seed + 100
    if directory:
        x, course = truth_of_run(problem, directory)
        truth, courses = [x] * count, [course] * count
    else:
        truth = truths(problem, count, seed)
        say(f"calibration: {count} run(s) with true values drawn from the priors")
        courses = simulator.courses(truth[:, : problem.engine_count])
    say(f"calibration: {count} posteriors on the emulator")
    kept = []
    for number, (x, course) in enumerate(zip(truth, courses)):
        simulator.study.stop_if_interrupted()
        case = calibrate(problem, trained, x, course, seed + 1 + number)
        kept += [case] if case is not None else []
    if not kept:
        raise StudyError("no calibration case ends as the emulator's runs do; narrow the priors", BAD_INPUT)
    left_out, origin = count - len(kept), str(directory) if directory else None
    return {**summary(problem, kept), "left_out": left_out, "truth": origin}


def summary(problem, cases):
    """What the Cases say, as a dict for JSON: coverage with the 95 % interval that chance allows, ranks in groups, p-values."""
    count = len(cases)
    coverage = []
    for number, level in enumerate(LEVELS):
        low, high = binom.ppf((0.025, 0.975), count, level) / count
        held = float(np.mean([case.held[number] for case in cases]))
        coverage.append({"level": level, "held": held, "by_chance_low": float(low), "by_chance_high": float(high)})
    ranks = np.array([case.ranks for case in cases])
    groups = [np.histogram(column, bins=GROUPS, range=(0, SAMPLES + 1))[0] for column in ranks.T]
    return {
        "cases": count,
        "coverage": coverage,
        "ranks": [
            {"unknown": name, "groups": group.tolist(), "p_value": float(chisquare(group).pvalue)}
            for name, group in zip(problem.names, groups)
        ],
    }
