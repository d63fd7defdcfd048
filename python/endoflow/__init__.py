"""Run endoflow and read what it writes.

    import endoflow
    run = endoflow.run("boundary-integral", "standard", until=1)     # or, of an earlier run:
    run = endoflow.load("out/standard/boundary-integral")
    run.history["neck_radius_nm"]        # numpy array, nan where there is no neck
    run.shapes[-1].r, run.shapes[-1].z   # the last membrane curve, axis to rim, in nm
    run.shape_at(0.5)                    # the membrane at 0.5 µs
    run.fields_at(0.5)["velocity"]       # what ParaView shows nearest to 0.5 µs

Reading needs numpy and h5py, nothing else; running needs the program (`program()` says where it is).
"""

from .alarms import Alarm
from .commands import compare, infer, run, statics, sweep
from .errors import EndoflowError, OutOfRangeError, RunDirectoryError
from .fields import Fields
from .modes import Modes, load_modes
from .noise import Noise
from .program import FileError, InputError, ProgramError, SolverError, program
from .run_directory import Run, load
from .shapes import Shape

__all__ = [
    "Alarm",
    "EndoflowError",
    "Fields",
    "FileError",
    "InputError",
    "Modes",
    "Noise",
    "OutOfRangeError",
    "ProgramError",
    "Run",
    "RunDirectoryError",
    "Shape",
    "SolverError",
    "compare",
    "infer",
    "load",
    "load_modes",
    "program",
    "run",
    "statics",
    "sweep",
]
