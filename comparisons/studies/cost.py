"""What a run is expected to cost, from runs that were measured; a rough number that the present machine's speed then corrects.

Seconds of CPU time on a core of 2024. Sharp engine: 11 s to 20 µs (docs/results/sharp-refinement.md). Scheme production: 430 s to 1.2 µs,
and as ε^-1.55 (docs/results/standard-case.md). Scheme paper: by steps and unknowns (docs/results/paper.md).
"""

import math

#: Seconds to REFERENCE_TIME (µs), and the power of the time they grow with: steps are short at first.
SHARP, PRODUCTION, REFERENCE_TIME = (11.0, 0.54), (1100.0, 0.35), 20.0

#: Scheme production: layer (nm) of the measured run, and the power of ε.
LAYER, LAYER_POWER = 1.2, -1.55

#: Scheme paper: seconds per step and thousand unknowns, and their power.
PER_STEP, UNKNOWNS_POWER = 0.010, 1.15

#: Unknowns of scheme paper in a layer (nodes of u, λ, φ, g, f of a cell of size h) along a membrane of about this length (nm).
MEMBRANE = 110.0


def expected_seconds(member, time):
    """Seconds that a member (members.Member) takes to a simulated time (µs)."""
    if member.engine == "boundary-integral":
        seconds, power = SHARP
        return seconds * (time / REFERENCE_TIME) ** power
    numerics = member.parameters.get("phase_field", {})
    if numerics.get("scheme") == "paper":
        own = numerics.get("paper", {})
        return steps(member.parameters.get("time", {}), own, time) * seconds_per_step(numerics)
    seconds, power = PRODUCTION
    thinner = (numerics.get("epsilon", LAYER) / LAYER) ** LAYER_POWER
    return seconds * thinner * (time / REFERENCE_TIME) ** power


def steps(times, paper, end):
    """Steps of scheme paper's ramp from 0 to `end` (µs): they double every ramp_steps up to max_step."""
    step = times.get("initial_step") or 1e-5
    longest, each = paper.get("max_step", 2e-3), paper.get("ramp_steps", 10)
    taken, time = 0.0, 0.0
    while step < longest and time + each * step < end:
        taken, time, step = taken + each, time + each * step, 2 * step
    return taken + max(0.0, end - time) / min(step, longest)


def seconds_per_step(numerics):
    """Seconds of a step of scheme paper."""
    epsilon = numerics.get("epsilon", LAYER)
    h = numerics.get("cell_size") or 1.04 * epsilon
    cells = MEMBRANE * 2 * (numerics.get("band_width") or 4.5) * epsilon / h**2
    nodes = numerics.get("degree", 3) ** 2 * 6.3
    return PER_STEP * (1e-3 * cells * nodes) ** UNKNOWNS_POWER


def remaining_seconds(running, waiting, ended):
    """Seconds of work left; None while nothing is known of this machine's speed.

    running: [(elapsed s, expected s of what it has done, expected s of what is left)], waiting: [expected s],
    ended: [(elapsed s, expected s)].
    """
    known = [(elapsed, done) for elapsed, done, left in running if done > 1e-3 * (done + left)] + list(ended)
    spent, expected = (sum(one) for one in zip(*known)) if known else (0.0, 0.0)
    if not math.isfinite(expected) or expected <= 0:
        return None
    return spent / expected * (sum(left for _, _, left in running) + sum(waiting))
