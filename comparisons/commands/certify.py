"""`endoflow run ENGINE CASE.toml --certify`: a run, and the more accurate ones that tell how accurate it is.

The run lies in DIR as ever, the others in DIR/certify/; run.json gets `certificate`. Exit codes: 0 done; 2 bad command
line or parameter; 3 a run failed; 4 input or output; 130 or 143 interrupted (run it again to continue).
"""

import json
import os
from pathlib import Path

import endoflow
from comparisons.commands.options import common_settings
from comparisons.errors import IO_FAILURE, StudyError, shown
from comparisons.files import write_json
from comparisons.studies.certification import (
    THICKNESS_RATIO,
    certificate,
    denser_settings,
    finer_settings,
    in_words,
    layer_parts,
    sharp_parts,
    thinner_settings,
)
from comparisons.studies.members import checked_member
from comparisons.studies.study import Study


class Certification(Study):
    """A run and what certifies it, which is the study's directory."""

    command = "run"

    def members(self):
        """The run itself."""
        options, directory = self.options, self.output.parent
        return [checked_member("run", options.case, directory, options.engine, common_settings(options))]

    def evaluate(self, outcomes):
        """The certificate, which is put into run.json; None without all runs."""
        if self.failed:
            return None
        run = endoflow.load(self.output.parent)
        self.run([*self.refined(run)])
        if self.failed:
            return None
        runs = {name: endoflow.load(self.output / name) for name in self.settings(run)}
        if run.engine == "phase-field":
            parts = layer_parts(run, runs["finer"], runs["thinner"], THICKNESS_RATIO)
        else:
            parts = sharp_parts(run, runs["denser"], runs["finer"])
        found = certificate(run, parts)
        found["runs"] = {name: str(Path("certify") / name) for name in runs}
        path = run.directory / "run.json"
        beside = path.with_suffix(".json.new")
        write_json(beside, {**json.loads(path.read_text(encoding="utf-8")), "certificate": found})
        os.replace(beside, path)
        return found

    def settings(self, run):
        """{name: settings that a more accurate run adds} for an endoflow.Run."""
        notes = run.record.get("notes", {})
        finer = finer_settings(run.engine, run.parameters, notes)
        if run.engine == "phase-field":
            return {"finer": finer, "thinner": thinner_settings(run.parameters)}
        return {"finer": finer, "denser": denser_settings(run.parameters, notes)}

    def refined(self, run):
        """The Members that certify a finished endoflow.Run."""
        for name, changes in self.settings(run).items():
            settings = (*common_settings(self.options), *changes)
            yield checked_member(name, self.options.case, self.output / name, run.engine, settings)

    def page(self, found):
        if found is None:
            return []
        if not found["values"]:
            raise StudyError(f"{self.output.parent}: the runs share no quantity that could be certified", IO_FAILURE)
        lines = [f"{entry['title']:<14} {in_words(entry)}" for entry in found["values"].values()]
        return [*lines, f"results in {shown(self.output.parent)}, what certifies them in {shown(self.output)}"]


def run(options):
    """Run the command; returns its exit code."""
    output = options.output or Path("out") / options.case.stem / options.engine
    return Certification(options, output / "certify").conduct()
