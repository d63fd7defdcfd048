"""How much of the meridian plane pictures show."""


def half_width(shapes):
    """How far from the axis pictures of some shapes go, nm: to the rim, or somewhat beyond a closed membrane."""
    return max(1.15 * shape.r.max() if shape.closed else shape.r[-1] for shape in shapes)
