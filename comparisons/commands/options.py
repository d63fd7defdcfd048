"""The command lines: every command's options in one table, read before anything that takes long to import."""

import argparse
import json
import sys
from collections import namedtuple
from pathlib import Path

from comparisons import ENGINES
from comparisons.errors import BAD_INPUT, StudyError
from comparisons.inference.study_keys import documentation
from comparisons.paper import NAMES, OTHER_NAMES

AGAIN = "Finished runs are not repeated and interrupted ones are continued when the command is given again."


def parsed(name, arguments):
    """The command line of a command (a key of COMMANDS) as a namespace; ends the program as argparse does."""
    command = COMMANDS[name]
    parser = Parser(prog=f"endoflow {name}", description=command.description, allow_abbrev=False)
    command.options(parser)
    return parser.parse_args(arguments)


class Parser(argparse.ArgumentParser):
    """A command's parser; `--describe` alone prints its options as JSON, as the other commands do."""

    def parse_args(self, args=None, namespace=None):
        if args is not None and list(args) == ["--describe"]:
            print(json.dumps(self.described()))
            sys.exit(0)
        if any(word == "" or (word.startswith("--") and word.endswith("=")) for word in args or ()):
            self.error("an argument is empty; is a variable of the shell not set?")
        return super().parse_args(args, namespace)

    def described(self):
        """{command, description, options: [{names, value, required, help, choices}]}; manual page and completions come from it."""
        options = [self._option(action) for action in self._actions]
        return {"command": self.prog, "description": self.description, "options": options}

    def _option(self, action):
        value = "" if action.nargs == 0 else action.metavar or action.dest.upper()
        return {
            "names": [*action.option_strings],
            "value": value,
            "required": bool(action.required),
            "help": self._get_formatter()._expand_help(action) if action.help else "",
            "choices": [str(choice) for choice in action.choices or ()],
        }


class Keys(argparse.Action):
    """Prints the keys of a study and ends, as --help does."""

    def __init__(self, option_strings, dest, **how):
        super().__init__(option_strings, argparse.SUPPRESS, nargs=0, **how)

    def __call__(self, parser, *_):
        print(documentation(), end="")
        parser.exit()


def positive_integer(text):
    """For argparse."""
    if not text.isdigit() or int(text) == 0:
        raise ValueError(text)
    return int(text)


def angle(text):
    """For argparse: whole degrees up to a full turn."""
    degrees = positive_integer(text)
    if degrees > 360:
        raise argparse.ArgumentTypeError("at most 360")
    return degrees


def run_directory(parser):
    """DIR, the run that a command is about."""
    parser.add_argument("directory", metavar="DIR", type=Path, help="directory of a run")


def many_runs(parser, output):
    """Options of a command that makes runs; output: what -o defaults to, for the help."""
    parser.epilog = AGAIN
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help=f"where to write (default: {output})")
    parser.add_argument("--jobs", metavar="N", type=positive_integer, help="most runs at a time (default: all cores)")
    what = "MPI processes of each phase-field run (default: 1)"
    parser.add_argument("--processes", metavar="N", type=positive_integer, default=1, help=what)


def settings(parser):
    """--set, for every run."""
    what = "for every run; may be repeated"
    parser.add_argument("--set", metavar="section.key=value", action="append", default=[], help=what)


def runs_of_a_case(parser, study):
    """Options of a study of one case."""
    many_runs(parser, f"out/CASE/{study}")
    settings(parser)
    parser.add_argument("case", metavar="CASE.toml", type=Path, help="case file")
    parser.add_argument("--until", metavar="T", help="time.end in µs")


def certify(parser):
    parser.prog = "endoflow run"
    parser.add_argument("engine", choices=ENGINES)
    runs_of_a_case(parser, "ENGINE")
    parser.add_argument("--certify", action="store_true", help="what brought you here")
    parser.add_argument("--restart", action="store_true", help="no matter: what is there is continued in any case")


def compare(parser):
    parser.add_argument("a", metavar="DIR_A", type=Path, help="directory of the first run (drawn on the left)")
    parser.add_argument("b", metavar="DIR_B", type=Path, help="directory of the second run (drawn on the right)")
    where = "where to write (default: %(default)s)"
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, default=Path("comparison"), help=where)


def converge(parser):
    runs_of_a_case(parser, "converge")
    parser.add_argument("--epsilon", metavar="E1,E2,...", required=True, help="values of phase_field.epsilon in nm")
    what = "phase_field.cell_size = ε/X (default: the case's ratio; where it has none 1, of the scheme paper its own)"
    parser.add_argument("--cells-per-epsilon", metavar="X", help=what)
    what = "times of the comparison in µs (default: four, evenly chosen)"
    parser.add_argument("--times", metavar="T1,T2,...", help=what)


def crate(parser):
    run_directory(parser)
    parser.add_argument("--license", metavar="URL", help="licence under which the data are published (default: left open)")


def infer(parser):
    many_runs(parser, "out/STUDY/infer")
    parser.add_argument("--keys", action=Keys, help="print every key of a study as a table and end")
    parser.add_argument("study", metavar="STUDY.toml", type=Path, help="case, unknowns with priors, data with errors")
    what = "do N cases with known truth as well: ranks and coverage"
    parser.add_argument("--calibrate", metavar="N", type=positive_integer, help=what)
    what = "--calibrate with data from this run of either engine, its parameters being true"
    parser.add_argument("--truth", metavar="DIR", type=Path, help=what)
    what = "Sobol indices of budding time, neck and diameter as well"
    parser.add_argument("--sensitivity", action="store_true", help=what)


