"""Thermal noise about a run, as `endoflow modes --noise` writes it."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .arrays import Array
from .hdf5 import h5py


@dataclass(frozen=True)
class Axisymmetric:
    """The axisymmetric membrane at `time` (µs): arrays (n,) from the axis to the rim, nm; the normal points into the cell."""

    time: float
    r: Array
    z: Array
    normal_r: Array
    normal_z: Array

    @staticmethod
    def read(group: h5py.Group) -> dict[str, Any]:
        """The members as a group of eigenshapes.h5 or noise.h5 has them."""
        arrays = {key: group[key][:] for key in ("r", "z", "normal_r", "normal_z")}
        return {"time": float(group.attrs["time"]), **arrays}


@dataclass(frozen=True)
class NoisyMeridian(Axisymmetric):
    """The membrane with its noise.

    rms: {m: (n,) standard deviation of the displacement along the normal by mode m, nm}; inherited: the part that
    fluctuations of the start have left. Variances of the modes add up.
    """

    rms: dict[int, Array]
    inherited: dict[int, Array]

    @property
    def total(self) -> Array:
        """(n,) standard deviation by all modes, nm."""
        return np.sqrt(sum(rms**2 for rms in self.rms.values()))


@dataclass(frozen=True)
class Noise:
    """Spreads are standard deviations at `temperature` (K); those of a neck are nan where there is none.

    table: columns of noise.csv, (n,) each; modes: {m: {"rms_nm", "inherited_nm": (n,)}}, over the membrane.
    budding, its spread, and until when noise is small enough for linear equations: µs or None.
    ensemble: columns of noise_ensemble.csv, (n,) each; None without `--ensemble`.
    """

    temperature: float
    times: Array
    table: dict[str, Array]
    modes: dict[int, dict[str, Array]]
    meridians: list[NoisyMeridian]
    budding: float | None
    budding_spread: float | None
    linear_until: float | None
    ensemble: dict[str, Array] | None = None

    @property
    def last_index(self) -> int:
        """Index of the time of budding, of the last time without one."""
        return index_of_end(self.times, self.budding)

    @classmethod
    def read(cls, directory: Path) -> Noise | None:
        """That of a directory (path), None where there is none. Raises OSError, KeyError, ValueError."""
        if not (directory / "noise.json").is_file():
            return None
        record = json.loads((directory / "noise.json").read_text("utf-8"))
        table, members = _columns(directory / "noise.csv"), directory / "noise_ensemble.csv"
        modes: dict[int, dict[str, list[float]]] = {}
        for row in rows_of(directory / "noise_modes.csv"):
            entry = modes.setdefault(int(row["mode"]), {})
            for name in ("rms_nm", "inherited_nm"):
                entry.setdefault(name, []).append(float(row[name]))
        with h5py.File(directory / "noise.h5", "r") as file:
            meridians = [_meridian(file["times"][name]) for name in sorted(file["times"])]
        return cls(
            record["temperature_K"],
            table["time_us"],
            table,
            {mode: {name: np.array(v) for name, v in entry.items()} for mode, entry in modes.items()},
            meridians,
            record["budding_us"],
            record["budding_spread_us"],
            record["linear_until_us"],
            _columns(members) if members.is_file() else None,
        )


def index_of_end(times: Array, budding: float | None) -> int:
    """Index of the time nearest to budding; of the last one without."""
    return len(times) - 1 if budding is None else int(np.argmin(np.abs(times - budding)))


def rows_of(path: Path) -> list[dict[str, str]]:
    """The rows of a CSV file (path) with a header."""
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def _columns(path: Path) -> dict[str, Array]:
    rows = rows_of(path)
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0]}


def _meridian(group: h5py.Group) -> NoisyMeridian:
    def of(kind: str) -> dict[int, Array]:
        return {int(name.split("_")[1]): group[name][:] for name in sorted(group) if name.startswith(kind)}

    return NoisyMeridian(**Axisymmetric.read(group), rms=of("rms_"), inherited=of("inherited_"))
