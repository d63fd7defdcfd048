"""Carries out the recipe "An unknown of the scheme production" of docs/extending.md on copies of the files that it touches.

    python3 add_unknown.py PROJECT DIRECTORY     # writes DIRECTORY/phasefield/schemes/production

The unknown is w, the molecules' squared density as it is seen through a blur of width ε: w − ε² Δw = c². added_unknown_test.cpp
solves for it.
"""

import sys
from pathlib import Path

FOLDER = Path("phasefield/schemes/production")

#: {file: (text that stands in it once, what takes its place)}: a value, a row, an equation.
RECIPE = {
    "fields.h": ("    n_fields,", "    blurred_square,      // w\n    n_fields,"),
    "fields.cpp": (
        "    }};\n    return table;\n",
        '        {blurred_square, "blurred_square", of_surface, unit_size, nullptr,\n'
        "         [](const InitialPoint& at, const MembraneEnergy&) { return at.molecules * at.molecules; }, nullptr},\n"
        "    }};\n    return table;\n",
    ),
    "equation_pattern.cpp": (
        "    {membrane_stretch, value(distance)",
        "    {blurred_square, value(blurred_square) | value(molecule_density), r(blurred_square), z(blurred_square)},\n"
        "    {membrane_stretch, value(distance)",
    ),
    "point_equations.h": (
        "    return row;\n",
        "    const auto &c = x[molecule_density], &w = x[blurred_square];\n"
        "    const double squared_width = p.epsilon * p.epsilon;\n"
        "    row[blurred_square] = {w.value - c.value * c.value, squared_width * w.r, squared_width * w.z};\n"
        "    return row;\n",
    ),
}


def with_unknown(file, before, after):
    """The file's text with `after` at the place of `before`."""
    text = file.read_text(encoding="utf-8")
    if text.count(before) != 1:
        sys.exit(f"{file}: {before!r} must stand in it once for the recipe of docs/extending.md")
    return text.replace(before, after)


def main(project, directory):
    """Writes the copies; those that are as they should be keep their dates, and nothing is compiled again."""
    target = Path(directory) / FOLDER
    target.mkdir(parents=True, exist_ok=True)
    for name, (before, after) in RECIPE.items():
        text, copy = with_unknown(Path(project) / FOLDER / name, before, after), target / name
        if not copy.exists() or copy.read_text(encoding="utf-8") != text:
            copy.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
