"""Frames of a run and the film ffmpeg makes of them."""

import shutil
import subprocess

import numpy as np

from comparisons.drawing import style
from comparisons.drawing.axes import LOG_FROM, LOG_START, distance, half_width, plain_number, vertical_range
from comparisons.drawing.pictures import draw_membrane
from comparisons.drawing.style import plt
from comparisons.errors import IO_FAILURE, StudyError
from comparisons.measures.along import Along
from comparisons.measures.quantities import DRAWN
from endoflow.errors import last_word

#: Pixels per inch of a frame, and share of the film that shows the time up to a little after an early budding.
DOTS, EARLY_SHARE = 100, 0.6

#: What ffmpeg does with the frames, by the film's ending. A GIF gets a palette of its own.
ENCODERS = {
    ".mp4": ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart"],
    ".gif": ["-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-loop", "0"],
}


def early_budding(run):
    """Budding time (µs) of a run that goes on so long afterwards that equal steps would hide it; else None."""
    budding = run.event_time("budding")
    return budding if budding is not None and run.shape_times[-1] > LOG_FROM * budding else None


def frame_times(run, count):
    """Times (µs) of about `count` frames over the run's shapes; most of them up to an early budding.

    Of stationary shapes they are numbers, as in shapes.h5. Raises StudyError for a single shape.
    """
    if len(run.shapes) < 2:
        raise StudyError(f"{run.directory}: holds one shape, a film needs two; `endoflow report` draws it", IO_FAILURE)
    first, last = run.shape_times[0], run.shape_times[-1]
    budding = early_budding(run)
    if budding is None:
        return np.unique(np.linspace(first, last, count))
    before, split = max(2, round(EARLY_SHARE * count)), 1.25 * budding
    return np.unique(np.concatenate((np.linspace(first, split, before), np.linspace(split, last, count - before))))


class Film:
    """Frames of an endoflow.Run at `times` (µs), `width` pixels wide; frame(i) gives the pixels."""

    def __init__(self, run, times, width):
        self.run, self.times, self.along = run, times, Along(run)
        shapes = [run.shape_at(time) for time in times[:: max(1, len(times) // 50)]] + [run.shapes[-1]]
        self.z_range, self.rim = vertical_range(shapes, 8.0), half_width(shapes)
        even = 2 * round(width / 2), 2 * round(width * 9 / 32)
        self.figure = plt.figure(figsize=(even[0] / DOTS, even[1] / DOTS), dpi=DOTS)
        self.membrane = self.figure.add_axes([0.06, 0.09, 0.61, 0.8])
        self.history = self.figure.add_axes([0.73, 0.24, 0.25, 0.46])
        size = {"size": 22, "weight": "bold"} if self.along.is_time else {"size": 11}
        self.clock = self.figure.text(0.73, 0.86, "", **size)
        self.neck = self.figure.text(0.73, 0.79, "", size=14, color="#444444")
        self._draw_scale()
        self.figure.text(0.06, 0.93, self._title(), size=12, color="#444444")
        self.cursor = self._draw_history()

    def _title(self):
        case = self.run.parameters.get("case", {}).get("name", "")
        return style.literal(" · ".join(filter(None, (case, style.ENGINE_NAMES.get(self.run.engine, self.run.engine)))))

    def _draw_scale(self):
        """What the colours mean."""
        axes = self.figure.add_axes([0.77, 0.09, 0.17, 0.015])
        colours = plt.cm.ScalarMappable(cmap=style.CONCENTRATION)
        bar = self.figure.colorbar(colours, cax=axes, orientation="horizontal", ticks=[0, 1])
        bar.outline.set_visible(False)
        axes.set_xticklabels(["bare, c = 0", "coated, c = 1"], ha="center", size=9)
        axes.tick_params(length=0)

    def _draw_history(self):
        """The neck radius against what the run goes along; returns the line that marks the frame's place."""
        axes, history = self.history, self.run.history
        column = "neck_radius_nm" if np.isfinite(history["neck_radius_nm"]).any() else "bud_height_nm"
        axes.plot(self.along.values, history[column], color=style.ENGINE_COLOURS["boundary-integral"][0])
        axes.set_title(DRAWN[column].label)
        axes.set(xlabel=self.along.label, ylim=(0, None))
        if self.along.is_time:
            axes.set_xlim(self.times[0], self.times[-1])
        if early_budding(self.run) is not None:
            axes.set_xscale("log", nonpositive="mask")
            axes.set_xlim(LOG_START * early_budding(self.run), self.times[-1])
            axes.xaxis.set_major_formatter(plain_number)
        return axes.axvline(self.along.value(self.times[0]), color="#7A3E9D", linewidth=1.6)

    def frame(self, index):
        """Pixels (height, width, 4) of a frame, uint8."""
        time = self.times[index]
        shape = self.run.shape_at(time)
        axes = self.membrane
        axes.clear()
        draw_membrane(axes, shape, self.z_range, self.rim, line_width=4)
        axes.set(xlim=(-self.rim, self.rim), ylim=self.z_range, aspect="equal", xlabel="r (nm)", ylabel="z (nm)")
        axes.xaxis.set_major_formatter(distance)
        decimals = 3 if self.times[-1] < 10 or time < 1.5 * (early_budding(self.run) or 0) else 2
        decimals = max(decimals, 2 - int(np.floor(np.log10(self.times[-1]))))
        self.clock.set_text(self.along.quantity(time, f".{decimals}f" if self.along.is_time else ".4g"))
        neck = float(self.run.history_at("neck_radius_nm", time))
        self.neck.set_text(f"neck {neck:.1f} nm" if np.isfinite(neck) else "no neck")
        self.cursor.set_xdata([self.along.value(time)] * 2)
        self.figure.canvas.draw()
        return np.asarray(self.figure.canvas.buffer_rgba())

    def __len__(self):
        return len(self.times)


def write_film(film, output, fps):
    """Write a Film to output (Path), .mp4 or .gif; complete or not at all. Raises StudyError when ffmpeg does not do it."""
    ffmpeg = shutil.which("ffmpeg")
    if ffmpeg is None:
        raise StudyError("ffmpeg is not installed; install the Debian package ffmpeg", IO_FAILURE)
    output.parent.mkdir(parents=True, exist_ok=True)
    height, width, _ = film.frame(0).shape
    unfinished = output.with_name(f".{output.stem}.unfinished{output.suffix}")
    # "file:" keeps a colon or a dash in the name from meaning something to ffmpeg.
    pixels = ["-f", "rawvideo", "-pix_fmt", "rgba", "-s", f"{width}x{height}", "-r", str(fps), "-i", "-"]
    command = [ffmpeg, "-y", "-loglevel", "error", *pixels, *ENCODERS[output.suffix.lower()], f"file:{unfinished}"]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        for index in range(len(film)):
            process.stdin.write(film.frame(index).tobytes())
    except BrokenPipeError:
        pass  # ffmpeg says why below
    except BaseException:
        process.kill()
        process.communicate()
        unfinished.unlink(missing_ok=True)
        raise
    errors = process.communicate()[1].decode("utf-8", "replace")
    if process.returncode:
        unfinished.unlink(missing_ok=True)
        raise StudyError(f"ffmpeg: {last_word(errors) or f'exit code {process.returncode}'}", IO_FAILURE)
    unfinished.replace(output)
