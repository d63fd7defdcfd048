#!/usr/bin/env python3
"""tools/architecture/check.py: what the layout of the project promises. Exit code 1 with one line for each promise broken.

 * No folder includes or imports another that leads back to it, at any depth; no header includes another that leads back to it.
 * No source file has more than 400 lines.
 * Every page of docs/ opens with what its reader will know at the end.
"""

import re
import sys

import folders
import sources

MOST_LINES = 400

#: The first paragraph of a page.
OPENING = re.compile(r"\A# [^\n]+\n\nAfter this page you (?:know|can) ")


def circles(graph, verb):
    """One line for each circle between folders of a graph of files."""
    broken = []
    for folder, graph_here in sorted(folders.levels(graph).items()):
        for circle in folders.circles(graph_here):
            uses = folders.between(graph, folder, circle)
            first = {}
            for user, used in uses:
                pair = folders.part_of(user, folder), folders.part_of(used, folder)
                first.setdefault(pair, f"{user} {verb} {used}")
            broken.append(f"{', '.join(circle)} use each other:\n    " + "\n    ".join(first.values()))
    return broken


def file_circles(graph):
    """One line for each circle of includes between files, wherever they lie."""
    return [f"{', '.join(circle)} include each other" for circle in folders.file_circles(graph)]


def long_files(files, root):
    """One line for each source file that is too long."""
    lengths = {name: len((root / name).read_text("utf-8").splitlines()) for name in sources.source_files(files)}
    return [f"{name} has {count} lines, more than {MOST_LINES}" for name, count in lengths.items() if count > MOST_LINES]


def unopened_pages(files, root):
    """One line for each page that does not say first what it is good for."""
    pages = [name for name in files if name.startswith("docs/") and name.endswith(".md")]
    return [
        f'{name} does not open with "After this page you know …"'
        for name in pages
        if not OPENING.match((root / name).read_text("utf-8"))
    ]


def problems(root=sources.ROOT):
    """All that is wrong with the project in root (Path), one text each."""
    files = sources.tracked(root)
    included = sources.includes(files, root)
    uses = circles(included, "includes") + file_circles(included) + circles(sources.imports(files, root), "imports")
    return uses + long_files(files, root) + unopened_pages(files, root)


def main():
    """Check this project; returns the exit code."""
    try:
        broken = problems()
    except sources.MissingFileError as error:
        broken = [str(error)]
    print("\n".join(broken), file=sys.stderr, end="\n" if broken else "")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
