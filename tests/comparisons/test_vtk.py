"""Every file for ParaView read back with VTK: fields of both engines, and the revolved membrane.

    ENDOFLOW_PROGRAM=build/endoflow python3 tests/comparisons/test_vtk.py
"""

import unittest
import xml.etree.ElementTree as ElementTree

import locations  # noqa: F401
import numpy as np
import endoflow
import synthetic
from command import call
from engines import tiny_run
from scratch import scratch_directory

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkMassProperties, vtkTriangleFilter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
except ImportError:
    vtk_to_numpy = None

#: Arrays of both engines: number of components, and the range each value must lie in.
COMMON = {"velocity": (3, (-1e4, 1e4)), "pressure": (1, (-1e3, 1e3)), "phi": (1, (-1.1, 1.1))}
DIFFUSE = {
    **COMMON,
    **dict.fromkeys(("lambda", "chemical_potential"), (1, (-1e3, 1e3))),
    "c": (1, (-0.2, 1.2)),
}

#: Arrays of one scheme of the phase field. The moment of the flat coat is β |κ − C| = 600 pN nm times 0.1418 / nm = 85.1 pN;
#: scheme paper's is smeared over the layer, and so is its stretching far from the membrane.
PRODUCTION = {"distance": (1, (-81, 81)), "moment": (1, (-5, 86)), "stretching": (1, (0.9, 1.2))}
PAPER = {"bending_moment": (1, (-5, 86)), "stretching": (1, (0, 2))}

#: Fields are written at 0 and at both later times, µs.
END, INTERVAL = 2e-4, 1e-4


def collection(path):
    """[(time, file)] of a .pvd file (Path)."""
    entries = ElementTree.parse(path).getroot().iter("DataSet")
    return [(float(entry.get("timestep")), path.parent / entry.get("file")) for entry in entries]


def read(reader, path):
    """(VTK object, {name: array}) of a file (Path)."""
    reader.SetFileName(str(path))
    reader.Update()
    found = reader.GetOutput()
    data = found.GetPointData()
    return found, {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


@unittest.skipIf(vtk_to_numpy is None, "VTK is not installed (Debian package python3-vtk9)")
class Fields(unittest.TestCase):
    def check(self, engine, wanted):
        output = tiny_run(self, engine, f"time.end={END}", f"output.field_interval={INTERVAL}")
        entries = collection(output / "fields.pvd")
        np.testing.assert_allclose([time for time, _ in entries], [0, INTERVAL, END], rtol=1e-9)
        self.assertEqual(sorted(file for _, file in entries), sorted((output / "fields").glob("*.vtu")))
        for time, file in entries:
            grid, arrays = read(vtkXMLUnstructuredGridReader(), file)
            self.assertGreater(grid.GetNumberOfCells(), 100)
            np.testing.assert_allclose(grid.GetBounds(), (0, 80, 0, 160, 0, 0), atol=1e-9)
            for name, (components, (low, high)) in wanted.items():
                values = arrays[name].reshape(grid.GetNumberOfPoints(), -1)
                self.assertEqual(values.shape[1], components, name)
                self.assertTrue(np.isfinite(values).all() and low <= values.min() <= values.max() <= high, name)
            points = vtk_to_numpy(grid.GetPoints().GetData())
            self.assertTrue((arrays["phi"][points[:, 1] < 60] > 0).all(), "extracellular fluid, φ = 1, is below")
            self.assertTrue((arrays["phi"][points[:, 1] > 100] < 0).all())
            np.testing.assert_allclose(arrays["velocity"][points[:, 0] == 0, 0], 0, atol=1e-6, err_msg="axis")
            own = endoflow.load(output).fields_at(time)
            np.testing.assert_array_equal(np.column_stack((own.r, own.z)), points[:, :2])
            for name, values in arrays.items():
                np.testing.assert_array_equal(own[name], values, err_msg=f"our reader and VTK: {name}")
            if time == END:
                self.assertGreater(np.abs(arrays["velocity"]).max(), 1.0, "the membrane moves at once")
                self.check_contour(grid)

    def check_contour(self, grid):
        """What a user does first, a contour at φ = 0: it lies at the membrane, still almost flat, from axis to wall."""
        contour = vtkContourFilter()
        contour.SetInputData(grid)
        contour.SetInputArrayToProcess(0, 0, 0, 0, "phi")
        contour.SetValue(0, 0.0)
        contour.Update()
        left, right, low, high, _, _ = contour.GetOutput().GetBounds()
        self.assertEqual((left, right), (0, 80))
        # The bud is less than 1 nm high; the sharp engine's φ jumps within one square of 8 nm.
        self.assertTrue(75 < low <= high < 85, (low, high))

    def test_boundary_integral(self):
        self.check("boundary-integral", COMMON)

    def test_phase_field(self):
        self.check("phase-field", {**DIFFUSE, **PRODUCTION})

    def test_phase_field_scheme_paper(self):
        self.check("phase-field,paper", {**DIFFUSE, **PAPER})


@unittest.skipIf(vtk_to_numpy is None, "VTK is not installed (Debian package python3-vtk9)")
class RevolvedMembrane(unittest.TestCase):
    def setUp(self):
        self.run_, _ = synthetic.write_pair(scratch_directory(self), count=5)

    def revolve(self, *arguments):
        return call("revolve", self.run_, *arguments)

    def test_surface(self):
        for angle in (360, 90):
            process = self.revolve("--angle", angle)
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            entries = collection(self.run_ / "membrane.pvd")
            np.testing.assert_allclose([time for time, _ in entries], [0, 0.25, 0.5, 0.75, 1])
            for time, file in entries:
                membrane = synthetic.budding_membrane(time, 1.0)
                surface, arrays = read(vtkXMLPolyDataReader(), file)
                triangles, mass = vtkTriangleFilter(), vtkMassProperties()
                triangles.SetInputData(surface)
                mass.SetInputConnection(triangles.GetOutputPort())
                mass.Update()
                # Chords of 5°: the inscribed surface is smaller by (1 − cos 2.5°) at most, and the curve's points add 1e-4.
                self.assertAlmostEqual(mass.GetSurfaceArea() / (membrane.area * angle / 360), 1, delta=1.5e-3)
                self.assertAlmostEqual(surface.GetBounds()[5] - membrane.z0, membrane.bud_height, delta=1e-3)
                points = vtk_to_numpy(surface.GetPoints().GetData())
                c = synthetic.concentration(*membrane.curve(2000)[:2])
                self.assertAlmostEqual(float(arrays["c"].max()), float(c.max()), delta=1e-3)
                velocity = arrays["velocity_nm_per_us"]
                swirl = points[:, 0] * velocity[:, 1] - points[:, 1] * velocity[:, 0]
                np.testing.assert_allclose(swirl, 0, atol=1e-3 * np.abs(velocity).max() * 80)
                for name in ("tension_pN_per_nm", "total_curvature_per_nm"):
                    self.assertEqual(arrays[name].shape, (surface.GetNumberOfPoints(),))

    def test_fewer_times_and_bad_angle(self):
        self.assertEqual(self.revolve("--most", 2).returncode, 0)
        self.assertEqual([time for time, _ in collection(self.run_ / "membrane.pvd")], [0, 1])
        self.assertEqual(self.revolve("--angle", 400).returncode, 2)


if __name__ == "__main__":
    unittest.main()
