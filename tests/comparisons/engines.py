"""Tiny runs of the real engines, for tests of what they write."""

import os
import subprocess
import tempfile
from pathlib import Path

import locations

#: What makes the standard case one of seconds; the phase field's layer is far too thick for anything else, and scheme
#: paper takes such a layer without refining the edge of the patch.
TINY = {
    "boundary-integral": ("boundary_integral.field_spacing=8",),
    "phase-field": ("phase_field.scheme=paper", "phase_field.epsilon=6", "phase_field.cell_size=7"),
}


def tiny_run(test, engine, *settings):
    """Directory (Path) of a run of cases/standard.toml; skips the unittest.TestCase when the engine was not built.

    The program is the one named in ENDOFLOW_PROGRAM.
    """
    program = Path(os.environ.get("ENDOFLOW_PROGRAM", ""))
    if not (program.parent / f"endoflow-{engine}").exists():
        test.skipTest(f"the {engine} engine is not built")
    scratch = tempfile.TemporaryDirectory()
    test.addCleanup(scratch.cleanup)
    output = Path(scratch.name) / "run"
    command = [str(program), "run", engine, str(locations.ROOT / "cases" / "standard.toml"), "-o", str(output)]
    options = [part for text in (*TINY[engine], *settings) for part in ("--set", text)]
    subprocess.run(command + options, check=True, capture_output=True, timeout=170)
    return output
