"""Two runs' membranes as one: run A in the left, run B in the right half-planes, as a picture of four moments and as a film."""

import numpy as np
from PIL import Image

from comparisons.drawing import plots, style
from comparisons.drawing.axes import half_width, vertical_range
from comparisons.drawing.style import plt
from comparisons.measures.metrics import common_times

#: Moments of the picture, as fractions of the later budding time (or of the common time when no run buds).
MOMENTS = (0.02, 0.15, 0.5, 1.0)

#: Most of half the width (nm) that is shown: of a wide flat membrane the part further out is left away.
HALF_WIDTH = 56.0

#: Letters of a label that fit into half a picture at the full size.
LETTERS = 18

#: Colour of what is neither membrane nor run.
INK = "#333333"

#: The film: pixels of its width, frames, milliseconds of each and of the last one, and how early ones crowd (times ∝ index^PACE).
WIDTH, FRAMES, DURATION, HOLD, PACE = 720, 90, 70, 1800, 1.6

#: Dots per inch of the film.
FILM_DOTS = 120


def last_moment(a, b):
    """Time (µs) of the later budding of two endoflow.Run objects, or of the last common shape when no run buds by then."""
    end = common_times(a, b)[-1]
    budding = [run.event_time("budding") for run in (a, b)]
    return min(end, max((time for time in budding if time is not None), default=end))


class Frame:
    """How both membranes are drawn at any time: the extent and the colours of two endoflow.Run objects."""

    def __init__(self, a, b, times):
        self.runs = a, b
        self.labels = style.labels(a, b)
        self.colours = [light for light, _ in style.colours(a, b)]
        shapes = [run.shape_at(time) for time in times for run in self.runs]
        self.z_range, self.rim = vertical_range(shapes, 7.0), min(HALF_WIDTH, half_width(shapes))

    def height_of(self, width):
        """Height of axes of this width, in the same unit."""
        return width * (self.z_range[1] - self.z_range[0]) / (2 * self.rim)

    def draw(self, axes, time, line_width):
        """Both membranes and the time (µs); returns the coloured lines."""
        pair = [run.shape_at(time) for run in self.runs]
        lines = plots.draw_pair(axes, pair, self.colours, self.z_range, self.rim, line_width)
        axes.tick_params(labelsize=11, colors=INK, length=3)
        axes.text(
            0.03, 0.95, f"{time:.2f} µs", transform=axes.transAxes, va="top", size=15, weight="bold", color=INK, zorder=6
        )
        return lines

    def title(self, figure, x, y):
        """Which half is which run's, around a point (fractions of the figure's width and height)."""
        left, right = self.labels
        how = {"va": "center", "size": 15 * min(1, LETTERS / max(map(len, self.labels))), "weight": "bold"}
        figure.text(x - 0.01, y, f"{left} ◀", ha="right", color=self.colours[0], **how)
        figure.text(x + 0.01, y, f"▶ {right}", ha="left", color=self.colours[1], **how)

    def colour_bar(self, figure, lines, place):
        """What the colours mean; place: left, bottom, width, height as fractions of the figure's."""
        bar = figure.colorbar(lines, cax=figure.add_axes(place), ticks=[0, 1], orientation="horizontal")
        bar.outline.set_visible(False)
        bar.ax.set_xticklabels(["bare, c = 0", "coated, c = 1"], size=12, color=INK)
        bar.ax.tick_params(length=0)


def picture(a, b):
    """The figure of four moments of two endoflow.Run objects."""
    last, first = last_moment(a, b), common_times(a, b)[0]
    times = [max(first, fraction * last) for fraction in MOMENTS]
    frame = Frame(a, b, times)
    width, left, gap, top, bottom = 7.2, 0.72, 0.16, 0.5, 1.2
    panel = (width - left - 0.1 - gap) / 2
    height = top + bottom + gap + 2 * frame.height_of(panel)
    figure, grid = plt.subplots(2, 2, figsize=(width, height), sharex=True, sharey=True)
    figure.subplots_adjust(
        left=left / width,
        right=1 - 0.1 / width,
        bottom=bottom / height,
        top=1 - top / height,
        wspace=gap / panel,
        hspace=gap / frame.height_of(panel),
    )
    for axes, time in zip(grid.flat, times):
        lines = frame.draw(axes, time, line_width=4)
    for axes in grid[:, 0]:
        axes.set_ylabel("z (nm)", size=13, color=INK)
    for axes in grid[-1]:
        axes.set_xlabel("r (nm)", size=13, color=INK)
    middle = (left + panel + 0.5 * gap) / width
    frame.title(figure, middle, 1 - 0.5 * top / height)
    frame.colour_bar(figure, lines, [middle - 0.2, 0.36 / height, 0.4, 0.09 / height])
    return figure


def film(a, b):
    """The frames (PIL images) of two endoflow.Run objects, from the first common time to the later budding."""
    first, last = common_times(a, b)[0], last_moment(a, b)
    times = first + (last - first) * np.linspace(0, 1, FRAMES) ** PACE
    frame = Frame(a, b, times[:: FRAMES // 10])
    width, left, top, bottom = WIDTH / FILM_DOTS, 0.68, 0.42, 0.98
    panel = width - left - 0.12
    height = 2 * round((top + bottom + frame.height_of(panel)) * FILM_DOTS / 2) / FILM_DOTS
    figure = plt.figure(figsize=(width, height), dpi=FILM_DOTS)
    axes = figure.add_axes([left / width, bottom / height, panel / width, 1 - (top + bottom) / height])
    middle = (left + 0.5 * panel) / width
    frame.title(figure, middle, 1 - 0.5 * top / height)
    images = []
    for time in times:
        axes.clear()
        lines = frame.draw(axes, time, line_width=4.5)
        axes.set_xlabel("r (nm)", size=12, color=INK)
        axes.set_ylabel("z (nm)", size=12, color=INK)
        if not images:
            frame.colour_bar(figure, lines, [middle - 0.2, 0.32 / height, 0.4, 0.08 / height])
        figure.canvas.draw()
        images.append(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3].copy()))
    plt.close(figure)
    return images


def write_film(images, path):
    """Write the frames of film() to a file (Path) that browsers play again and again, .webp or .gif."""
    durations = [DURATION] * (len(images) - 1) + [HOLD]
    images[0].save(path, save_all=True, append_images=images[1:], duration=durations, loop=0, quality=80, method=4)
