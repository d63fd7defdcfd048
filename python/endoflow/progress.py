"""How far a run is, as a bar in a notebook or a line in a terminal; nothing where neither is there."""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path
from typing import Any

from .history import time_reached

#: Letters of the bar in a terminal.
WIDTH = 40


class Progress:
    """Calling it looks at a run's directory and draws its simulated time over its end."""

    def __init__(self, directory: Path, shown: bool = True):
        self.directory, self.fraction, self.drawn = directory, 0.0, -1.0
        self._handle: Any = None
        self._draw = None if not shown else self._in_notebook if _notebook() else self._in_terminal
        if self._draw == self._in_terminal and not sys.stderr.isatty():
            self._draw = None

    def __call__(self) -> None:
        reached, end = _reached(self.directory)
        self.fraction = min(1.0, reached / end) if end > 0 else 0.0
        if self._draw is not None and abs(self.fraction - self.drawn) > 1e-3:
            self.drawn = self.fraction
            self._draw(f"{reached:.4g} of {end:.4g} µs")

    def close(self) -> None:
        """End the line in a terminal."""
        if self._draw == self._in_terminal and self.drawn >= 0:
            print(file=sys.stderr)

    def _in_terminal(self, text: str) -> None:
        done = round(WIDTH * self.fraction)
        print(f"\r[{'=' * done}{' ' * (WIDTH - done)}] {text:<24}", end="", file=sys.stderr, flush=True)

    def _in_notebook(self, text: str) -> None:
        ipython: Any = importlib.import_module("IPython.display")  # some versions of it are typed, some are not
        bar = ipython.HTML(f'<progress max="1" value="{self.fraction:.4f}" style="width: 20em"></progress> {text}')
        if self._handle is None:
            self._handle = ipython.display(bar, display_id=True)
        else:
            self._handle.update(bar)


def _notebook() -> bool:
    """Whether a Jupyter kernel runs this."""
    shell = sys.modules.get("IPython")
    return shell is not None and type(shell.get_ipython()).__name__ == "ZMQInteractiveShell"


def _reached(directory: Path) -> tuple[float, float]:
    """(time of the last complete row of history.csv, time.end) in µs; zeros while there is none."""
    try:
        end = float(json.loads((directory / "run.json").read_text(encoding="utf-8"))["parameters"]["time"]["end"])
    except (OSError, ValueError, KeyError):
        return 0.0, 0.0
    return time_reached(directory / "history.csv"), end
