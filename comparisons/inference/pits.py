"""Pits that were each seen once, at times that nobody knows: how well the path of a course explains them.

A course gives a path in the space of what was measured of a pit; in units of the errors, which are independent and normal, the pit
is a point beside it.

- "any", nothing is known of the times: a pit's likelihood is that of the nearest point of the path, max over t of p(y|θ, t). This is
  orthogonal distance regression. It depends on the path alone, neither on the pace nor on how many pits are where. The errors are
  known, so that as many times as pits do no harm on a straight path (Neyman & Scott, Econometrica 16, 1 (1948), estimate the error);
  on one that bends, pits lie on the outside of the bend by half of the bend within an error, on average.
- "even", pits were seen at random moments: p(y|θ) = ∫ p(y|θ, t) dt/duration. How many pits are where tells of the pace, then.

The path is a polyline, on each piece of which the integral is one of a normal density over an interval.

Shapes: n courses, p pits, m pieces, k quantities, which stand first in the pieces' ends.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import log_ndtr, ndtr, ndtri

from comparisons.inference.course import FIRST_GRID, NO_NECK, SECOND_GRID, STAGE_POINTS

#: Of a stage's points every STRIDE-th one is a vertex of the path: 30 pieces for a stage.
STRIDE = 2
VERTICES = slice(0, STAGE_POINTS, STRIDE)

#: Pieces shorter than this, in errors, have the density of their middle.
SHORT = 1e-4

#: A piece farther from a pit than the nearest one, by this in squares of errors, adds e⁻²⁰ of it at most.
NEGLIGIBLE = 40.0

#: In place of a divisor 0.
TINY = 1e-300


@dataclass(frozen=True)
class Path:
    """Pieces of n paths: start, end (k, n, m) in the data's units; since, until (n, m): the times of both, µs. Those before a time are
    points that last no time."""

    start: np.ndarray
    end: np.ndarray
    since: np.ndarray
    until: np.ndarray

    @property
    def lasts(self):
        """Whether each piece (n, m) lasts some time."""
        return self.until > self.since


def path_of(batch, columns, since):
    """The Path of a course.Batch in some columns from a time (µs) on; None where the outcome has no such quantity."""
    stages = [(batch.first, 0 * batch.neck_time, batch.neck_time, FIRST_GRID)]
    if batch.outcome != NO_NECK:
        stages.append((batch.second, batch.neck_time, batch.end, SECOND_GRID))
    if any(column not in stage for stage, *_ in stages for column in columns):
        return None
    pieces = []
    for stage, begins, ends, grid in stages:
        values = np.stack([stage[column][:, VERTICES] for column in columns])
        times = begins[:, None] + (ends - begins)[:, None] * grid[VERTICES]
        pieces.append((values[..., :-1], values[..., 1:], times[:, :-1], times[:, 1:]))
    start, end, begin, finish = (np.concatenate(parts, axis=-1) for parts in zip(*pieces))
    part = np.clip((since - begin) / np.maximum(finish - begin, TINY), 0, 1)
    return Path(start + part * (end - start), end, np.minimum(begin + part * (finish - begin), finish), finish)


@dataclass(frozen=True)
class Beside:
    """Pits beside pieces, all in units of the pits' errors: at (n, p, m) is the place of a pit's foot along a piece, from its start,
    length (n, p, m) that of the piece, aside (n, p, m) the square of the distance from the piece's line."""

    at: np.ndarray
    length: np.ndarray
    aside: np.ndarray


def beside(path, values, errors):
    """The Beside of pits, values and errors (p, k), and a Path."""
    along = _along(path, errors)
    offset = (values.T[:, None, :, None] - path.start[:, :, None]) / errors.T[:, None, :, None]
    length = np.sqrt(np.sum(along**2, axis=0))
    at = np.sum(offset * along, axis=0) / np.maximum(length, TINY)
    return Beside(at, length, np.maximum(np.sum(offset**2, axis=0) - at**2, 0))


def _along(path, errors):
    """(k, n, p, m): the pieces in units of the pits' errors (p, k)."""
    return (path.end - path.start)[:, :, None] / errors.T[:, None, :, None]


def nearest(path, values, errors):
    """(n, p, k) in the data's units: the point of each path that is nearest to each pit; nan where a path lasts no time."""
    found = beside(path, values, errors)
    piece = np.argmin(_squares(path, found), axis=2)
    at, length = _taken(found.at, piece), _taken(found.length, piece)
    fraction = np.clip(at / np.maximum(length, TINY), 0, 1)
    points = _points(path, piece, fraction)
    points[~path.lasts.any(axis=1)] = np.nan
    return points


def log_likelihoods(path, values, errors, even):
    """(n, p): logarithm of each pit's likelihood, but for a constant that depends on its errors alone."""
    found = beside(path, values, errors)
    squares = _squares(path, found)
    least = np.min(squares, axis=2, keepdims=True)
    if not even:
        return -0.5 * least[..., 0]
    course, pit, piece = np.nonzero(squares <= least + NEGLIGIBLE)
    weights = np.full(squares.shape, -np.inf)
    weights[course, pit, piece] = _log_weights(path, found, even, (course, pit, piece))
    return _log_sum(weights)


