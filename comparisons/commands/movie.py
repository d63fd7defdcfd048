"""`endoflow movie DIR [-o FILE.mp4|FILE.gif]`: a run or a branch as a film of its membrane, coloured by c, with neck radius.

Exit codes: 0 done; 2 bad command line; 4 the run cannot be read, ffmpeg is missing or fails; 130 interrupted.
"""

from pathlib import Path

from comparisons.errors import BAD_INPUT, StudyError
from comparisons.files import require_writable, shown

from .options import Parser, positive_integer

FORMATS = (".mp4", ".gif")


def parsed(arguments):
    """The command line as a namespace."""
    parser = Parser(
        prog="endoflow movie", description="Make a film of a run, or of a branch of stationary shapes (needs ffmpeg).", allow_abbrev=False
    )
    parser.add_argument("directory", metavar="DIR", type=Path, help="directory of a run")
    parser.add_argument("-o", "--output", metavar="FILE", type=Path, help="film, .mp4 or .gif (default: DIR/movie.mp4)")
    parser.add_argument("--seconds", type=positive_integer, default=10, help="length (default: %(default)s)")
    parser.add_argument("--fps", type=positive_integer, default=25, help="frames per second (default: %(default)s)")
    parser.add_argument("--width", type=positive_integer, default=1280, help="width in pixels (default: %(default)s)")
    return parser.parse_args(arguments)


def run(options):
    """Run the command; returns its exit code."""
    output = options.output or options.directory / "movie.mp4"
    if output.suffix.lower() not in FORMATS:
        raise StudyError(f"{output}: a film's name ends in {' or '.join(FORMATS)}", BAD_INPUT)

    import endoflow
    from comparisons.drawing.film import Film, frame_times, write_film
    from comparisons.measures.along import Along

    run = endoflow.load(options.directory)
    require_writable(output.parent)
    times = frame_times(run, options.seconds * options.fps)
    write_film(Film(run, times, options.width), output, options.fps)
    print(f"{len(times)} frames, {Along(run).span()}: {shown(output)}")
    return 0
