"""Carries out the recipe "An unknown of the scheme production" of docs/extending.md on a copy of the scheme's sources.

    python3 add_unknown.py PROJECT DIRECTORY     # writes DIRECTORY/phasefield/schemes/production

The unknown is the molecules' squared density, w = c² as an equation of its own; added_unknown_test.cpp solves for it.
"""

import shutil
import sys
from pathlib import Path

FOLDER = Path("phasefield/schemes/production")

#: {file: (text that stands in it once, what takes its place)}: all that the recipe touches.
EDITS = {
    "fields.h": [
        ("membrane_stretch,    // s\n", "membrane_stretch,    // s\n    squared_density,     // w = c²\n"),
        ("n_fields = 11;", "n_fields = 12;"),
    ],
    "fields.cpp": [
        (
            '"stretching", of_surface, unstretched_at_side, one, without_flow},\n',
            '"stretching", of_surface, unstretched_at_side, one, without_flow},\n'
            '        {squared_density, "c_squared", of_surface, nullptr,\n'
            "         [](const InitialPoint& at, const MembraneEnergy&) { return at.molecules * at.molecules; }},\n",
        ),
    ],
    "point_equations.h": [
        (
            "    return row;\n",
            "    const Number& c = x[molecule_density].value;\n"
            "    row[squared_density].value = x[squared_density].value - c * c;\n"
            "    return row;\n",
        ),
    ],
}


def with_unknown(name, text):
    """The text of a file of the scheme after the recipe."""
    for old, new in EDITS.get(name, ()):
        if text.count(old) != 1:
            sys.exit(f"{FOLDER / name}: {old!r} must stand in it once for the recipe of docs/extending.md")
        text = text.replace(old, new)
    return text


def main(project, directory):
    """Copies the folder, edited."""
    target = Path(directory) / FOLDER
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    for file in sorted((Path(project) / FOLDER).iterdir()):
        (target / file.name).write_text(with_unknown(file.name, file.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
