"""What is known of an unknown before the data: four kinds of prior, each in a coordinate of its own.

The coordinate x is the value, or its logarithm, shifted and scaled: a uniform prior is flat on −1 … 1, a normal one has
mean 0 and variance 1 and is cut at ±REACH.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.stats import truncnorm

from comparisons.inference.study_keys import KINDS

#: Where a normal prior is cut, in its standard deviations: one in two thousand lies outside.
REACH = 3.5

class PriorError(ValueError):
    """A prior that cannot be; the message says what is allowed."""


@dataclass(frozen=True)
class Prior:
    """A prior. logarithmic: x is linear in log(value); gaussian: normal in x, else flat; lowest, highest: limits of x."""

    logarithmic: bool
    gaussian: bool
    centre: float
    scale: float
    lowest: float
    highest: float

    def value(self, x):
        """The value (same shape as x) of a coordinate."""
        inner = self.centre + self.scale * np.asarray(x)
        return np.exp(inner) if self.logarithmic else inner

    def coordinate(self, value):
        """The coordinate of a value."""
        inner = np.log(value) if self.logarithmic else np.asarray(value)
        return (inner - self.centre) / self.scale

    def log_density(self, x):
        """Logarithm of the density in x, but for a constant; −∞ outside the limits."""
        inside = (x >= self.lowest) & (x <= self.highest)
        return np.where(inside, -0.5 * np.square(x) if self.gaussian else 0.0, -np.inf)

    def from_fraction(self, fraction):
        """The coordinate below which a fraction (0 … 1, any shape) of the prior lies."""
        if self.gaussian:
            return truncnorm.ppf(fraction, self.lowest, self.highest)
        return self.lowest + (self.highest - self.lowest) * np.asarray(fraction)

    @property
    def deviation(self):
        """Standard deviation in x."""
        if self.gaussian:
            return float(truncnorm.std(self.lowest, self.highest))
        return (self.highest - self.lowest) / math.sqrt(12)


def prior_of(kind, numbers):
    """The Prior of a kind with its numbers {key: value}; a normal one may also have `low` and `high`.

    Raises PriorError.
    """
    if kind not in KINDS:
        raise PriorError(f"prior = {kind!r}: it is one of {', '.join(KINDS)}")
    missing = [key for key in KINDS[kind] if key not in numbers]
    if missing:
        raise PriorError(f"prior = {kind!r} needs {' and '.join(missing)}")
    others = [key for key in numbers if key not in (*KINDS[kind], "low", "high")]
    if others:
        key, own = others[0], ", ".join(KINDS[kind])
        raise PriorError(f"{key} = {numbers[key]:g}: prior = {kind!r} has no {key}; it has {own}")
    found = _prior(kind, numbers)
    if not np.isfinite([found.scale, *found.value(np.array([found.lowest, found.highest]))]).all():
        raise PriorError(f"prior = {kind!r} reaches beyond the largest number, 1.8e308; take narrower limits")
    return found


def _prior(kind, numbers):
    """The Prior of a kind whose keys are there."""
    logarithmic = kind.startswith("log")
    if kind.endswith("uniform"):
        low, high = (_inner(numbers[key], key, logarithmic) for key in ("low", "high"))
        if not low < high:
            raise PriorError(f"low = {numbers['low']:g} must be below high = {numbers['high']:g}")
        return Prior(logarithmic, False, 0.5 * (low + high), 0.5 * (high - low), -1.0, 1.0)
    centre_key, width_key = KINDS[kind]
    centre, width = _inner(numbers[centre_key], centre_key, logarithmic), numbers[width_key]
    if not width > (1 if logarithmic else 0):
        raise PriorError(f"{width_key} = {width:g}: must be greater than {1 if logarithmic else 0}")
    scale = math.log(width) if logarithmic else width
    limits = {"low": -REACH, "high": REACH}
    for key in limits.keys() & numbers.keys():
        limits[key] = (_inner(numbers[key], key, logarithmic) - centre) / scale
    if not limits["low"] < limits["high"] or limits["low"] >= REACH or limits["high"] <= -REACH:
        given = f"{centre_key} = {numbers[centre_key]:g} with {width_key} = {width:g}"
        raise PriorError(f"low and high leave nothing of the prior, {given}")
    return Prior(logarithmic, True, centre, scale, limits["low"], limits["high"])


def _inner(value, key, logarithmic):
    """The value or its logarithm."""
    if logarithmic and not value > 0:
        raise PriorError(f"{key} = {value:g}: a logarithmic prior needs a positive number")
    return math.log(value) if logarithmic else float(value)
