"""`endoflow revolve DIR [--angle 270]`: the membrane of a run as surfaces in space, for ParaView.

Writes DIR/membrane.pvd and DIR/membrane/*.vtp, coloured by c, tension, curvature, velocity. Exit codes: 0 done; 2 bad
command line; 4 the run cannot be read or the files cannot be written; 130 interrupted.
"""

import numpy as np

import endoflow
from comparisons.drawing.surfaces import membrane_surface, write_surfaces
from comparisons.errors import shown
from comparisons.files import require_writable


def run(options):
    """Run the command; returns its exit code."""
    run = endoflow.load(options.directory)
    output = options.output or options.directory
    require_writable(output / "membrane")
    count = len(run.shapes)
    chosen = np.unique(np.linspace(0, count - 1, min(options.most, count)).round().astype(int))
    surfaces = ((i, (run.shapes[i].time, membrane_surface(run.shapes[i], options.angle))) for i in chosen)
    written = write_surfaces(output, "membrane.pvd", "membrane", surfaces)
    print(f"{written} {'shapes' if run.engine == 'statics' else 'times'}: {shown(output / 'membrane.pvd')}")
    return 0
