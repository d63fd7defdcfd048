#!/usr/bin/env python3
"""`make bench`: what the engines cost on this machine, as out/bench/bench.json and bench.md.

    bench/bench.py BUILD [-o DIR] [--quick] [--repeats N] [--only NAME,…] [--scaling N,…]

Every figure is the median of the repeats, each of them a run of the installed command; ratios are taken inside one
repeat. CPU time is what to compare on a machine that does other things too. Exit code 0, 2 (command line) or 3 (a run
failed).
"""

import argparse
import json
import os
import sys
from pathlib import Path

import machine
import measurements
import report


def parsed(arguments):
    """The command line as a namespace."""
    parser = argparse.ArgumentParser(prog="bench.py", description="What the engines cost on this machine.")
    parser.add_argument("build", metavar="BUILD", type=Path, help="build directory with endoflow and bench-ring-kernels")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, default=Path("out/bench"))
    parser.add_argument("--quick", action="store_true", help="one repeat of shorter runs: does it all work?")
    parser.add_argument("--repeats", metavar="N", type=int, help="default: 3, with --quick 1")
    parser.add_argument(
        "--only",
        metavar="NAME,…",
        help=f"some of {', '.join(measurements.ALL)}",
        type=lambda text: text.split(","),
    )
    parser.add_argument(
        "--scaling",
        metavar="N,…",
        help="the phase field on these numbers of processes (default: 1,2); alone, where --only names no others",
        type=lambda text: tuple(int(number) for number in text.split(",")),
    )
    options = parser.parse_args(arguments)
    options.only = options.only or (["scaling"] if options.scaling else list(measurements.ALL))
    options.scaling = options.scaling or measurements.Bench.scaling
    unknown = [name for name in options.only if name not in measurements.ALL]
    if unknown:
        parser.error(f"--only: no measurement is called {unknown[0]!r}; there are {', '.join(measurements.ALL)}")
    if not (options.build / "endoflow").exists():
        parser.error(f"{options.build}: holds no `endoflow`; build it first")
    options.repeats = options.repeats or (1 if options.quick else 3)
    return options


def main(arguments):
    """Measure, print and write; returns the exit code."""
    options = parsed(arguments)
    bench = measurements.Bench(
        options.build.resolve(), options.output.resolve(), options.quick, options.repeats, options.scaling
    )
    found = {"machine": machine.describe(), "quick": options.quick, "repeats": options.repeats, "figures": {}}
    if found["machine"]["load_at_start"] > 0.3:
        print("note: the machine is not idle; compare CPU times and ratios, not wall times", file=sys.stderr)
    options.output.mkdir(parents=True, exist_ok=True)
    try:
        for name in options.only:
            print(f"== {name}", flush=True)
            figure = measurements.ALL[name](bench)
            found["figures"][name] = figure
            print("\n".join(report.section(name, figure)), flush=True)
    except measurements.RunFailed as failure:
        print(f"bench: {failure}", file=sys.stderr)
        return 3
    found["machine"]["load_at_end"] = os.getloadavg()[0]
    (options.output / "bench.json").write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")
    (options.output / "bench.md").write_text(report.markdown(found), encoding="utf-8")
    print(f"{options.output / 'bench.md'}, {options.output / 'bench.json'}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
