"""endoflow.load: contents of a run, interpolation between shapes, and a clear error for every kind of damage."""

import json
import tempfile
import unittest
from pathlib import Path

import locations  # noqa: F401
import h5py
import numpy as np
from scratch import scratch_directory

import endoflow
import synthetic
from endoflow.curves import area_from_axis, equivalent_radius, local_cubic, resample
from endoflow.history import interpolated, unit_of
from endoflow.shapes import Shape, between


class Curves(unittest.TestCase):
    def test_area_of_a_sphere(self):
        angle = np.linspace(0, np.pi, 1001)
        area = area_from_axis(20 * np.sin(angle), 20 * np.cos(angle))
        # Frusta inscribed in a sphere miss the fraction h²/(8 radius²) at most; h = 20 π/1000.
        self.assertAlmostEqual(area[-1] / (4 * np.pi * 400), 1, delta=(np.pi / 1000) ** 2 / 8)

    def test_local_cubic_is_third_order(self):
        at = np.linspace(0.1, 2.9, 777)
        errors = []
        for count in (20, 40, 80):
            x = np.linspace(0, 3, count + 1)
            errors.append(np.abs(local_cubic(x, np.sin(x), at) - np.sin(at)).max())
        orders = np.log2(np.array(errors[:-1]) / errors[1:])
        self.assertGreater(orders.min(), 2.8)

    def test_local_cubic_reproduces_a_parabola(self):
        x = np.array([0, 0.3, 1.0, 1.1, 2.0])
        at = np.linspace(0, 2, 50)
        np.testing.assert_allclose(local_cubic(x, x**2 - x, at), at**2 - at, atol=1e-14)

    def test_resampling_keeps_ends_and_spacing(self):
        r, z, _ = synthetic.budding_membrane(0.6, 1.0).curve(300)
        fine_r, fine_z, c = resample(r, z, 0.2, synthetic.concentration(r, z))
        self.assertEqual((fine_r[0], fine_z[0], fine_r[-1], fine_z[-1]), (r[0], z[0], r[-1], z[-1]))
        self.assertEqual(len(c), len(fine_r))
        self.assertLess(np.hypot(np.diff(fine_r), np.diff(fine_z)).max(), 0.201)


class LoadedRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        times = np.linspace(0, 1, 11)
        directory = synthetic.write_run(
            scratch_directory(cls) / "run", "boundary-integral", lambda t: synthetic.budding_membrane(t, 1.0), times
        )
        cls.run_ = endoflow.load(directory)

    def test_contents(self):
        run = self.run_
        self.assertEqual(run.engine, "boundary-integral")
        self.assertEqual(run.parameters["molecules"]["patch_radius"], 36)
        self.assertEqual(len(run.shapes), 11)
        self.assertEqual(run.history["time_us"].shape, (201,))
        self.assertEqual(run.shapes[3]["lambda"][0], run.shapes[3].lambda_[0])
        np.testing.assert_allclose(run.shape_times, np.linspace(0, 1, 11))
        self.assertTrue(0.5 < run.event_time("budding") < 1)
        self.assertIsNone(run.event_time("never"))

    def test_empty_cells_are_nan(self):
        neck = self.run_.history["neck_radius_nm"]
        self.assertTrue(np.isnan(neck[0]))
        self.assertFalse(np.isnan(neck[-1]))
        self.assertTrue(np.isnan(self.run_.history_at("neck_radius_nm", 0.0)))

    def test_between_rows_a_history_is_of_third_order_and_overshoots_nowhere(self):
        errors = []
        for rows in (21, 41):  # uneven steps, sin without its extremum
            times = np.linspace(0, 1, rows) ** 2
            at = np.linspace(0.05, 0.9, 997)  # within
            errors.append(np.abs(interpolated(times, np.sin(times), at) - np.sin(at)).max())
        self.assertGreater(np.log2(errors[0] / errors[1]), 2.9)  # 3
        self.assertLess(errors[1], 1e-5)  # linearly 3e-4
        steps = interpolated(np.arange(6.0), np.array([0, 0, 0, 1, 1, 1.0]), np.linspace(0, 5, 101))
        self.assertTrue((np.diff(steps) >= 0).all() and steps.min() == 0 and steps.max() == 1)

    def test_between_rows_gaps_stay_gaps(self):
        times, values = np.array([0, 1, 2, 2, 3.0]), np.array([np.nan, 1, 2, 2, 3])
        np.testing.assert_array_equal(
            interpolated(times, values, np.array([-1, 0.5, 1, 1.5, 2, 2.5, 3, 4])),
            [np.nan, np.nan, 1, 1.5, 2, 2.5, 3, np.nan],
        )

    def test_units_come_from_the_column_names(self):
        expected = {
            "time_us": "µs",
            "neck_radius_nm": "nm",
            "membrane_area_nm2": "nm²",
            "volume_extracellular_nm3": "nm³",
            "bending_energy_pN_nm": "pN nm",
            "area_strain_max": "1",
            "wall_s": "s",
        }
        units = self.run_.history_units
        self.assertEqual({name: units[name] for name in expected}, expected)

    def test_units_of_columns_an_engine_adds(self):
        expected = {
            "dissipation_pN_nm_per_us": "pN nm/µs",
            "curvature_max_per_nm": "1/nm",
            "tension_pN_per_nm": "pN/nm",
            "nm": "1",
        }
        self.assertEqual({name: unit_of(name) for name in expected}, expected)

    def test_shape_at_an_output_time_is_that_shape(self):
        self.assertIs(self.run_.shape_at(0.3), self.run_.shapes[3])

    def test_shape_outside_the_run(self):
        for time in (-0.1, 1.1):
            with self.assertRaisesRegex(endoflow.OutOfRangeError, "shapes cover 0 to 1"):
                self.run_.shape_at(time)


class Interpolation(unittest.TestCase):
    def test_growing_cap_between_times_is_second_order_in_time(self):
        def error(interval):
            with tempfile.TemporaryDirectory() as scratch:
                times = np.array([0.4, 0.4 + interval])
                membrane = lambda t: synthetic.budding_membrane(t, 1.0)  # noqa: E731
                run = endoflow.load(
                    synthetic.write_run(Path(scratch), "boundary-integral", membrane, times, points=1500)
                )
            shape, exact = run.shape_at(0.4 + interval / 2), membrane(0.4 + interval / 2)
            return abs(shape.z[0] - exact.bud_height - exact.z0)

        errors = [error(interval) for interval in (0.08, 0.04, 0.02)]
        orders = np.log2(np.array(errors[:-1]) / errors[1:])
        self.assertGreater(orders.min(), 1.8)

    def test_material_keeps_its_concentration(self):
        """A steep front on material that moves between two times stays one steep front; matching points by relative area would not."""

        def steep_front(time):
            r, z, kappa = synthetic.budding_membrane(time, 1.0).curve(4000)
            c = 0.5 * (1 - np.tanh((equivalent_radius(r, z) - synthetic.PATCH_RADIUS) / 0.2))
            return Shape(time, kappa, r, z, c, kappa, kappa, kappa, kappa)

        first, second = steep_front(0.2), steep_front(0.6)
        widths = [self.front_area(shape) for shape in (first, second, between(first, second, 0.4))]
        moved = abs(area_from_axis(second.r, second.z)[-1] / area_from_axis(first.r, first.z)[-1] - 1) * np.pi * 36**2
        self.assertGreater(moved, 5 * widths[0])
        self.assertLess(widths[2], 1.3 * widths[0])

    @staticmethod
    def front_area(shape):
        """Membrane area (nm²) over which c falls from 0.7 to 0.3."""
        area = area_from_axis(shape.r, shape.z)
        return np.interp(-0.3, -shape.c, area) - np.interp(-0.7, -shape.c, area)

    def test_ends_stay_on_axis_and_rim(self):
        with tempfile.TemporaryDirectory() as scratch:
            membrane = lambda t: synthetic.budding_membrane(t, 1.0)  # noqa: E731
            run = endoflow.load(synthetic.write_run(Path(scratch), "boundary-integral", membrane, np.array([0.0, 0.5])))
        shape = run.shape_at(0.25)
        self.assertEqual(shape.r[0], 0)
        self.assertAlmostEqual(shape.r[-1], synthetic.RIM, places=9)
        self.assertAlmostEqual(shape.z[-1], synthetic.FLAT_HEIGHT, places=9)
        self.assertTrue((np.diff(shape.r[-20:]) > 0).all())