def outcome_map(parser):
    runs_of_a_case(parser, "map")
    what = "a parameter's range; given twice"
    parser.add_argument("--vary", metavar="section.key=LOW:HIGH", action="append", required=True, help=what)
    parser.add_argument("--engine", default=ENGINES[0], choices=ENGINES)
    for name, default, what in (
        ("--cells", 4, "cells of the first grid along each axis"),
        ("--levels", 3, "times that cells along boundaries are halved"),
    ):
        what += f" (default: {default})"
        parser.add_argument(name, metavar="N", type=positive_integer, default=default, help=what)
    what = "a run of `endoflow statics --continue-in` in one of the two: its folds, and where its neck closes, are drawn; "
    parser.add_argument("--folds", metavar="DIR", type=Path, action="append", default=[], help=what + "may be repeated")


def modes(parser):
    parser.add_argument("directory", metavar="DIR", type=Path, help="where modes.csv lies")
    what = "directory of the run, whose convention, resolution and alarms the page names"
    parser.add_argument("--run", metavar="DIR", type=Path, help=what)


def movie(parser):
    run_directory(parser)
    parser.add_argument("-o", "--output", metavar="FILE", type=Path, help="film, .mp4 or .gif (default: DIR/movie.mp4)")
    for name, default, what in (
        ("--seconds", 10, "length"),
        ("--fps", 25, "frames per second"),
        ("--width", 1280, "width in pixels"),
    ):
        parser.add_argument(name, type=positive_integer, default=default, help=f"{what} (default: %(default)s)")


def report(parser):
    run_directory(parser)
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="where to write (default: DIR/report)")


def reproduce(parser):
    many_runs(parser, "out/paper")
    settings(parser)
    names = (*NAMES, "all", *OTHER_NAMES)
    parser.add_argument("items", metavar="ITEM", nargs="+", choices=names, help=", ".join(names))
    extent = parser.add_mutually_exclusive_group()
    extent.add_argument("--quick", action="store_true", help="few and short phase-field runs: all in half an hour")
    extent.add_argument("--full", action="store_true", help="the paper's layer and times (the default); many hours")
    parser.add_argument("--engine", choices=(*ENGINES, "both"), default="both", help="default: %(default)s")
    parser.add_argument("--until", metavar="T", type=float, help="no run goes on longer than this, µs")
    parser.add_argument("--pages-only", action="store_true", help="run nothing: write the pages from the runs there are")


def revolve(parser):
    run_directory(parser)
    where = "where to write (default: the run's directory)"
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help=where)
    what = "degrees, 360 closes the surface (default: %(default)s)"
    parser.add_argument("--angle", type=angle, default=270, help=what)
    parser.add_argument("--most", type=positive_integer, default=100, help="most times (default: %(default)s)")


def sweep(parser):
    runs_of_a_case(parser, "sweep")
    what = "start:stop:step (stop included) or value,value,...; may be repeated for all combinations"
    parser.add_argument("--vary", metavar="section.key=VALUES", action="append", required=True, help=what)
    parser.add_argument("--engine", required=True, choices=(*ENGINES, "both"))
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--slurm", action="store_true", help="write DIR/sweep.sbatch for the unfinished runs; run nothing")
    how.add_argument("--collect", action="store_true", help="make the table and plots of what is there; run nothing")


Command = namedtuple("Command", "description options place")

#: {command: (what it does, its options, the module beside this one and its function, which returns the exit code)}.
COMMANDS = {
    "certify": Command("Run a case and certify its numbers.", certify, "certify.run"),
    "compare": Command("Compare two finished runs.", compare, "compare.run"),
    "converge": Command("Compare phase-field runs of decreasing ε with the sharp membrane.", converge, "converge.run"),
    "sweep": Command("Run a case with many values of some parameters.", sweep, "sweep.run"),
    "reproduce": Command("Reproduce figures and tables of the paper.", reproduce, "reproduce.run"),
    "movie": Command("Make a film of a run, or of a branch of stationary shapes (needs ffmpeg).", movie, "one_run.movie"),
    "revolve": Command("Revolve a run's membrane for ParaView.", revolve, "one_run.revolve"),
    "report": Command("Make a page of one run.", report, "one_run.report"),
    "infer": Command("Infer parameters from data: best fit, posterior, what the data separate.", infer, "infer.run"),
    "crate": Command("Describe a run's directory for archives (RO-Crate).", crate, "one_run.crate"),
    "map": Command("Trace where the outcomes of runs change over two parameters.", outcome_map, "map.run"),
    "modes": Command("Draw the modes that endoflow-modes has computed.", modes, "one_run.modes"),
}


def common_settings(options):
    """The settings of every member, in the order in which they override the case file."""
    return [*options.set, *([f"time.end={options.until}"] if options.until else [])]


def require_apart(options, varied):
    """Raises StudyError when --set or --until names one of the varied keys: which of both should hold?"""
    given = [setting.partition("=")[0] for setting in common_settings(options)]
    for key in varied:
        if key in given:
            raise StudyError(f"--vary {key}: --set or --until gives it a value, too; leave one out", BAD_INPUT)


def output_directory(options, study):
    """Where the study of a case is written."""
    return options.output or Path("out") / options.case.stem / study
