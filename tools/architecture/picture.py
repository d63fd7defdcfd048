#!/usr/bin/env python3
"""The parts of the project, the folders inside and what uses what, as an SVG picture.

Drawn from the sources alone: a folder stands above all that it uses, a line leads to what it uses directly.
tests/architecture compares docs/images/architecture.svg with what this program draws.
"""

import argparse
import html
from pathlib import Path

import folders
import sources

#: Parts from left to right; colours of frame and ground.
PARTS = {
    "cli": ("#5a6675", "#f3f5f8"),
    "statics": ("#0072B2", "#e3f0f9"),
    "boundary_integral": ("#0072B2", "#e3f0f9"),
    "phasefield": ("#D55E00", "#fbe9dd"),
    "shared": ("#5a6675", "#f3f5f8"),
    "comparisons": ("#00805E", "#eaf5f1"),
    "python": ("#00805E", "#eaf5f1"),
}
PYTHON = ("comparisons", "python")

LETTER, LINE, PAD, GAP, ROW_GAP = 6.6, 15, 8, 12, 22  # pixels
TITLE = 26  # height of a part's name
PART_GAP = 40
FILES = "a run's directory: run.json, history.csv, shapes.h5, fields.pvd, checkpoint/, log.txt"


def use_graphs():
    """{folder: graph of what lies in it} of includes and imports together."""
    files = sources.tracked()
    uses = sources.includes(files)
    for name, targets in sources.imports(files).items():
        uses.setdefault(name, set()).update(targets)
    return uses, folders.levels(uses)


def inner_folders(uses, folder):
    """Names of the folders directly inside of a folder, "a/b/", that hold sources."""
    parts = {folders.part_of(name, folder) for name in uses if name.startswith(f"{folder}/")}
    return sorted(name for name in parts if name.endswith("/"))


def rows_of(names, graph):
    """Names in rows from top to bottom, each above all that it uses."""
    reach = {name: folders.reachable(graph, name) & set(names) for name in names}
    rows, left = [], set(names)
    while left:
        row = sorted(name for name in left if not reach[name] & left)
        if not row:
            raise SystemExit(f"{', '.join(sorted(left))} use each other: see tools/architecture/check.py")
        rows.insert(0, row)
        left -= set(row)
    return rows


def direct(names, graph):
    """Uses that no longer way explains: [(name, name it uses)]."""
    reach = {name: folders.reachable(graph, name) for name in names}
    pairs = [(name, target) for name in names for target in sorted(graph.get(name, ())) if target in names]
    return [
        (name, target)
        for name, target in pairs
        if not any(target in reach[other] for other in graph[name] if other in names and other != target)
    ]


class Box:
    """A rectangle with lines of text, the first one bold. left, top, width, height in pixels."""

    def __init__(self, lines):
        self.lines = lines
        self.width = max(len(line) for line in lines) * LETTER + 2 * PAD
        self.height = len(lines) * LINE + PAD
        self.left = self.top = 0

    def svg(self, frame):
        """The box as SVG."""
        middle = self.left + self.width / 2
        texts = "".join(
            f'<text x="{middle:.0f}" y="{self.top + LINE * (i + 1) - 1:.0f}"'
            f'{" font-size=" + chr(34) + "10" + chr(34) if i else ""}>{html.escape(line)}</text>'
            for i, line in enumerate(self.lines)
        )
        return (
            f'<rect x="{self.left:.0f}" y="{self.top:.0f}" width="{self.width:.0f}" height="{self.height:.0f}" rx="5" '
            f'fill="#ffffff" stroke="{frame}"/>{texts}'
        )


