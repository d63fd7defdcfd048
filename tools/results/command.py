"""python3 tools/results BUILD [--only STUDY…] [--list | --pages]

Makes the runs of all studies that are not current, their tables in docs/results/data, the figures of docs/ and the numbers in
its pages. It goes on where it was interrupted: a run that is there is not made again, one that was cut short continues.
A table is current when the numerics revision and the commands that made it are those of today (`--list` says which are).
"""

import argparse
import json
import os
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path

import endoflow
from results import figures, pages, tables
from results.places import ROOT, RUNS, numerics_revision
from results.studies import COLUMNS, STUDIES

#: Written into a run's directory before its command starts, and when it is done.
BEGUN, DONE = "begun.json", "done.json"

#: Exit code of a run whose solver stopped.
SOLVER_STOPPED = 3


class Failed(Exception):
    """A run ended with an error, or is of another numerics revision than the sources."""


class Made:
    """The runs and tables of a study."""

    def __init__(self, study):
        self.study = study

    def directory(self, label):
        """Where a run is."""
        return RUNS / self.study.name / label

    def run(self, label):
        """A run as endoflow.Run."""
        return endoflow.load(self.directory(label))

    def csv(self, label, name):
        """The rows of a CSV file below a run's directory."""
        with (self.directory(label) / name).open(encoding="utf-8", newline="") as file:
            return tables.numbers(file)

    def rows(self, name):
        """The rows of a stored table."""
        return tables.read(name).rows


def state(study):
    """Why a study has to run, in words; "" when its tables are current."""
    for table in study.tables:
        stored = tables.read(table.name)
        if stored is None:
            return "missing"
        if stored.recorded:
            return f"recorded at commit {stored.recorded}"
        if stored.revision != numerics_revision():
            return f"numerics revision {stored.revision}, today's is {numerics_revision()}"
        if stored.commands != list(study.runs.values()):
            return "made by other commands"
    return ""


def stamp(command):
    """What a run's directory says of the command that made it."""
    return {"command": command, "numerics_revision": numerics_revision()}


def says(file, command):
    """Whether a file of a run's directory says that this command made it, with today's numerics."""
    return file.exists() and json.loads(file.read_text("utf-8")) == stamp(command)


def make_run(study, label, build):
    """Make a run unless it is there. Raises Failed."""
    made = Made(study)
    directory, command = made.directory(label), study.runs[label]
    if says(directory / DONE, command):
        return
    words = shlex.split(command.format_map({name: made.directory(name) for name in study.runs})) + ["-o", str(directory)]
    if says(directory / BEGUN, command) and (directory / "run.json").exists():
        words.append("--restart")
    elif directory.exists() and not says(directory / BEGUN, command):
        shutil.rmtree(directory)
    directory.mkdir(parents=True, exist_ok=True)
    (directory / BEGUN).write_text(json.dumps(stamp(command)), "utf-8")
    environment = {**os.environ, "PATH": f"{build}:{os.environ['PATH']}", "MPLBACKEND": "Agg"}
    with (directory.with_name(f"{label}.log")).open("w", encoding="utf-8") as log:
        code = subprocess.run(words, cwd=ROOT, env=environment, stdout=log, stderr=subprocess.STDOUT, check=False).returncode
    if code and not (code == SOLVER_STOPPED and study.failures_are_results):
        raise Failed(f"{command}: exit code {code}, see {log.name}")
    record = provenance(directory)
    if record.get("numerics_revision", numerics_revision()) != numerics_revision():
        raise Failed(f"{build} is of numerics revision {record['numerics_revision']}, the sources of {numerics_revision()}: make build")
    (directory / DONE).write_text(json.dumps(stamp(command)), "utf-8")


def provenance(directory):
    """run.json's provenance of the first run in or below a directory; {} without one."""
    for record in sorted(directory.rglob("run.json")):
        return json.loads(record.read_text("utf-8"))["provenance"]
    return {}


def write_tables(study):
    """Write a study's tables from its runs."""
    made = Made(study)
    commit = next(filter(None, (provenance(made.directory(label)).get("git") for label in study.runs)), "unknown")
    about = {tables.STUDY: study.name, tables.REVISION: numerics_revision(), tables.COMMIT: commit}
    for table in study.tables:
        tables.write(table.name, about, study.runs.values(), table.rows(made))


def write_derived():
    """Write the tables that follow from others, as old as these."""
    for study in STUDIES:
        for table in study.tables:
            if table.derived and tables.read(study.tables[0].name):
                origin = tables.read(study.tables[0].name)
                tables.write(table.name, origin.about, origin.commands, table.rows(Made(study)))


def minutes(number):
    """A time in words."""
    return f"{number:.0f} minutes" if number < 90 else f"{number / 60:.1f} hours"


def conduct(studies, build):
    """Make what is not current, and say how long it takes."""
    wanted = [study for study in studies if state(study)]
    left = sum(study.minutes for study in wanted)
    print(f"{len(wanted)} of {len(studies)} studies to make: some {minutes(left)} on two cores", flush=True)
    started, expected = time.monotonic(), 0.0
    for study in wanted:
        for number, label in enumerate(study.runs, start=1):
            print(f"{study.name}: {label} ({number} of {len(study.runs)})", flush=True)
            make_run(study, label, build)
        write_tables(study)
        expected += study.minutes
        left -= study.minutes
        pace = (time.monotonic() - started) / 60 / expected
        print(f"{study.name}: done; {minutes(left * min(max(pace, 0.1), 10))} left", flush=True)


def refresh():
    """Derived tables, figures and pages."""
    write_derived()
    figures.draw_all()
    for page in pages.fill_all(COLUMNS):
        print(f"filled {page.relative_to(ROOT)}")


def main():
    """Do what the command line asks for; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="build directory with endoflow")
    parser.add_argument("--only", nargs="+", metavar="STUDY", choices=[study.name for study in STUDIES], help="these studies alone")
    parser.add_argument("--list", action="store_true", help="say which studies there are, and which are current")
    parser.add_argument("--pages", action="store_true", help="draw and fill from the tables there are, without runs")
    options = parser.parse_args()
    studies = [study for study in STUDIES if not options.only or study.name in options.only]
    if options.list:
        for study in studies:
            print(f"{study.name:22s} {minutes(study.minutes):>12s}  {state(study) or 'current'}")
        return 0
    try:
        if not options.pages:
            conduct(studies, options.build.resolve())
    except Failed as failure:
        print(f"make results: {failure}", file=sys.stderr)
        return 1
    try:
        refresh()
    except pages.UnknownValue as unknown:
        print(f"make results: {unknown}", file=sys.stderr)
        return 1
    return 0
