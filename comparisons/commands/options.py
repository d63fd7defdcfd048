"""Options that several commands share."""

import argparse
import json
import sys
from pathlib import Path

from comparisons.errors import BAD_INPUT, StudyError


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


def positive_integer(text):
    """For argparse."""
    if not text.isdigit() or int(text) == 0:
        raise ValueError(text)
    return int(text)


def runs_parser(study, description, output):
    """Parser of `endoflow STUDY`, which makes runs; output: what -o defaults to, for the help."""
    parser = Parser(
        prog=f"endoflow {study}",
        description=description,
        allow_abbrev=False,
        epilog="Finished runs are not repeated and interrupted ones are continued when the command is given again.",
    )
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help=f"where to write (default: {output})")
    parser.add_argument("--jobs", metavar="N", type=positive_integer, help="most runs at a time (default: all cores)")
    parser.add_argument(
        "--processes",
        metavar="N",
        type=positive_integer,
        default=1,
        help="MPI processes of each phase-field run (default: 1)",
    )
    return parser


def study_parser(study, description, output):
    """The same with settings for every run."""
    parser = runs_parser(study, description, output)
    parser.add_argument(
        "--set", metavar="section.key=value", action="append", default=[], help="for every run; may be repeated"
    )
    return parser


def case_parser(study, description):
    """Parser of a study of one case."""
    parser = study_parser(study, description, f"out/CASE/{study}")
    parser.add_argument("case", metavar="CASE.toml", type=Path, help="case file")
    parser.add_argument("--until", metavar="T", help="time.end in µs")
    return parser


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
