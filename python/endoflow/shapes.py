"""shapes.h5: the membrane curve, axis to rim, at each output time."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .arrays import Array
from .curves import closed_label, equivalent_radius, local_cubic
from .errors import RERUN, RunDirectoryError
from .hdf5 import h5py

#: Datasets of each group /shapes/NNNNNN. The attribute of Shape has the same name, `lambda_` for `lambda`.
FIELDS = ("s", "r", "z", "c", "lambda", "kappa", "u_r", "u_z")


@dataclass(frozen=True)
class Shape:
    """A membrane curve: arrays of one length (n,), ordered from the axis to the rim, at `time` (µs).

    The curve of a closed vesicle goes from its upper pole to the lower one, `closed` says so.

    s: arc length from the axis (nm), r, z: position (nm), c: molecule concentration (0…1),
    lambda_: sharp tension (pN/nm), kappa: total curvature (1/nm), u_r, u_z: velocity (nm/µs).
    """

    time: float
    s: Array
    r: Array
    z: Array
    c: Array
    lambda_: Array
    kappa: Array
    u_r: Array
    u_z: Array

    def __getitem__(self, field: str) -> Array:
        """The array of a dataset name, e.g. shape["lambda"]."""
        if field not in FIELDS:
            raise KeyError(field)
        return getattr(self, _attribute(field))

    def __len__(self) -> int:
        return len(self.r)

    @property
    def closed(self) -> bool:
        """Whether the curve ends on the axis again."""
        return bool(self.r[-1] <= 1e-9 * self.r.max())


def _attribute(field: str) -> str:
    return "lambda_" if field == "lambda" else field


def read_shapes(path: Path) -> list[Shape]:
    """Read every shape of a shapes.h5, in order of time, as a list of Shape.

    Raises RunDirectoryError when the file is missing, damaged, empty, or a curve is inconsistent.
    """
    if not path.is_file():
        raise RunDirectoryError(path, "the file is missing", RERUN)
    try:
        with h5py.File(path, "r") as file:
            if "shapes" not in file:
                raise RunDirectoryError(path, "has no group /shapes", "is this a file of `endoflow run`?")
            shapes = [_read_shape(path, group) for group in file["shapes"].values()]
    except (OSError, RuntimeError, KeyError, ValueError, TypeError) as error:  # h5py's names for damage
        reason = str(error).strip("'\"").splitlines()[0]
        raise RunDirectoryError(
            path, f"cannot be read as HDF5 ({reason})", f"wait until the run has ended, or {RERUN}"
        ) from None
    if not shapes:
        raise RunDirectoryError(path, "holds no shape", RERUN)
    return sorted(shapes, key=lambda shape: shape.time)


def _read_shape(path: Path, group: h5py.Group) -> Shape:
    """One group /shapes/NNNNNN as a Shape, after checking it."""
    missing = [name for name in FIELDS if name not in group]
    if missing:
        raise RunDirectoryError(path, f"{group.name} lacks {', '.join(missing)}", RERUN)
    if "time" not in group.attrs:
        raise RunDirectoryError(path, f"{group.name} has no attribute `time`", RERUN)
    arrays = {name: np.asarray(group[name], dtype=float) for name in FIELDS}
    sizes = {array.shape for array in arrays.values()}
    if len(sizes) > 1 or arrays["r"].ndim != 1 or arrays["r"].size < 3:
        found = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise RunDirectoryError(
            path, f"{group.name}: a curve needs 3 or more points and equal lengths, found {found}", RERUN
        )
    broken = [name for name, array in arrays.items() if not np.isfinite(array).all()]
    if broken:
        raise RunDirectoryError(path, f"{group.name}: {', '.join(broken)} holds values that are not numbers", RERUN)
    if abs(arrays["r"][0]) > 0.05 * abs(arrays["r"][-1]):
        raise RunDirectoryError(path, f"{group.name}: the curve does not run from the axis to the rim", RERUN)
    time = float(np.asarray(group.attrs["time"]).reshape(-1)[0])
    return Shape(time, **{_attribute(name): array for name, array in arrays.items()})


def between(first: Shape, second: Shape, time: float) -> Shape:
    """The membrane at `time` (µs), first.time <= time <= second.time, as a Shape: linear in time at fixed material points.

    Material points are labelled by the area between them and the axis, which an inextensible membrane conserves. Membrane that
    enters at the rim between the two times comes from a flat continuation outside; the result ends at the rim again.
    """
    weight = (time - first.time) / (second.time - first.time)
    if first.closed and second.closed:
        return _between_closed(first, second, weight, time)
    label = np.union1d(equivalent_radius(first.r, first.z), equivalent_radius(second.r, second.z))
    label = label[np.append(True, np.diff(label) > 1e-6)]
    a, b = _continued(first, label), _continued(second, label)
    mixed = {name: (1 - weight) * a[name] + weight * b[name] for name in FIELDS}
    rim = (1 - weight) * first.r[-1] + weight * second.r[-1]
    return Shape(time, **{_attribute(name): array for name, array in _cut_at(mixed, rim).items()})


def _between_closed(first: Shape, second: Shape, weight: float, time: float) -> Shape:
    """between() for closed curves: at equal fractions of the area, through a label that is smooth at both poles."""
    labels = [closed_label(shape.r, shape.z) for shape in (first, second)]
    label = np.union1d(*labels)
    label = label[np.append(True, np.diff(label) > 1e-9)]
    mixed = {}
    for name in FIELDS:
        smooth = local_cubic if name in ("r", "z") else _linear
        a, b = (smooth(own, shape[name], label) for own, shape in zip(labels, (first, second)))
        mixed[name] = (1 - weight) * a + weight * b
    return Shape(time, **{_attribute(name): array for name, array in mixed.items()})


def _linear(x: Array, y: Array, x_new: Array) -> Array:
    return np.interp(x_new, x, y)


def _continued(shape: Shape, label: Array) -> dict[str, Array]:
    """Every field of `shape` at the material labels (m,) in nm, with a flat continuation beyond the rim."""
    own = equivalent_radius(shape.r, shape.z)
    outside = label > own[-1]
    fields = {name: np.interp(label, own, shape[name]) for name in FIELDS}
    for name in ("r", "z"):
        fields[name] = np.where(outside, shape[name][-1], local_cubic(own, shape[name], label))
    fields["r"][outside] = np.sqrt(shape.r[-1] ** 2 + label[outside] ** 2 - own[-1] ** 2)
    return fields


def _cut_at(fields: dict[str, Array], rim: float) -> dict[str, Array]:
    """Fields of a curve that crosses r = rim (nm) near its end, cut there by interpolation."""
    r = fields["r"]
    inside = np.nonzero(r < rim - 1e-9)[0]
    last = inside[-1]
    if last + 1 == len(r):
        return {**fields, "r": np.append(r[:-1], rim)}
    part = (rim - r[last]) / (r[last + 1] - r[last])
    return {name: np.append(v[: last + 1], v[last] + part * (v[last + 1] - v[last])) for name, v in fields.items()}