class Part:
    """A part of the project as a frame around its folders. left, top, width, height in pixels."""

    def __init__(self, name, uses, graphs):
        self.name, self.graph = name, graphs.get(name, {})
        names = inner_folders(uses, name)
        self.boxes = {inner: Box(self.lines(inner, uses)) for inner in names}
        self.rows = rows_of(names, self.graph)
        self.lines_between = direct(names, self.graph)
        widths = [sum(self.boxes[n].width for n in row) + GAP * (len(row) - 1) for row in self.rows]
        self.width = max([*widths, len(name) * LETTER * 1.2]) + 2 * PAD
        heights = [max(self.boxes[n].height for n in row) for row in self.rows]
        self.height = TITLE + sum(heights) + ROW_GAP * max(len(heights) - 1, 0) + (PAD if heights else 0)
        self.left = self.top = 0

    @staticmethod
    def lines(inner, uses):
        """What stands in a box: the folder's name and those of the folders inside of it."""
        deeper = [name.rstrip("/").split("/")[-1] for name in inner_folders(uses, inner.rstrip("/"))]
        return [inner.rstrip("/").split("/")[-1] + "/", *([" · ".join(deeper)] if deeper else [])]

    def place(self, left, top, height):
        """Put the frame, as high as those beside it, and the boxes to their places."""
        gap = ROW_GAP + (height - self.height) / max(len(self.rows) - 1, 1)
        self.left, self.top, self.height, y = left, top, height, top + TITLE
        for row in self.rows:
            x = left + (self.width - sum(self.boxes[n].width for n in row) - GAP * (len(row) - 1)) / 2
            for name in row:
                self.boxes[name].left, self.boxes[name].top = x, y
                x += self.boxes[name].width + GAP
            y += max(self.boxes[n].height for n in row) + gap

    def svg(self):
        """The part as SVG."""
        frame, ground = PARTS[self.name]
        pieces = [
            f'<rect x="{self.left:.0f}" y="{self.top:.0f}" width="{self.width:.0f}" height="{self.height:.0f}" rx="8" '
            f'fill="{ground}" stroke="{frame}"/>',
            f'<text x="{self.left + self.width / 2:.0f}" y="{self.top + 18:.0f}" font-weight="bold">{self.name}/</text>',
        ]
        pieces += [line(self.boxes[a], self.boxes[b], frame) for a, b in self.lines_between]
        return "\n".join(pieces + [box.svg(frame) for box in self.boxes.values()])


def line(upper, lower, colour, width=1):
    """A line from the bottom of one thing to the top of another."""
    x, y = upper.left + upper.width / 2, upper.top + upper.height
    to_x, to_y = lower.left + lower.width / 2, lower.top
    bend = (to_y - y) / 2
    path = f"M{x:.0f} {y:.0f}C{x:.0f} {y + bend:.0f} {to_x:.0f} {to_y - bend:.0f} {to_x:.0f} {to_y:.0f}"
    return f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width}"/>'


def arrange(parts, graph, left, top):
    """Place parts in rows below each other, those of a row equally high; returns width and height."""
    rows = rows_of([f"{name}/" for name in parts], graph)
    rows = [[parts[name] for name in PARTS if f"{name}/" in row] for row in rows]
    width = max(sum(p.width for p in row) + PART_GAP * (len(row) - 1) for row in rows)
    y = top
    for row in rows:
        x = left + (width - sum(p.width for p in row) - PART_GAP * (len(row) - 1)) / 2
        height = max(part.height for part in row)
        for part in row:
            part.place(x, y, height)
            x += part.width + PART_GAP
        y += height + PART_GAP
    return width, y - PART_GAP - top


def picture():
    """The picture as text."""
    uses, graphs = use_graphs()
    parts = {name: Part(name, uses, graphs) for name in PARTS}
    compiled = {name: part for name, part in parts.items() if name not in PYTHON}
    width, height = arrange(compiled, graphs[""], 20, 20)
    right = width + 20 + PART_GAP
    python_width, python_height = arrange({name: parts[name] for name in PYTHON}, graphs[""], right, 20)
    total, bottom = right + python_width + 20, max(height, python_height) + 20 + PART_GAP
    between = direct([f"{name}/" for name in PARTS], graphs[""])
    between_lines = [line(parts[a.rstrip("/")], parts[b.rstrip("/")], "#5a6675", 1.8) for a, b in between]
    strip = (
        f'<rect x="20" y="{bottom:.0f}" width="{total - 40:.0f}" height="34" rx="8" fill="#fff6dd" stroke="#c29a2e"/>'
        f'<text x="{total / 2:.0f}" y="{bottom + 21:.0f}">{html.escape(FILES)}</text>'
    )
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total:.0f} {bottom + 54:.0f}" text-anchor="middle" '
        'font-family="DejaVu Sans, sans-serif" font-size="12" fill="#1b222c">\n'
        "<title>Parts of the project, their folders, and what uses what</title>\n"
        f'<rect width="{total:.0f}" height="{bottom + 54:.0f}" fill="#ffffff"/>'
    )
    return "\n".join([head, *between_lines, *(part.svg() for part in parts.values()), strip, "</svg>"]) + "\n"


def main(arguments=None):
    """Draw to the file named on the command line."""
    parser = argparse.ArgumentParser(prog="tools/architecture/picture.py", description=__doc__.splitlines()[0])
    default = sources.ROOT / "docs" / "images" / "architecture.svg"
    parser.add_argument("file", nargs="?", type=Path, default=default, help="docs/images/architecture.svg if not given")
    parser.parse_args(arguments).file.write_text(picture(), encoding="utf-8")


if __name__ == "__main__":
    main()
