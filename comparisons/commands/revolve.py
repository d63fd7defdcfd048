"""`endoflow revolve DIR [--angle 270]`: the membrane of a run as surfaces in space, for ParaView.

Writes DIR/membrane.pvd and DIR/membrane/*.vtp, coloured by c, tension, curvature, velocity. Exit codes: 0 done; 2 bad
command line; 4 the run cannot be read or the files cannot be written; 130 interrupted.
"""

from pathlib import Path

import numpy as np

from comparisons.files import write_text

from .options import Parser, positive_integer

#: Distance of points along the membrane (nm), and angle (degrees) between two meridians.
SPACING, ANGLE_STEP = 0.8, 5.0


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

    Names end in their unit. A full turn shares its first meridian.
    """
    from endoflow.curves import resample

    fields = ("c", "lambda_", "kappa", "u_r", "u_z")
    r, z, c, tension, curvature, u_r, u_z = resample(shape.r, shape.z, SPACING, *(getattr(shape, f) for f in fields))
    closed = angle == 360
    meridians = max(3, round(angle / ANGLE_STEP)) + (not closed)
    phi = np.radians(np.linspace(0, angle, meridians, endpoint=not closed))
    around = lambda values: np.tile(values, meridians)  # noqa: E731
    outward = np.column_stack((np.repeat(np.cos(phi), len(r)), np.repeat(np.sin(phi), len(r))))
    points = np.column_stack((outward * around(r)[:, None], around(z)))
    velocity = np.column_stack((outward * around(u_r)[:, None], around(u_z)))
    first = np.arange(meridians if closed else meridians - 1)[:, None] * len(r) + np.arange(len(r) - 1)
    after = (first + len(r)) % (meridians * len(r))
    quads = np.stack((first, first + 1, after + 1, after), axis=-1).reshape(-1, 4)
    arrays = {"c": c, "tension_pN_per_nm": tension, "total_curvature_per_nm": curvature}
    return points, quads, {**{name: around(values) for name, values in arrays.items()}, "velocity_nm_per_us": velocity}


def run(options):
    """Run the command; returns its exit code."""
    import endoflow
    from comparisons.drawing.vtk_files import polydata_text, write_collection

    run = endoflow.load(options.directory)
    output = options.output or options.directory
    chosen = np.unique(np.linspace(0, len(run.shapes) - 1, min(options.most, len(run.shapes))).round().astype(int))
    folder = output / "membrane"
    folder.mkdir(parents=True, exist_ok=True)
    entries = []
    for index in chosen:
        file = folder / f"membrane_{index:06d}.vtp"
        write_text(file, polydata_text(*surface(run.shapes[index], options.angle)))
        entries.append((run.shapes[index].time, f"membrane/{file.name}"))
    write_collection(output / "membrane.pvd", entries)
    print(f"{len(entries)} times: {output / 'membrane.pvd'}")
    return 0
