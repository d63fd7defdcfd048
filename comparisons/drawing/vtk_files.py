"""Files for ParaView: polygons (.vtp) and a list of files with their times (.pvd)."""

import base64
import zlib

import numpy as np

from comparisons.files import write_text

#: Bytes of one compressed block.
BLOCK = 1 << 15

KINDS = {"f4": "Float32", "i4": "Int32"}


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


def write_collection(path, entries):
    """Write a .pvd file (Path) of [(time in µs, file relative to it)]."""
    lines = "".join(f'<DataSet timestep="{time:.12g}" group="" part="0" file="{file}"/>\n' for time, file in entries)
    head = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
    write_text(path, f"{head}<Collection>\n{lines}</Collection>\n</VTKFile>\n")
