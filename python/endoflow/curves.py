"""Geometry of axisymmetric curves r(i), z(i), ordered from the axis to the rim. All lengths in nm."""

from __future__ import annotations

import numpy as np

from .arrays import Array


def arc_length(r: Array, z: Array) -> Array:
    """Chord length (n,) in nm from the first point to each point of the polyline r, z (n,)."""
    return np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(r), np.diff(z)))))


def area_from_axis(r: Array, z: Array) -> Array:
    """Area (n,) in nm² of the surface of revolution between the first point and each point of r, z (n,).

    Exact for the polyline: each chord sweeps a conical frustum.
    """
    frusta = np.pi * (r[1:] + r[:-1]) * np.hypot(np.diff(r), np.diff(z))
    return np.concatenate(([0.0], np.cumsum(frusta)))


def equivalent_radius(r: Array, z: Array) -> Array:
    """Radius (n,) in nm of the flat disc having the same area as the membrane between axis and each point.

    On an inextensible membrane this labels material points; on a flat one it equals r.
    """
    return np.sqrt(area_from_axis(r, z) / np.pi)


def closed_label(r: Array, z: Array) -> Array:
    """Label (n,) of the points of a closed curve by the area fraction f above them: arcsin √f, from 0 to π/2.

    Unlike f, it grows in proportion to the distance from either pole.
    """
    area = area_from_axis(r, z)
    return np.arcsin(np.sqrt(area / area[-1]))


def local_cubic(x: Array, y: Array, x_new: Array) -> Array:
    """Interpolate y (n,) given at increasing x (n,) at x_new (m,) with a C¹ piecewise cubic; returns (m,).

    The slopes are those of the parabola through three neighbours, so the error is O(h³) and no knot is influenced by more than
    its direct neighbours. Falls back to straight lines for fewer than three points.
    """
    if len(x) < 3:
        return np.interp(x_new, x, y)
    h = np.diff(x)
    secant = np.diff(y) / h
    slope = np.empty_like(y)
    slope[1:-1] = (h[1:] * secant[:-1] + h[:-1] * secant[1:]) / (h[1:] + h[:-1])
    slope[0] = 2 * secant[0] - slope[1]
    slope[-1] = 2 * secant[-1] - slope[-2]
    return hermite(x, y, slope, x_new)


def hermite(x: Array, y: Array, slope: Array, x_new: Array) -> Array:
    """The piecewise cubic with values y and slopes (n,) at x (n,), which may repeat; returns it at x_new (m,), held at its ends."""
    i = np.clip(np.searchsorted(x, x_new, side="right") - 1, 0, len(x) - 2)
    h, rise = x[i + 1] - x[i], y[i + 1] - y[i]
    t = np.clip((x_new - x[i]) / np.where(h > 0, h, 1.0), 0.0, 1.0)
    return y[i] + rise * t**2 * (3 - 2 * t) + h * t * (1 - t) * (slope[i] * (1 - t) - slope[i + 1] * t)


def resample(r: Array, z: Array, spacing: float, *others: Array) -> tuple[Array, ...]:
    """Resample a curve at equal arc length steps of at most `spacing` nm.

    r, z and every array of `others` have shape (n,). Positions are interpolated by a local cubic in chord length,
    the other quantities linearly. Returns the arrays (m,) in the same order; both end points are kept exactly.
    """
    length = arc_length(r, z)
    keep = np.append(True, np.diff(length) > 0)
    length, r, z = length[keep], np.asarray(r)[keep], np.asarray(z)[keep]
    count = max(2, int(np.ceil(length[-1] / spacing)) + 1)
    at = np.linspace(0.0, length[-1], count)
    smooth = [local_cubic(length, values, at) for values in (r, z)]
    return (*smooth, *(np.interp(at, length, np.asarray(values)[keep]) for values in others))
