"""Small runs of the real engines, for tests of what they write and of what happens to them."""

import os
import re
import subprocess
from pathlib import Path

from scratch import scratch_directory

ROOT = Path(__file__).resolve().parents[1]

#: Runs whose steps take a fraction of a second, {engine: {key: value}}. The sharp engine's raises no alarm while the membrane is
#: nearly flat; with 24 elements, which do not resolve the coat's edge, it does.
COARSE = {
    "boundary-integral": {"boundary_integral.elements": 36},
    "phase-field": {
        "domain.radius": 40,
        "domain.height": 40,
        "domain.membrane_height": 20,
        "molecules.patch_radius": 20,
        "molecules.interface_width": 4,
        "phase_field.epsilon": 4,
        "phase_field.cell_size": 4,
    },
}

#: A layer far too thick for anything else, and an edge of the patch that the production scheme need not refine much for.
THICK = ("phase_field.epsilon=6", "phase_field.cell_size=7", "molecules.interface_width=6")

#: What makes the standard case one of seconds, by engine; a scheme that is not the engine's default behind a comma.
TINY = {
    "boundary-integral": ("boundary_integral.field_spacing=8",),
    "phase-field": THICK,
    "phase-field,paper": (*THICK, "phase_field.scheme=paper"),
}


def texts(settings):
    """What --set takes, of {key: value}."""
    return tuple(f"{key}={value}" for key, value in settings.items())


def options(settings):
    """Words of a command line: --set and each of the texts "key=value"."""
    return [word for text in settings for word in ("--set", text)]


def launcher(processes):
    """Words before a command that is to run on several processes, of which there may be more than cores."""
    return ["mpirun", "-n", str(processes), "--oversubscribe"] if processes > 1 else []


def launcher_passes_on_last_words():
    """Whether mpirun passes on what processes write while it ends them: Open MPI's does not from version 5 on."""
    said = subprocess.run(["mpirun", "--version"], capture_output=True, text=True).stdout
    found = re.search(r"Open MPI\) (\d+)", said)
    return found is None or int(found[1]) < 5


def tiny_run(test, name, *settings):
    """Directory (Path) of a run of cases/standard.toml, name being one of TINY; skips the unittest.TestCase when the engine was not built.

    The program is the one named in ENDOFLOW_PROGRAM.
    """
    engine = name.split(",")[0]
    program = Path(os.environ.get("ENDOFLOW_PROGRAM", ""))
    if not (program.parent / f"endoflow-{engine}").exists():
        test.skipTest(f"the {engine} engine is not built")
    output = scratch_directory(test) / "run"
    command = [str(program), "run", engine, str(ROOT / "cases" / "standard.toml"), "-o", str(output)]
    subprocess.run(command + options((*TINY[name], *settings)), check=True, capture_output=True, timeout=1200)
    return output
