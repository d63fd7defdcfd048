"""Distances between two membrane curves in the (r, z) half-plane, in nm."""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import trapezoid
from scipy.spatial import cKDTree

from endoflow.curves import resample

#: Spacing (nm) of the sample points: a curve of radius 5 nm lies within spacing²/(8·5 nm) = 6e-5 nm of the chords.
SPACING = 0.05

#: Nearest vertices whose two adjacent segments are searched for the nearest segment.
NEIGHBOURS = 4


@dataclass(frozen=True)
class CurveDistance:
    """mean: half the sum of both arc-length averaged distances to the other curve; hausdorff: the largest distance. nm."""

    mean: float
    hausdorff: float


def curve_distance(first, second):
    """Symmetric distances between two curves, each a pair of arrays (r, z) of any length, in nm, as a CurveDistance."""
    p, q = (np.column_stack(resample(*curve, SPACING)) for curve in (first, second))
    to_second, to_first = distance_to_polyline(p, q), distance_to_polyline(q, p)
    mean = 0.5 * (_average_along(to_second) + _average_along(to_first))
    return CurveDistance(mean=float(mean), hausdorff=float(max(to_second.max(), to_first.max())))


def distance_to_polyline(points, vertices):
    """Distance (m,) of each point (m, 2) to the segments of the polyline through vertices (n, 2), n >= 2.

    Searches the segments next to the nearest vertices, which is exact when the vertices are dense and evenly spaced.
    """
    return np.abs(_signed(points, vertices))


def signed_distances(r, z, curve_r, curve_z):
    """Distances (m,) in nm of points r, z (m,) from a curve (n,); positive on the left when it is followed axis to rim."""
    vertices = np.column_stack(resample(curve_r, curve_z, SPACING))
    return _signed(np.column_stack((r, z)), vertices)


def _signed(points, vertices):
    """distance_to_polyline with the sign of the side: positive on the left of the vertices' order."""
    neighbours = min(NEIGHBOURS, len(vertices))
    _, nearest = cKDTree(vertices).query(points, k=neighbours)
    nearest = nearest.reshape(len(points), neighbours)
    last = len(vertices) - 2
    segment = np.clip(np.concatenate((nearest - 1, nearest), axis=1), 0, last)
    start, along = vertices[segment], vertices[segment + 1] - vertices[segment]
    offset = points[:, None, :] - start
    foot = np.clip(np.sum(offset * along, axis=2) / np.sum(along**2, axis=2), 0.0, 1.0)
    squares = np.sum((offset - foot[..., None] * along) ** 2, axis=2)
    best = np.argmin(squares, axis=1)
    rows = np.arange(len(points))
    along, offset = along[rows, best], offset[rows, best]
    left = along[:, 0] * offset[:, 1] - along[:, 1] * offset[:, 0] >= 0
    return np.where(left, 1.0, -1.0) * np.sqrt(squares[rows, best])


def _average_along(values):
    """Mean over arc length of values (n,) at evenly spaced points (trapezoidal rule)."""
    return trapezoid(values) / (len(values) - 1)