def times(path, values, errors, even, fractions):
    """(n, p) in µs: a time of each pit below which a fraction (n, p), between 0 and 1, of what each path says of it lies: of the integral
    over times or, where nothing is known of them, over the path's length in errors."""
    found = beside(path, values, errors)
    weights = _log_weights(path, found, even, tuple(np.indices(found.at.shape)))
    below = np.cumsum(np.exp(weights - _log_sum(weights)[..., None]), axis=2)
    piece = np.minimum(np.sum(below < fractions[..., None], axis=2), below.shape[2] - 1)
    before = np.where(piece > 0, _taken(below, np.maximum(piece - 1, 0)), 0)
    inside = np.clip((fractions - before) / np.maximum(_taken(below, piece) - before, TINY), 0, 1)
    at, length = _taken(found.at, piece), _taken(found.length, piece)
    reached = np.clip(at + _normal_within(-at, length - at, inside), 0, length)
    part = np.where(length > SHORT, reached / np.maximum(length, TINY), inside)
    rows = np.arange(len(piece))[:, None]
    return path.since[rows, piece] + part * (path.until - path.since)[rows, piece]


def drawn(path, errors, even, generator):
    """(n, p, k) in the data's units: a point for each of p pits, drawn evenly along the path's length in errors or, if even, its times."""
    lengths = np.linalg.norm(_along(path, errors), axis=0)
    weight = np.broadcast_to((path.until - path.since)[:, None], lengths.shape) if even else lengths
    below = np.cumsum(np.where(path.lasts[:, None], weight, 0), axis=2)
    below /= np.maximum(below[..., -1:], TINY)
    piece = np.minimum(np.sum(below < generator.random(below.shape[:2])[..., None], axis=2), below.shape[2] - 1)
    return _points(path, piece, generator.random(piece.shape))


def _squares(path, found):
    """(n, p, m): squares of the pits' distances from the pieces, ∞ from those that last no time."""
    aside = found.aside + (found.at - np.clip(found.at, 0, found.length)) ** 2
    return np.where(path.lasts[:, None], aside, np.inf)


def _log_weights(path, found, even, chosen):
    """Logarithms of the integrals over the chosen pieces (course, pit, piece), arrays of one shape, over times if even, else over length."""
    at, length, aside = found.at[chosen], found.length[chosen], found.aside[chosen]
    short = length < SHORT
    inside = np.where(short, _log_middle(at, length), _log_interval(-at, np.where(short, 1, length) - at))
    course, _, piece = chosen
    with np.errstate(divide="ignore"):
        if even:
            lasting = path.until - path.since
            share = np.log(lasting / np.maximum(lasting.sum(axis=1, keepdims=True), TINY))
            density = share[course, piece] - np.log(np.maximum(length, TINY))
        else:
            density = np.where(path.lasts[course, piece], 0.0, -np.inf)
    return density + inside - 0.5 * aside


def _log_middle(at, length):
    """Logarithm of a short piece's length times the normal density of its middle."""
    return np.log(np.maximum(length, TINY)) - 0.5 * (at - 0.5 * length) ** 2 - 0.5 * np.log(2 * np.pi)


def _log_interval(low, high):
    """Logarithm of Φ(high) − Φ(low), low < high: both from the tail that is nearer, where neither is rounded to 1."""
    mirrored = low > 0
    low, high = np.where(mirrored, -high, low), np.where(mirrored, -low, high)
    upper = log_ndtr(high)
    return upper + np.log1p(-np.exp(log_ndtr(low) - upper))


def _normal_within(low, high, fraction):
    """Number below which a fraction of the normal density between low and high lies, from the tail that is nearer."""
    mirrored = low > 0
    low, high = np.where(mirrored, -high, low), np.where(mirrored, -low, high)
    below, above = ndtr(low), ndtr(high)
    found = ndtri(below + np.where(mirrored, 1 - fraction, fraction) * (above - below))
    return np.where(mirrored, -found, found)


def _log_sum(logarithms):
    """Logarithm (n, p) of the sum over pieces (n, p, m) of numbers with these logarithms; −∞ where all are."""
    largest = np.max(logarithms, axis=2, keepdims=True)
    shift = np.where(np.isfinite(largest), largest, 0)
    with np.errstate(divide="ignore"):
        return np.log(np.sum(np.exp(logarithms - shift), axis=2)) + shift[..., 0]


def _taken(values, piece):
    """Values (n, p, m) of the pieces (n, p)."""
    return np.take_along_axis(values, piece[..., None], axis=2)[..., 0]


def _points(path, piece, fraction):
    """(n, p, k): points at fractions (n, p) of pieces (n, p)."""
    rows = np.arange(len(piece))[:, None]
    start, end = path.start[:, rows, piece], path.end[:, rows, piece]
    return np.moveaxis(start + fraction * (end - start), 0, -1)
