"""What `endoflow modes` draws from its tables: plots, report.html and surfaces for ParaView.

`endoflow-modes` computes and then becomes this command. Exit codes: 0 done; 2 bad command line; 4 the tables cannot be
read or files cannot be written; 130 interrupted.
"""

import argparse
from pathlib import Path

from comparisons.files import shown, write_text

#: Distance of points along the membrane in the surfaces, nm.
SPACING = 1.2


def parsed(arguments):
    """The command line as a namespace."""
    parser = argparse.ArgumentParser(
        prog="endoflow modes", description="Draw the modes that endoflow-modes has computed.", allow_abbrev=False
    )
    parser.add_argument("directory", metavar="DIR", type=Path, help="where modes.csv lies")
    parser.add_argument("--run", metavar="DIR", type=Path, help="directory of the run, whose convention, resolution and alarms the page names")
    return parser.parse_args(arguments)


def write_surfaces(modes, directory):
    """Write directory/membrane_modes.pvd and its surfaces, one for each time."""
    from comparisons.drawing.mode_plots import surface
    from comparisons.drawing.vtk_files import polydata_text, write_collection

    folder = directory / "surfaces"
    folder.mkdir(parents=True, exist_ok=True)
    entries = []
    for index, meridian in enumerate(modes.meridians):
        file = folder / f"membrane_{index:06d}.vtp"
        write_text(file, polydata_text(*surface(meridian, SPACING)))
        entries.append((meridian.time, f"surfaces/{file.name}"))
    write_collection(directory / "membrane_modes.pvd", entries)


def run(options):
    """Run the command; returns its exit code."""
    import endoflow
    from comparisons.drawing import mode_plots
    from comparisons.measures.basis import common_basis
    from comparisons.page.modes_report import modes_html
    from comparisons.studies.members import read_record

    modes = endoflow.load_modes(options.directory)
    drawn = mode_plots.write_all(modes, options.directory)
    write_surfaces(modes, options.directory)
    record = read_record(options.run) if options.run else None
    basis = common_basis([record] if record else [])
    write_text(options.directory / "report.html", modes_html(modes, basis, drawn, options.directory))
    print(f"report  {shown(options.directory / 'report.html')}")
    print(f"ParaView  {shown(options.directory / 'membrane_modes.pvd')}")
    return 0
