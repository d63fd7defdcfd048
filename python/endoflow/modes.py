"""The directory of `endoflow modes`: growth rates, eigenshapes and what perturbations become."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Union

import numpy as np

from .arrays import Array
from .errors import RunDirectoryError
from .hdf5 import h5py
from .noise import Noise, rows_of

REMEDY = "repeat `endoflow modes`"


@dataclass(frozen=True)
class ModeShapes:
    """What belongs to one mode at one time; arrays (n,) along the meridian.

    growth: of the fastest eigenmode, 1/µs; w, c: its normal displacement (largest value 1 nm) and concentration;
    worst, worst_at_start: the displacement (nm) that has grown most by now, now and at the start, where its largest value is 0.1 nm.
    """

    growth: float
    w: Array
    c: Array
    worst: Array
    worst_at_start: Array


@dataclass(frozen=True)
class Meridian:
    """The axisymmetric membrane at `time` (µs): arrays (n,) from the axis to the rim, nm; the normal points into the cell."""

    time: float
    r: Array
    z: Array
    normal_r: Array
    normal_z: Array
    c: Array
    modes: dict[int, ModeShapes]


@dataclass(frozen=True)
class Modes:
    """All of a directory. times (n,) in µs; budding: µs or None.

    rates: {m: (n,) largest growth rate, 1/µs}; perturbations: {(m, initial shape): {"peak_nm", "rms_nm", "gain": (n,)}};
    noise: that of `--noise`, None without it.
    """

    directory: Path
    times: Array
    budding: float | None
    meridians: list[Meridian]
    rates: dict[int, Array]
    perturbations: dict[tuple[int, str], dict[str, Array]]
    noise: Noise | None = None

    @property
    def modes(self) -> list[int]:
        """The azimuthal modes, increasing."""
        return sorted(self.rates)

    @property
    def initial_shapes(self) -> list[str]:
        """Names of the initial shapes, in the order of the file."""
        return list(dict.fromkeys(initial for _, initial in self.perturbations))

    @property
    def last_index(self) -> int:
        """Index of the time of budding, of the last time without one."""
        return len(self.times) - 1 if self.budding is None else int(np.argmin(np.abs(self.times - self.budding)))


def load_modes(directory: Union[str, Path]) -> Modes:
    """Read the directory (path) of `endoflow modes` as Modes. Raises RunDirectoryError."""
    directory = Path(directory)
    try:
        with h5py.File(directory / "eigenshapes.h5", "r") as file:
            times = file["times"]
            budding = times.attrs.get("budding_us")
            meridians = sorted((_meridian(group) for group in times.values()), key=lambda meridian: meridian.time)
        spectrum = rows_of(directory / "modes.csv")
        followed = rows_of(directory / "perturbations.csv")
        rates: dict[int, list[float]] = {}
        perturbations: dict[tuple[int, str], dict[str, list[float]]] = {}
        for row in spectrum:
            if row["rank"] == "0":
                rates.setdefault(int(row["mode"]), []).append(float(row["growth_per_us"]))
        for row in followed:
            entry = perturbations.setdefault((int(row["mode"]), row["initial"]), {})
            for name in ("peak_nm", "rms_nm", "gain"):
                entry.setdefault(name, []).append(float(row[name] or "nan"))
        noise = Noise.read(directory)
    except (OSError, KeyError, ValueError) as error:
        reason = str(error).splitlines()[0]
        raise RunDirectoryError(directory, f"holds no modes of a run ({reason})", REMEDY) from None
    if not meridians:
        raise RunDirectoryError(directory, "holds no time", REMEDY)
    return Modes(
        directory,
        np.array([meridian.time for meridian in meridians]),
        None if budding is None else float(budding),
        meridians,
        {mode: np.array(values) for mode, values in rates.items()},
        {key: {name: np.array(v) for name, v in entry.items()} for key, entry in perturbations.items()},
        noise,
    )


def _meridian(group: h5py.Group) -> Meridian:
    modes = {}
    for name, mode in group.items():
        if name.startswith("mode_"):
            arrays = (mode[key][:] for key in ("w", "c", "worst", "worst_at_start"))
            modes[int(name.removeprefix("mode_"))] = ModeShapes(float(mode.attrs["growth_per_us"]), *arrays)
    base = {key: group[key][:] for key in ("r", "z", "normal_r", "normal_z", "c")}
    return Meridian(time=float(group.attrs["time"]), **base, modes=modes)
