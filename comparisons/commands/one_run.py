"""Commands about one run that is there: a page of it, a film, surfaces for ParaView, metadata, and what its modes look like.

Exit codes: 0 done; 2 bad command line; 4 the run cannot be read, something cannot be written, or ffmpeg is missing or fails; 130
interrupted.
"""

import numpy as np

import endoflow
from comparisons.drawing.film import ENCODERS, Film, frame_times, write_film
from comparisons.drawing.surfaces import membrane_surface, write_surfaces
from comparisons.errors import BAD_INPUT, StudyError, shown
from comparisons.files import require_writable, write_json
from comparisons.measures.along import Along
from comparisons.measures.words import common_basis
from comparisons.page import modes_page, run_page
from comparisons.page.run_crate import metadata
from comparisons.studies.members import read_record


def report(options):
    """`endoflow report DIR [-o DIR]`: report.html of a run with plots, numbers, alarms, parameters, provenance."""
    run = endoflow.load(options.directory)
    output = options.output or options.directory / "report"
    require_writable(output)
    output.mkdir(parents=True, exist_ok=True)
    run_page.write_page(run, output)
    print(f"report  {shown(output / 'report.html')}")
    return 0


def movie(options):
    """`endoflow movie DIR [-o FILE.mp4|FILE.gif]`: a run or a branch as a film of its membrane, coloured by c, with neck radius."""
    output = options.output or options.directory / "movie.mp4"
    if output.suffix.lower() not in ENCODERS:
        raise StudyError(f"{output}: a film's name ends in {' or '.join(ENCODERS)}", BAD_INPUT)
    run = endoflow.load(options.directory)
    require_writable(output.parent)
    times = frame_times(run, options.seconds * options.fps)
    write_film(Film(run, times, options.width), output, options.fps)
    print(f"{len(times)} frames, {Along(run).span()}: {shown(output)}")
    return 0


def revolve(options):
    """`endoflow revolve DIR [--angle 270]`: DIR/membrane.pvd and DIR/membrane/*.vtp, the membrane as surfaces in space, coloured by
    c, tension, curvature, velocity."""
    run = endoflow.load(options.directory)
    output = options.output or options.directory
    require_writable(output / "membrane")
    count = len(run.shapes)
    chosen = np.unique(np.linspace(0, count - 1, min(options.most, count)).round().astype(int))
    surfaces = ((i, (run.shapes[i].time, membrane_surface(run.shapes[i], options.angle))) for i in chosen)
    written = write_surfaces(output, "membrane.pvd", "membrane", surfaces)
    print(f"{written} {'shapes' if run.engine == 'statics' else 'times'}: {shown(output / 'membrane.pvd')}")
    return 0


def crate(options):
    """`endoflow crate DIR`: ro-crate-metadata.json in a run's directory, with which archives know what is in it."""
    path = options.directory / "ro-crate-metadata.json"
    write_json(path, metadata(endoflow.load(options.directory), options.license))
    print(f"metadata  {shown(path)}")
    return 0


def modes(options):
    """What `endoflow modes` becomes when it has computed: plots, report.html and surfaces for ParaView from its tables."""
    directory, found = options.directory, endoflow.load_modes(options.directory)
    surfaces = ((meridian.time, modes_page.surface(meridian)) for meridian in found.meridians)
    write_surfaces(directory, "membrane_modes.pvd", "surfaces", enumerate(surfaces))
    record = read_record(options.run) if options.run else None
    modes_page.write_page(found, common_basis([record] if record else []), directory)
    print(f"report  {shown(directory / 'report.html')}")
    print(f"ParaView  {shown(directory / 'membrane_modes.pvd')}")
    return 0
