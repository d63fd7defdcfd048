"""`endoflow revolve DIR [--angle 270]`: the membrane of a run as surfaces in space, for ParaView.

Writes DIR/membrane.pvd and DIR/membrane/*.vtp, coloured by c, tension, curvature, velocity. Exit codes: 0 done; 2 bad
command line; 4 the run cannot be read or the files cannot be written; 130 interrupted.
"""

from pathlib import Path

import numpy as np

from comparisons.files import require_writable, shown, write_text

from .options import Parser, positive_integer

#: Distance of points along the membrane, nm.
SPACING = 0.8


def parsed(arguments):
    """The command line as a namespace."""
    parser = Parser(
        prog="endoflow revolve", description="Revolve a run's membrane for ParaView.", allow_abbrev=False
    )
    parser.add_argument("directory", metavar="DIR", type=Path, help="directory of a run")
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=Path, help="where to write (default: the run's directory)"
    )
    parser.add_argument(
        "--angle", type=positive_integer, default=270, help="degrees, 360 closes the surface (default: %(default)s)"
    )
    parser.add_argument("--most", type=positive_integer, default=100, help="most times (default: %(default)s)")
    options = parser.parse_args(arguments)
    if options.angle > 360:
        parser.error("argument --angle: at most 360")
    return options


def surface(shape, angle):
    """(points (n, 3), quads (m, 4), {array name: (n,) or (n, 3)}) of a Shape revolved about z by `angle` degrees.

    Names end in their unit.
    """
    from comparisons.drawing.surfaces import Revolved
    from endoflow.curves import resample

    fields = ("c", "lambda_", "kappa", "u_r", "u_z")
    r, z, c, tension, curvature, u_r, u_z = resample(shape.r, shape.z, SPACING, *(getattr(shape, f) for f in fields))
    revolved = Revolved(r, z, angle)
    arrays = {"c": c, "tension_pN_per_nm": tension, "total_curvature_per_nm": curvature}
    values = {name: revolved.around(along) for name, along in arrays.items()}
    return revolved.points, revolved.quads, {**values, "velocity_nm_per_us": revolved.vectors(u_r, u_z)}


def run(options):
    """Run the command; returns its exit code."""
    import endoflow
    from comparisons.drawing.vtk_files import polydata_text, write_collection

    run = endoflow.load(options.directory)
    output = options.output or options.directory
    chosen = np.unique(np.linspace(0, len(run.shapes) - 1, min(options.most, len(run.shapes))).round().astype(int))
    folder = output / "membrane"
    require_writable(folder)
    folder.mkdir(parents=True, exist_ok=True)
    entries = []
    for index in chosen:
        file = folder / f"membrane_{index:06d}.vtp"
        write_text(file, polydata_text(*surface(run.shapes[index], options.angle)))
        entries.append((run.shapes[index].time, f"membrane/{file.name}"))
    write_collection(output / "membrane.pvd", entries)
    print(f"{len(entries)} {'shapes' if run.engine == 'statics' else 'times'}: {shown(output / 'membrane.pvd')}")
    return 0
