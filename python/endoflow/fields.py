"""fields.pvd and fields/*.vtu: what ParaView shows, as numpy arrays. Needs no VTK."""

from __future__ import annotations

import base64
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

from .arrays import Array
from .errors import RERUN, RunDirectoryError

#: Number types of a .vtu file as numpy writes them, little-endian.
KINDS = {
    "Float32": "<f4",
    "Float64": "<f8",
    "Int32": "<i4",
    "Int64": "<i8",
    "UInt8": "u1",
    "UInt32": "<u4",
    "UInt64": "<u8",
}


@dataclass(frozen=True)
class Fields:
    """Fields at `time` (µs): points r, z (n,) in nm; arrays {name: (n,) or (n, 3)}, vectors as (r, z, 0)."""

    time: float
    r: Array
    z: Array
    arrays: dict[str, npt.NDArray[Any]]

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return self.arrays[name]


def field_files(directory: Path) -> list[tuple[float, Path]]:
    """[(time in µs, file)] of a run's fields.pvd, in order; empty when the run wrote none."""
    index = directory / "fields.pvd"
    if not index.exists():
        return []
    try:
        entries = ElementTree.parse(index).getroot().iter("DataSet")
        return [(float(entry.attrib["timestep"]), directory / entry.attrib["file"]) for entry in entries]
    except (OSError, ElementTree.ParseError, KeyError, ValueError) as error:
        raise RunDirectoryError(index, f"cannot be read ({error})", RERUN) from None


def read_fields(time: float, path: Path) -> Fields:
    """Fields of a .vtu file (Path) that holds one piece. Raises RunDirectoryError."""
    try:
        root = ElementTree.parse(path).getroot()
        points = _array(root, _child(root, ".//Points/DataArray"))
        arrays = {entry.attrib["Name"]: _array(root, entry) for entry in _child(root, ".//PointData")}
    except (OSError, ElementTree.ParseError, KeyError, ValueError, zlib.error) as error:
        raise RunDirectoryError(path, f"cannot be read as a VTK file ({error})", RERUN) from None
    return Fields(time, points[:, 0], points[:, 1], arrays)


def _child(root: ElementTree.Element, path: str) -> ElementTree.Element:
    """The first element below root at an XPath. Raises KeyError without one."""
    found = root.find(path)
    if found is None:
        raise KeyError(path)
    return found


def _array(root: ElementTree.Element, entry: ElementTree.Element) -> npt.NDArray[Any]:
    """A <DataArray> as an array (n,) or (n, components): text, or base64 with or without zlib."""
    kind, text = np.dtype(KINDS[entry.attrib["type"]]), (entry.text or "").strip()
    if entry.attrib["format"] == "ascii":
        values = np.array(text.split(), dtype=kind)
    elif entry.attrib["format"] == "binary":
        header = np.dtype(KINDS[root.attrib.get("header_type", "UInt32")])
        content = _inflated(text, header) if "compressor" in root.attrib else _plain(text, header)
        values = np.frombuffer(content, kind)
    else:
        raise ValueError(f"format {entry.attrib['format']}")
    components = int(entry.attrib.get("NumberOfComponents", 1))
    return values.reshape(-1, components) if components > 1 else values


def _plain(text: str, header: np.dtype[Any]) -> bytes:
    """Bytes behind the length that begins them."""
    return base64.b64decode(text)[header.itemsize :]


def _inflated(text: str, header: np.dtype[Any]) -> bytes:
    """Bytes of compressed blocks: their number, the size of all but the last, of the last, and each one's packed size."""
    count = int(np.frombuffer(base64.b64decode(text[:24])[: header.itemsize], header)[0])
    size = header.itemsize * (3 + count)
    encoded = 4 * -(-size // 3)
    packed = np.frombuffer(base64.b64decode(text[:encoded])[:size], header)[3:]
    blocks = base64.b64decode(text[encoded:])
    ends = np.cumsum(packed)
    return b"".join(zlib.decompress(blocks[end - length : end]) for length, end in zip(packed, ends))
