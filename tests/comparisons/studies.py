"""A scratch directory with the fake program and a case, and the commands under test started from there."""

import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import locations  # noqa: F401
import synthetic
from command import CommandTest, words
from scratch import scratch_directory

PATCHES = "molecules.patch_radius=20:60:20"
BOUNDARY_INTEGRAL = ("--engine", "boundary-integral")

FAKE = Path(__file__).resolve().parent / "fake_endoflow.py"


class StudyTest(CommandTest):
    """Gives each test self.scratch (Path) with case.toml, and the program's log of runs."""

    def setUp(self):
        self.scratch = scratch_directory(self)
        self.program = self.scratch / "endoflow"
        path = str(FAKE.parent)
        self.program.write_text(
            f"#!{sys.executable}\nimport runpy, sys\nsys.path.insert(0, {path!r})\nrunpy.run_path({str(FAKE)!r})\n"
        )
        self.program.chmod(0o755)
        (self.scratch / "case.toml").write_text("")
        defaults = {
            "case": {"name": "synthetic", "description": ""},
            **synthetic.parameters(phase_field__cell_size=0.6),
        }
        (self.scratch / "defaults.json").write_text(json.dumps(defaults))

    def defaults(self, section, **values):
        """Change the program's defaults in a section, which may be new."""
        path = self.scratch / "defaults.json"
        content = json.loads(path.read_text())
        content[section] = {**content.get(section, {}), **values}
        path.write_text(json.dumps(content))

    def environment(self):
        return {**os.environ, "ENDOFLOW_PROGRAM": str(self.program)}

    def call(self, command, *arguments):
        """Run a study in the scratch directory; returns the finished process with its text."""
        return subprocess.run(
            words(command, *arguments),
            capture_output=True,
            text=True,
            timeout=1200,
            cwd=self.scratch,
            env=self.environment(),
        )

    def start(self, command, *arguments):
        """The same without waiting for its end."""
        return subprocess.Popen(
            words(command, *arguments),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=self.scratch,
            env=self.environment(),
        )

    def runs(self):
        """What the program ran since the last call: sorted list of "directory fresh|restart"."""
        log = self.scratch / "runs.log"
        lines = sorted(log.read_text().splitlines()) if log.exists() else []
        log.unlink(missing_ok=True)
        return lines


class SweepTest(StudyTest):
    """Adds `endoflow sweep case.toml` and its table."""

    def sweep(self, *arguments):
        return self.call("sweep", "case.toml", *arguments)

    def rows(self, directory="out/case/sweep"):
        with open(self.scratch / directory / "sweep.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