class ClosedCurves(unittest.TestCase):
    @staticmethod
    def sphere(time, radius, points):
        """A sphere from pole to pole, its points unevenly spread."""
        angle = np.pi * np.linspace(0, 1, points) ** 1.3
        r, z = radius * np.sin(angle), radius * np.cos(angle)
        r[-1] = 0.0
        fields = {"s": radius * angle, "r": r, "z": z, "c": 0 * r, "lambda_": 0 * r, "kappa": 0 * r + 2 / radius}
        return Shape(time, **fields, u_r=0 * r, u_z=0 * r)

    def test_a_growing_sphere_between_times(self):
        """Equal fractions of area are equal angles: the sphere of the mean radius, up to the cubic's O(h³)."""
        errors = []
        for points in (101, 201):
            shape = between(self.sphere(0.0, 20.0, points), self.sphere(1.0, 22.0, points + 30), 0.5)
            self.assertTrue(shape.closed)
            self.assertEqual(shape.r[0], 0.0)
            self.assertAlmostEqual(shape.r[-1], 0.0, delta=1e-12)
            errors.append(np.abs(np.hypot(shape.r, shape.z) - 21).max())
        self.assertLess(errors[1], 1e-4)
        self.assertLess(errors[1], errors[0] / 3)

    def test_a_membrane_across_the_box_is_open(self):
        r = np.linspace(0, 80, 11)
        self.assertFalse(Shape(0.0, r, r, 0 * r, 0 * r, 0 * r, 0 * r, 0 * r, 0 * r).closed)


