"""Distances between two membrane curves in the (r, z) half-plane, in nm, and what interpolation in time adds to them."""

from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
from scipy.integrate import trapezoid
from scipy.spatial import cKDTree

from endoflow.curves import resample
from endoflow.shapes import between

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


class InterpolationError:
    """Estimates for an endoflow.Run; at(time) gives the Hausdorff distance in nm.

    Linear interpolation between times t₁ and t₂ errs by (t − t₁)(t₂ − t) |ẍ|/2. Leaving out an inner shape and
    interpolating it between its neighbours gives |ẍ|/2 there; the larger one of both ends of an interval counts.
    """

    def __init__(self, run):
        self.run, self.times, self.known = run, [float(time) for time in run.shape_times], {}

    def written_at(self, time):
        """Whether the run wrote a shape at a time (µs), to round-off."""
        after = bisect_right(self.times, time)
        return any(abs(time - own) <= 1e-9 * max(1.0, abs(own)) for own in self.times[max(0, after - 1) : after + 1])

    def at(self, time):
        """The estimate at a time (µs) that the shapes cover: 0 at an output time, None for fewer than three shapes."""
        if self.written_at(time):
            return 0.0
        if len(self.times) < 3:
            return None
        after = bisect_right(self.times, time)
        span = (time - self.times[after - 1]) * (self.times[after] - time)
        return span * max(self._half_acceleration(index) for index in (after - 1, after))

    def _half_acceleration(self, index):
        """|ẍ|/2 in nm/µs² at a shape; the outermost shapes take their neighbour's."""
        index = min(max(index, 1), len(self.times) - 2)
        if index not in self.known:
            before, own, after = self.run.shapes[index - 1 : index + 2]
            left_out = between(before, after, own.time)
            distance = curve_distance((own.r, own.z), (left_out.r, left_out.z)).hausdorff
            self.known[index] = distance / ((own.time - before.time) * (after.time - own.time))
        return self.known[index]
