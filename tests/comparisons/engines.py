"""Tiny runs of the real engines, for tests of what they write."""

import os
import subprocess
import tempfile
from pathlib import Path

import locations

#: A layer far too thick for anything else, and an edge of the patch that the production scheme need not refine much for.
THICK = ("phase_field.epsilon=6", "phase_field.cell_size=7", "molecules.interface_width=6")

#: What makes the standard case one of seconds, by engine; a scheme that is not the engine's default behind a comma.
TINY = {
    "boundary-integral": ("boundary_integral.field_spacing=8",),
    "phase-field": THICK,
    "phase-field,paper": (*THICK, "phase_field.scheme=paper"),
}


def tiny_run(test, name, *settings):
    """Directory (Path) of a run of cases/standard.toml, name being one of TINY; skips the unittest.TestCase when the engine was not built.

    The program is the one named in ENDOFLOW_PROGRAM.
    """
    engine = name.split(",")[0]
    program = Path(os.environ.get("ENDOFLOW_PROGRAM", ""))
    if not (program.parent / f"endoflow-{engine}").exists():
        test.skipTest(f"the {engine} engine is not built")
    scratch = tempfile.TemporaryDirectory()
    test.addCleanup(scratch.cleanup)
    output = Path(scratch.name) / "run"
    command = [str(program), "run", engine, str(locations.ROOT / "cases" / "standard.toml"), "-o", str(output)]
    options = [part for text in (*TINY[name], *settings) for part in ("--set", text)]
    subprocess.run(command + options, check=True, capture_output=True, timeout=1200)
    return output