class DamagedRun(unittest.TestCase):
    def setUp(self):
        membrane = lambda t: synthetic.budding_membrane(t, 1.0)  # noqa: E731
        self.run_ = synthetic.write_run(
            scratch_directory(self) / "run", "phase-field", membrane, np.array([0.0, 0.5, 1.0]), points=50
        )

    def assert_refused(self, pattern):
        with self.assertRaisesRegex(endoflow.RunDirectoryError, pattern) as caught:
            endoflow.load(self.run_)
        self.assertNotIn("\n", str(caught.exception))

    def test_no_directory(self):
        self.run_ = self.run_ / "absent"
        self.assert_refused("no such directory")

    def test_missing_files(self):
        for name in ("run.json", "history.csv", "shapes.h5"):
            with self.subTest(name):
                kept = (self.run_ / name).read_bytes()
                (self.run_ / name).unlink()
                self.assert_refused(f"{name}: the file is missing")
                (self.run_ / name).write_bytes(kept)

    def test_damaged_record(self):
        for text, pattern in (("{", "cannot be read as JSON"), ("[]", "not a JSON object"), ("{}", "has no `engine`")):
            (self.run_ / "run.json").write_text(text)
            self.assert_refused(pattern)

    def test_record_without_parameters(self):
        (self.run_ / "run.json").write_text(json.dumps({"engine": "phase-field"}))
        self.assert_refused("has no `parameters`")

    def test_event_without_time(self):
        record = json.loads((self.run_ / "run.json").read_text())
        record["events"] = {"budding": {}}
        (self.run_ / "run.json").write_text(json.dumps(record))
        self.assert_refused("event `budding` has no `time_us`")

    def edit_history(self, edit):
        path = self.run_ / "history.csv"
        path.write_text(edit(path.read_text()))

    def test_torn_history(self):
        self.edit_history(lambda text: text[:-40])
        self.assert_refused(r"history.csv: line 202 has \d+ cells where the header has 11")

    def test_history_whose_last_number_is_cut(self):
        """All cells are there, and the last one is a number, but not the one that was computed."""
        self.edit_history(lambda text: text.rstrip()[:-1])
        self.assert_refused("history.csv: line 202 is torn")

    def test_record_with_parts_of_another_kind(self):
        whole = json.loads((self.run_ / "run.json").read_text())
        for key, value in (("alarms", 1), ("alarms", [{}]), ("events", []), ("time_us", "x"), ("parameters", {"time": {}})):
            with self.subTest(f"{key} = {value}"):
                (self.run_ / "run.json").write_text(json.dumps({**whole, key: value}))
                self.assert_refused(key)

    def test_damage_within_shapes(self):
        """Every byte of the file's structure in turn: one line, whatever the library calls what it meets."""
        path = self.run_ / "shapes.h5"
        whole = path.read_bytes()
        for at in range(0, len(whole), len(whole) // 97):
            path.write_bytes(whole[:at] + b"\xff\x00\xa5" + whole[at:])
            try:
                endoflow.load(self.run_)
            except endoflow.RunDirectoryError as error:
                self.assertNotIn("\n", str(error))

    def test_history_with_a_word(self):
        self.edit_history(lambda text: text.replace("0.005,", "oops,", 1))
        self.assert_refused("history.csv: line 2: .*oops")

    def test_history_without_a_column(self):
        self.edit_history(lambda text: text.replace("bud_height_nm", "height", 1))
        self.assert_refused(r"lacks the column\(s\) bud_height_nm")

    def test_history_without_steps(self):
        self.edit_history(lambda text: text.splitlines()[0] + "\n")
        self.assert_refused("holds no time step")

    def test_history_running_backwards(self):
        self.edit_history(lambda text: text + text.splitlines()[1] + "\n")
        self.assert_refused("time_us does not increase")

    def test_truncated_shapes(self):
        path = self.run_ / "shapes.h5"
        path.write_bytes(path.read_bytes()[:3000])
        self.assert_refused("shapes.h5: cannot be read as HDF5")

    def change_shapes(self, change):
        with h5py.File(self.run_ / "shapes.h5", "a") as file:
            change(file)

    def test_shapes_without_content(self):
        self.change_shapes(lambda file: [file.__delitem__(f"shapes/{i:06d}") for i in range(3)])
        self.assert_refused("holds no shape")

    def test_shape_without_a_field(self):
        self.change_shapes(lambda file: file["shapes/000001"].__delitem__("kappa"))
        self.assert_refused("/shapes/000001 lacks kappa")

    def test_shape_without_time(self):
        self.change_shapes(lambda file: file["shapes/000001"].attrs.__delitem__("time"))
        self.assert_refused("has no attribute `time`")

    def replace(self, field, values):
        def change(file):
            del file[f"shapes/000002/{field}"]
            file[f"shapes/000002/{field}"] = values

        self.change_shapes(change)

    def test_fields_of_unequal_length(self):
        self.replace("c", np.zeros(49))
        self.assert_refused(r"/shapes/000002: a curve needs .* c \(49,\)")

    def test_not_a_number(self):
        self.replace("z", np.full(50, np.nan))
        self.assert_refused("/shapes/000002: z holds values that are not numbers")

    def test_curve_from_rim_to_axis(self):
        self.replace("r", np.linspace(80, 0, 50))
        self.assert_refused("does not run from the axis to the rim")


if __name__ == "__main__":
    unittest.main()
