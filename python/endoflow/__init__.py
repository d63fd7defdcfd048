"""Read the directories written by `endoflow run`.

    import endoflow
    run = endoflow.load("out/standard")
    run.history["neck_radius_nm"]        # numpy array, nan where there is no neck
    run.shapes[-1].r, run.shapes[-1].z   # the last membrane curve, axis to rim, in nm
    run.shape_at(0.5)                    # the membrane at 0.5 µs
    run.fields_at(0.5)["velocity"]       # what ParaView shows nearest to 0.5 µs

Needs numpy and h5py, nothing else.
"""

from .alarms import Alarm
from .errors import EndoflowError, OutOfRangeError, RunDirectoryError
from .fields import Fields
from .run import Run, load
from .shapes import Shape

__all__ = ["EndoflowError", "Fields", "OutOfRangeError", "Run", "RunDirectoryError", "Shape", "load"]
