"""A coat as microscopy describes it: its closing angle, area and mean curvature, read off a shape."""

import numpy as np

from comparisons.measures.quantities import columns
from endoflow.curves import area_from_axis

#: {column: Quantity} of what coat_of() says.
COAT = columns("of_coat")


def coat_of(shape):
    """{column: number} of a Shape's coat, columns and meanings as in COAT; None of a shape without a coat's edge."""
    angle = _closing_angle(shape)
    return None if angle is None else dict(zip(COAT, (angle, *_area_and_curvature(shape))))


def _closing_angle(shape):
    """Angle (degrees) of the membrane to the horizontal where c falls below ½, followed from the axis; None where it does not."""
    inside = shape.c >= 0.5
    if not inside[0] or inside.all():
        return None
    last = int(np.argmin(inside)) - 1
    part = (shape.c[last] - 0.5) / (shape.c[last] - shape.c[last + 1])
    slope = np.unwrap(np.arctan2(-np.gradient(shape.z), np.gradient(shape.r)))
    return float(np.degrees(slope[last] + part * (slope[last + 1] - slope[last])))


def _area_and_curvature(shape):
    """(area in nm², mean curvature in 1/nm)."""
    pieces = np.diff(area_from_axis(shape.r, shape.z))

    def over_membrane(values):
        return float(np.sum(0.5 * (values[1:] + values[:-1]) * pieces))

    covered = over_membrane(shape.c)
    return covered, 0.5 * over_membrane(shape.kappa * shape.c) / covered
