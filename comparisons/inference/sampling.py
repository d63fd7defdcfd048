"""The posterior on an emulator, by the affine-invariant ensemble sampler of emcee (Goodman & Weare 2010)."""

from dataclasses import dataclass

import emcee
import numpy as np

from comparisons.errors import RUN_FAILED, StudyError

#: Steps between two looks at the autocorrelation, most steps, and the steps of an autocorrelation time that end a chain.
BLOCK = 500
MOST_STEPS = 20000
LENGTH = 50

#: Smallest part of the covariance's spread around the start that walkers get.
LEAST_SPREAD = 1e-9

#: Walkers for each unknown, and at least.
WALKERS_PER_UNKNOWN, LEAST_WALKERS = 6, 24


@dataclass(frozen=True)
class Posterior:
    """x (samples, unknowns): coordinates; log_density (samples,); autocorrelation: the longest, in steps; effective: number of
    independent samples; acceptance: fraction; converged: whether the chain is LENGTH autocorrelation times long."""

    x: np.ndarray
    log_density: np.ndarray
    autocorrelation: float
    effective: float
    acceptance: float
    converged: bool


class Density:
    """Logarithm of the posterior (n,) at coordinates (n, unknowns), but for a constant, on a training.Trained.

    values (data,): instead of the measured ones. Data that no run of the emulator's outcome has say nothing.
    """

    def __init__(self, problem, trained, values=None):
        self.problem, self.trained = problem, trained
        self.values = problem.values if values is None else values
        self.errors = np.hypot(problem.errors, trained.errors)
        self.known = problem.known(trained.batch(trained.emulator.region.centre[None, :])) & np.isfinite(self.values)

    def __call__(self, x):
        count = self.problem.engine_count
        found = self.problem.log_prior(x)
        inside = np.isfinite(found) & self.trained.emulator.region.holds(x[:, :count])
        found = np.where(inside, found, -np.inf)
        if inside.any():
            batch = self.trained.batch(x[inside, :count])
            predicted = self.problem.timed_predictions(batch, x[inside])
            misses = ((predicted - self.values) / self.errors)[:, self.known & ~self.problem.of_pits]
            found[inside] -= 0.5 * np.sum(misses**2, axis=1)
            found[inside] += np.sum(self.problem.log_likelihoods(batch, self.values, self.errors), axis=1)
        return np.where(np.isnan(found), -np.inf, found)


def sample(density, start, covariance, seed, most_steps=MOST_STEPS):
    """The Posterior of a Density, walkers starting around `start` (unknowns,) with half the spread of a covariance."""
    sampler, state = ensemble(density, start, covariance, seed, max(LEAST_WALKERS, WALKERS_PER_UNKNOWN * len(start)))
    longest, converged = np.inf, False
    while sampler.iteration < most_steps and not converged:
        state = sampler.run_mcmc(state, BLOCK, skip_initial_state_check=True)
        longest = float(np.max(sampler.get_autocorr_time(tol=0)))
        converged = np.isfinite(longest) and sampler.iteration >= LENGTH * longest + BLOCK
    discarded = min(int(5 * longest) if np.isfinite(longest) else BLOCK, sampler.iteration // 2)
    thinned = max(1, int(longest / 2)) if np.isfinite(longest) else 1
    used = (sampler.iteration - discarded) * sampler.nwalkers
    return Posterior(
        sampler.get_chain(discard=discarded, thin=thinned, flat=True),
        sampler.get_log_prob(discard=discarded, thin=thinned, flat=True),
        longest,
        used / longest,
        float(np.mean(sampler.acceptance_fraction)),
        bool(converged),
    )


def ensemble(density, start, covariance, seed, walkers):
    """(emcee's sampler of a Density, its first state) with an even number of walkers."""
    generator = np.random.RandomState(seed)
    first = first_walkers(density, start, covariance, generator, walkers + walkers % 2)
    sampler = emcee.EnsembleSampler(len(first), len(start), density, vectorize=True)
    return sampler, emcee.State(first, random_state=generator.get_state())


def first_walkers(density, start, covariance, generator, count):
    """Walkers (count, unknowns) with a finite density around a point. Raises StudyError where there are none."""
    part, root = 1.0, 0.5 * np.linalg.cholesky(covariance + 1e-12 * np.eye(len(start)))
    found = []
    while len(found) < count:
        if part < LEAST_SPREAD:
            what = "the data leave no probability around the best fit"
            raise StudyError(f"{what}; check their numbers, units and errors", RUN_FAILED)
        points = start + generator.standard_normal((count, len(start))) @ (part * root).T
        found.extend(points[np.isfinite(density(points))])
        part *= 0.9
    return np.array(found[:count])


def highest_density_level(log_density, fraction):
    """Log density that bounds the smallest region with this fraction of the posterior, from that of samples (n,)."""
    return float(np.quantile(log_density, 1 - fraction))
