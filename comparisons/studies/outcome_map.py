"""Where outcomes change in a plane of two parameters: cells of a grid are halved only where their corners differ.

Points are pairs of integers on the finest grid, 0 … extent of both axes.
"""

import math
from dataclasses import dataclass

#: Outcomes in their order along a budding.
OUTCOMES = ("flat", "dome", "neck", "bud", "closed", "failed")

#: Height over patch radius from which on a membrane without a neck is a dome: that of a spherical cap whose edge is steeper
#: than 45°. Caps of the area π r_c² whose edge has the slope θ are r_c sin(θ/2) high.
DOME_HEIGHT = math.sin(math.radians(45) / 2)


@dataclass(frozen=True)
class Cell:
    """A square with a corner at (x, y) and edges of `size`."""

    x: int
    y: int
    size: int

    @property
    def corners(self):
        """The four corners, anticlockwise from (x, y)."""
        x, y, size = self.x, self.y, self.size
        return [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]

    def halves(self):
        """Four cells of half the size."""
        half = self.size // 2
        return [Cell(self.x + i * half, self.y + j * half, half) for j in (0, 1) for i in (0, 1)]


def traced(cells, levels, outcomes):
    """({point: outcome}, [Cell] of the last level) of a first grid of cells × cells, halved `levels` times along boundaries.

    outcomes(points): {point: outcome} of some points; called once for each level, with points not asked for before. Neighbours
    of a cell that is halved are halved, too: a boundary that bends through their edge is not lost.
    """
    size = 2**levels
    current = [Cell(i * size, j * size, size) for j in range(cells) for i in range(cells)]
    known = outcomes(sorted({corner for cell in current for corner in cell.corners}))
    for _ in range(levels):
        split = {cell for cell in current if differs(cell, known)}
        beside = {cell for cell in current if any(adjacent(cell, other) for other in split)}
        current = [half for cell in current if cell in split or cell in beside for half in cell.halves()]
        missing = {corner for cell in current for corner in cell.corners} - known.keys()
        known |= outcomes(sorted(missing))
    return known, [cell for cell in current if differs(cell, known)]


def differs(cell, known):
    """Whether the corners of a cell have more than one outcome."""
    return len({known[corner] for corner in cell.corners}) > 1


def adjacent(cell, other):
    """Whether two cells of one size share an edge."""
    return abs(cell.x - other.x) + abs(cell.y - other.y) == cell.size


def boundaries(cells, known):
    """{(outcome, outcome): [(x, y)]}: middles of the edges of cells whose ends have these two outcomes, in OUTCOMES' order."""
    found = {}
    for cell in cells:
        corners = cell.corners
        for a, b in zip(corners, corners[1:] + corners[:1]):
            if known[a] != known[b]:
                pair = tuple(sorted((known[a], known[b]), key=OUTCOMES.index))
                found.setdefault(pair, set()).add((0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])))
    return {pair: sorted(points) for pair, points in found.items()}


def outcome_of(record, neck, height):
    """The outcome of a run from its run.json (a dict, or None without a run), last neck radius and height (nm or None)."""
    if record is None or record.get("state") == "failed":
        return "failed"
    if "neck_closed" in record.get("events", {}):
        return "closed"
    if "budding" in record.get("events", {}):
        return "bud"
    if neck is not None:
        return "neck"
    return "dome" if abs(height or 0) > DOME_HEIGHT * record["parameters"]["molecules"]["patch_radius"] else "flat"
