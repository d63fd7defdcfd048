"""What `endoflow modes` draws from its tables: plots, report.html and surfaces for ParaView.

`endoflow-modes` computes and then becomes this command. Exit codes: 0 done; 2 bad command line; 4 the tables cannot be
read or files cannot be written; 130 interrupted.
"""

import endoflow
from comparisons.drawing import mode_plots
from comparisons.drawing.surfaces import write_surfaces
from comparisons.errors import shown
from comparisons.files import write_text
from comparisons.measures.basis import common_basis
from comparisons.page.modes_report import modes_html
from comparisons.studies.members import read_record

#: Distance of points along the membrane in the surfaces, nm.
SPACING = 1.2


def run(options):
    """Run the command; returns its exit code."""
    directory, modes = options.directory, endoflow.load_modes(options.directory)
    drawn = mode_plots.write_all(modes, directory)
    surfaces = ((meridian.time, mode_plots.surface(meridian, SPACING)) for meridian in modes.meridians)
    write_surfaces(directory, "membrane_modes.pvd", "surfaces", enumerate(surfaces))
    record = read_record(options.run) if options.run else None
    basis = common_basis([record] if record else [])
    write_text(directory / "report.html", modes_html(modes, basis, drawn, directory))
    print(f"report  {shown(directory / 'report.html')}")
    print(f"ParaView  {shown(directory / 'membrane_modes.pvd')}")
    return 0
