"""`endoflow movie DIR [-o FILE.mp4|FILE.gif]`: a run or a branch as a film of its membrane, coloured by c, with neck radius.

Exit codes: 0 done; 2 bad command line; 4 the run cannot be read, ffmpeg is missing or fails; 130 interrupted.
"""

import endoflow
from comparisons.drawing.film import ENCODERS, Film, frame_times, write_film
from comparisons.errors import BAD_INPUT, StudyError, shown
from comparisons.files import require_writable
from comparisons.measures.along import Along


def run(options):
    """Run the command; returns its exit code."""
    output = options.output or options.directory / "movie.mp4"
    if output.suffix.lower() not in ENCODERS:
        raise StudyError(f"{output}: a film's name ends in {' or '.join(ENCODERS)}", BAD_INPUT)
    run = endoflow.load(options.directory)
    require_writable(output.parent)
    times = frame_times(run, options.seconds * options.fps)
    write_film(Film(run, times, options.width), output, options.fps)
    print(f"{len(times)} frames, {Along(run).span()}: {shown(output)}")
    return 0
