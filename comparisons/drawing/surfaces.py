"""Surfaces of revolution as points and quads."""

import numpy as np

#: Angle (degrees) between two meridians.
ANGLE_STEP = 5.0


class Revolved:
    """A curve r, z (n,) revolved about z by `angle` degrees. A full turn shares its first meridian.

    points: (m n, 3), meridian by meridian; quads: (k, 4) of their indices; azimuth: (m n,) in radians.
    """

    def __init__(self, r, z, angle=360):
        closed = angle == 360
        self._meridians = max(3, round(angle / ANGLE_STEP)) + (not closed)
        self.azimuth = np.repeat(np.radians(np.linspace(0, angle, self._meridians, endpoint=not closed)), len(r))
        self.points = self.vectors(r, z)
        first = np.arange(self._meridians if closed else self._meridians - 1)[:, None] * len(r) + np.arange(len(r) - 1)
        after = (first + len(r)) % (self._meridians * len(r))
        self.quads = np.stack((first, first + 1, after + 1, after), axis=-1).reshape(-1, 4)

    def around(self, values):
        """Values (n,) of the curve at all points (m n,)."""
        return np.tile(values, self._meridians)

    def vectors(self, radial, axial):
        """Vectors (m n, 3) from components (n,) in the plane of the meridian."""
        outward = np.column_stack((np.cos(self.azimuth), np.sin(self.azimuth)))
        return np.column_stack((outward * self.around(radial)[:, None], self.around(axial)))
