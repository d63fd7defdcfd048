#!/usr/bin/env python3
"""The pictures of a demonstration: tools/demo_pictures.py DIR_A DIR_B -o DIR writes hero.png and hero.webp there.

`make hero` copies them to docs/images for the README. Exit codes as `endoflow compare`.
"""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

sys.path[:0] = [str(ROOT), str(ROOT / "python")]

from comparisons.commands import guarded  # noqa: E402


def main(arguments):
    """Run the command; returns its exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("a", type=Path, metavar="DIR_A")
    parser.add_argument("b", type=Path, metavar="DIR_B")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    options = parser.parse_args(arguments)

    def body():
        import endoflow
        from comparisons.drawing.mirrored import film, picture, write_film

        runs = endoflow.load(options.a), endoflow.load(options.b)
        options.output.mkdir(parents=True, exist_ok=True)
        origin = "; ".join(f"{run.engine}, {run.record['provenance'].get('git')}" for run in runs)
        picture(*runs).savefig(options.output / "hero.png", metadata={"Source": origin})
        write_film(film(*runs), options.output / "hero.webp")
        return 0

    return guarded("demo pictures", body)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
