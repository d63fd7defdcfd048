"""Surfaces of revolution for ParaView: polygons (.vtp) and a list of them with their times (.pvd)."""

import base64
import zlib

import numpy as np

from comparisons.files import write_text
from endoflow.curves import resample

#: Angle (degrees) between two meridians, and distance (nm) of a membrane's points along them.
ANGLE_STEP, SPACING = 5.0, 0.8

#: Bytes of one compressed block.
BLOCK = 1 << 15

KINDS = {"f4": "Float32", "i4": "Int32"}


class Revolved:
    """A curve r, z (n,) revolved about z by `angle` degrees. A full turn shares its first meridian.

    points: (m n, 3), meridian by meridian; quads: (k, 4) of their indices; azimuth: (m n,) in radians.
    """

    def __init__(self, r, z, angle=360):
        closed = angle == 360
        self._meridians = max(3, round(angle / ANGLE_STEP)) + (not closed)
        self.azimuth = np.repeat(np.radians(np.linspace(0, angle, self._meridians, endpoint=not closed)), len(r))
        self.points = self.vectors(r, z)
        first = np.arange(self._meridians if closed else self._meridians - 1)[:, None] * len(r) + np.arange(len(r) - 1)
        after = (first + len(r)) % (self._meridians * len(r))
        self.quads = np.stack((first, first + 1, after + 1, after), axis=-1).reshape(-1, 4)

    def around(self, values):
        """Values (n,) of the curve at all points (m n,)."""
        return np.tile(values, self._meridians)

    def vectors(self, radial, axial):
        """Vectors (m n, 3) from components (n,) in the plane of the meridian."""
        outward = np.column_stack((np.cos(self.azimuth), np.sin(self.azimuth)))
        return np.column_stack((outward * self.around(radial)[:, None], self.around(axial)))


def membrane_surface(shape, angle):
    """(points (n, 3), quads (m, 4), {array name: (n,) or (n, 3)}) of a Shape revolved about z by `angle` degrees.

    Names end in their unit.
    """
    fields = (shape.c, shape.lambda_, shape.kappa, shape.u_r, shape.u_z)
    r, z, c, tension, curvature, u_r, u_z = resample(shape.r, shape.z, SPACING, *fields)
    revolved = Revolved(r, z, angle)
    arrays = {"c": c, "tension_pN_per_nm": tension, "total_curvature_per_nm": curvature}
    values = {name: revolved.around(along) for name, along in arrays.items()}
    return revolved.points, revolved.quads, {**values, "velocity_nm_per_us": revolved.vectors(u_r, u_z)}


def write_surfaces(directory, collection, folder, surfaces):
    """Write surfaces, of (number, (time in µs, (points, quads, arrays))), as directory/folder/*.vtp and the list `collection`
    of them beside the folder; returns how many. directory: Path."""
    (directory / folder).mkdir(parents=True, exist_ok=True)
    entries = ""
    count = 0
    for count, (number, (time, surface)) in enumerate(surfaces, start=1):
        file = f"{folder}/membrane_{number:06d}.vtp"
        write_text(directory / file, polydata_text(*surface))
        entries += f'<DataSet timestep="{time:.12g}" group="" part="0" file="{file}"/>\n'
    head = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
    write_text(directory / collection, f"{head}<Collection>\n{entries}</Collection>\n</VTKFile>\n")
    return count


def data_array(name, values):
    """A <DataArray> of values (n,) or (n, components), float or integer, compressed."""
    values = np.asarray(values)
    kind = "i4" if values.dtype.kind == "i" else "f4"
    content = np.ascontiguousarray(values, dtype=f"<{kind}").tobytes()
    blocks = [content[i : i + BLOCK] for i in range(0, len(content), BLOCK)]
    packed = [zlib.compress(block) for block in blocks]
    sizes = [len(blocks), BLOCK, len(content) % BLOCK, *map(len, packed)]
    encoded = base64.b64encode(np.array(sizes, "<u4").tobytes()) + base64.b64encode(b"".join(packed))
    components = values.shape[1] if values.ndim > 1 else 1
    head = f'<DataArray type="{KINDS[kind]}" Name="{name}" NumberOfComponents="{components}" format="binary">'
    return f"{head}{encoded.decode('ascii')}</DataArray>\n"


def polydata_text(points, quads, arrays):
    """Text of a .vtp file: points (n, 3), quads (m, 4) of their indices, arrays {name: values at the points}."""
    fields = "".join(data_array(name, values) for name, values in arrays.items())
    offsets = 4 * np.arange(1, len(quads) + 1)
    return (
        '<?xml version="1.0"?>\n'
        '<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" compressor="vtkZLibDataCompressor">\n'
        f'<PolyData><Piece NumberOfPoints="{len(points)}" NumberOfPolys="{len(quads)}">\n'
        f"<PointData>\n{fields}</PointData>\n<Points>\n{data_array('points', points)}</Points>\n"
        f"<Polys>\n{data_array('connectivity', quads.reshape(-1))}{data_array('offsets', offsets)}</Polys>\n"
        "</Piece></PolyData>\n</VTKFile>\n"
    )
