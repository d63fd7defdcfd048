#!/usr/bin/env python3
"""tools/manual/make_manual.py PROGRAM CASES DIR: manual page and shell completions in DIR, from what the program says of itself.

Writes DIR/endoflow.1, DIR/endoflow.bash, DIR/_endoflow (zsh), DIR/endoflow.fish.
"""

import sys
from pathlib import Path

import completions
import described
import manual_page


def main(program, cases, directory):
    """Write the four files."""
    commands, parameters = described.commands(program), described.parameters(program)
    names = sorted(path.stem for path in Path(cases).glob("*.toml"))
    texts = {
        "endoflow.1": manual_page.page(commands, parameters, described.version(program)),
        "endoflow.bash": completions.bash(commands, parameters, names),
        "_endoflow": completions.zsh(commands, parameters, names),
        "endoflow.fish": completions.fish(commands, parameters, names),
    }
    for name, text in texts.items():
        (Path(directory) / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__.splitlines()[0])
    main(*sys.argv[1:])
