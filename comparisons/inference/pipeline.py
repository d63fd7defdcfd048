"""From a problem to its posterior: a first look over the priors, the best fit, an emulator around it, samples, and a check of
the emulator against runs at samples."""

from dataclasses import dataclass, replace

import numpy as np

from comparisons.inference.best_fit import Fit, best_fit, prior_precision
from comparisons.inference.course import batch_of
from comparisons.inference.emulator import (
    Trained,
    design,
    global_runs,
    local_runs,
    points_in,
    region_of,
    slopes,
    train,
    whole_region,
)
from comparisons.inference.sampling import Density, Posterior, sample

#: Runs of the first look.
LEAST_STARTS, STARTS_PER_UNKNOWN = 8, 4

#: Runs at samples of the posterior that check the emulator, and the largest error (root mean square, in errors of the data).
CHECKS, ACCURATE = 8, 0.3

#: Where more samples than this crowd at the region's edge, it grows by GROWTH; at most ROUNDS attempts in all.
CROWD, EDGE, GROWTH, ROUNDS = 0.01, 0.97, 1.6, 4

#: More runs for each attempt that was not accurate, as a part of a region's runs.
REFINEMENT = 0.7


@dataclass(frozen=True)
class Check:
    """size: root mean square and worst: largest difference between emulator and engine at samples, in errors of the data;
    unlike: runs that failed or ended unlike the fit, of `runs`."""

    size: float
    worst: float
    unlike: int
    runs: int

    @property
    def accurate(self):
        """Whether the posterior is that of the engine, for all that the data can tell."""
        return self.size <= ACCURATE and self.unlike == 0


@dataclass(frozen=True)
class Inference:
    """fit, trained emulator, posterior, check; crowded: the fraction of samples at the edge of the emulator's region."""

    fit: Fit
    trained: Trained
    posterior: Posterior
    check: Check
    crowded: float


def first_points(problem, seed):
    """Engine coordinates (n, engine_count) of the first look."""
    count = problem.engine_count
    return problem.points(design(count, max(LEAST_STARTS, STARTS_PER_UNKNOWN * count), seed))


def infer(problem, simulator, say):
    """The Inference of a Problem with a simulator.Simulator; say(text) is told each stage."""
    seed, count = problem.study.seed, problem.engine_count
    starts = first_points(problem, seed)
    say(f"first look: {len(starts)} run(s) over the priors")
    fit = best_fit(problem, simulator, starts)
    say(f"best fit: χ² = {fit.chi_square:.4g} for {len(problem.data)} data, {fit.evaluations} evaluations")
    growth, runs = 1.0, local_runs(count)
    for attempt in range(ROUNDS):
        region = region_of(problem, fit, growth)
        points = points_in(region, runs, seed + 1)
        say(f"emulator: {len(points)} run(s) around the fit")
        simulator.courses(points)
        trained = train(problem, *simulator.pool(), region, fit.course.outcome)
        posterior = sample(Density(problem, trained), fit.x, fit.covariance, seed)
        crowded = float(np.mean(np.any(np.abs(region.local(posterior.x[:, :count])) > EDGE, axis=1))) if count else 0.0
        last = attempt == ROUNDS - 1
        if crowded > CROWD and not last:
            growth, runs = GROWTH * growth, int((1 + REFINEMENT / 2) * runs)
            say(f"{100 * crowded:.0f} % of the samples crowd at the edge of the emulator's region: it grows")
            continue
        say(f"check: {CHECKS} run(s) at samples of the posterior")
        check = checked(problem, simulator, trained, posterior)
        say(f"emulator against engine: {check.size:.2g} of the data's errors")
        if check.accurate or last or not count:
            return Inference(sharpened(problem, fit, trained), trained, posterior, check, crowded)
        runs = int((1 + REFINEMENT) * runs)
    raise AssertionError("unreachable: the last attempt returns")


def sharpened(problem, fit, trained):
    """The Fit with the sensitivities of the emulator, which are free of the runs' differences' error."""
    jacobian = slopes(problem, trained, fit.x)
    return replace(fit, jacobian=jacobian, precision=jacobian.T @ jacobian + prior_precision(problem))


def checked(problem, simulator, trained, posterior):
    """The Check of an emulator at evenly chosen samples."""
    chosen = posterior.x[np.linspace(0, len(posterior.x) - 1, CHECKS).astype(int)]
    points = chosen[:, : problem.engine_count]
    courses = simulator.courses(points)
    alike = [i for i, c in enumerate(courses) if c is not None and c.outcome == trained.outputs.outcome]
    if not alike:
        return Check(float("inf"), float("inf"), CHECKS, CHECKS)
    exact = problem.predictions(batch_of([courses[i] for i in alike]), chosen[alike])
    guess = problem.predictions(trained.batch(points[alike]), chosen[alike])
    misses = np.nan_to_num((guess - exact) / problem.errors)
    return Check(float(np.sqrt(np.mean(misses**2))), float(np.abs(misses).max()), CHECKS - len(alike), CHECKS)


def over_priors(problem, simulator, say):
    """The Trained over all that the priors allow, for calibration and sensitivity."""
    region = whole_region(problem)
    points = points_in(region, global_runs(problem.engine_count), problem.study.seed + 2)
    say(f"emulator over the priors: {len(points)} run(s)")
    simulator.courses(points)
    return train(problem, *simulator.pool(), region)
