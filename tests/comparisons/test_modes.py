"""Plots, page and surfaces of `endoflow modes`, from tables of a membrane that is known in closed form.

python3 tests/comparisons/test_modes.py
"""

import json
import re
import unittest

import locations  # noqa: F401
import h5py
import numpy as np
import endoflow
import synthetic
from browser import Browser, chromium
from command import call, unnamed_basis
from scratch import scratch_directory

TIMES, BUDDING = (0.0, 0.4, 0.8, 1.0), 0.8
INITIAL = ("dome", "edge", "sheet", "coat", "worst")
READY = "document.documentElement?.dataset.ready === 'true'"
ORDERS = (1, 2, 3)


def growth(mode, time):
    """A rate, 1/µs."""
    return (1.5 if mode == 1 else -mode) * (1 - 0.3 * time)


def write_meridian(file, number, time):
    """A time's group (h5py) with its membrane; its r and z, nm."""
    r, z, _ = synthetic.budding_membrane(time, 1.0).curve(400)
    slope_r, slope_z = np.gradient(r), np.gradient(z)
    length = np.hypot(slope_r, slope_z)
    group = file.create_group(f"times/{number:06d}")
    group.attrs["time"] = time
    for name, values in {"r": r, "z": z, "normal_r": -slope_z / length, "normal_z": slope_r / length}.items():
        group[name] = values
    return group, r, z


def write_tables(directory):
    """What endoflow-modes writes: w = sin(π s/L)^m, its amplitude 0.1 nm e^{−m t}."""
    rates = ["time_us,mode,rank,growth_per_us,frequency_rad_per_us,peak_r_nm,peak_z_nm"]
    followed = ["time_us,mode,initial,peak_nm,rms_nm,gain"]
    with h5py.File(directory / "eigenshapes.h5", "w") as file:
        file.create_group("times").attrs["budding_us"] = BUDDING
        for number, time in enumerate(TIMES):
            group, r, z = write_meridian(file, number, time)
            group["c"] = synthetic.concentration(r, z)
            for m in ORDERS:
                w = np.sin(np.pi * np.linspace(0, 1, len(r))) ** m
                mode = group.create_group(f"mode_{m}")
                mode.attrs["growth_per_us"] = growth(m, time)
                amplitude = 0.1 * np.exp(-m * time)
                for name, values in {"w": w, "c": 0 * w, "worst": amplitude * w**2, "worst_at_start": 0.1 * w}.items():
                    mode[name] = values
                rates += [f"{time},{m},{rank},{growth(m, time) - rank},0,10,90" for rank in range(3)]
                for name in INITIAL:
                    gain = "" if name == "coat" else np.exp(-m * time)
                    followed.append(f"{time},{m},{name},{amplitude},{amplitude / 3},{gain}")
    (directory / "modes.csv").write_text("\n".join(rates) + "\n")
    (directory / "perturbations.csv").write_text("\n".join(followed) + "\n")


def write_noise(directory):
    """What --noise adds: a neck of 10 − 5 t, its spread 1 + t of which half is inherited; all else a constant."""
    columns = ("height", "neck", "sideways", "ellipticity", "neck_ellipticity")
    names = ["time_us", "height_nm", "neck_radius_nm"]
    for name in columns:
        unit = "" if "ellipticity" in name else "_nm"
        names += [f"{name}_rms{unit}", f"{name}_inherited{unit}"]
    rows, modes = [",".join(names)], ["time_us,mode,rms_nm,inherited_nm"]
    with h5py.File(directory / "noise.h5", "w") as file:
        for number, time in enumerate(TIMES):
            spread = 1 + time
            neck = ["", "", ""] if number == 0 else [10 - 5 * time, spread, spread / 2]
            rows.append(",".join(map(str, [time, 40, neck[0], 2, 1, *neck[1:], 3, 1, 0.1, 0.05, 0.2, 0.1])))
            group, r, _ = write_meridian(file, number, time)
            for m in (0, *ORDERS):
                modes.append(f"{time},{m},{spread},{spread / 2}")
                group[f"rms_{m}"], group[f"inherited_{m}"] = spread + 0 * r, spread / 2 + 0 * r
    (directory / "noise.csv").write_text("\n".join(rows) + "\n")
    (directory / "noise_modes.csv").write_text("\n".join(modes) + "\n")
    members = ["time_us,members,height_mean_nm,height_rms_nm,height_inherited_nm,neck_mean_nm,neck_rms_nm,neck_inherited_nm"]
    members += [f"{time},200,40,1.1,1," + (",," if number == 0 else "9,2,1") for number, time in enumerate(TIMES)]
    (directory / "noise_ensemble.csv").write_text("\n".join(members) + "\n")
    record = {"temperature_K": 310, "budding_us": BUDDING, "budding_spread_us": 0.36, "linear_until_us": 0.9}
    (directory / "noise.json").write_text(json.dumps(record))


class NoiseDirectory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = scratch_directory(cls)
        write_tables(cls.directory)
        write_noise(cls.directory)
        cls.process = call("modes", cls.directory)

    def test_reader(self):
        noise = endoflow.load_modes(self.directory).noise
        self.assertEqual((noise.temperature, noise.budding, noise.budding_spread), (310, BUDDING, 0.36))
        self.assertTrue(np.isnan(noise.table["neck_rms_nm"][0]))
        np.testing.assert_allclose(noise.table["neck_rms_nm"][1:], 1 + np.array(TIMES[1:]))
        np.testing.assert_allclose(noise.modes[3]["inherited_nm"], (1 + np.array(TIMES)) / 2)
        np.testing.assert_allclose(noise.ensemble["height_rms_nm"], 1.1)
        self.assertTrue(np.isnan(noise.ensemble["neck_rms_nm"][0]))
        # Four modes of the same variance.
        np.testing.assert_allclose(noise.meridians[1].total, 2 * (1 + TIMES[1]))

    def test_page(self):
        self.assertEqual((self.process.returncode, self.process.stderr), (0, ""))
        for name in ("noise_histories", "noise_spreads", "noise_shapes"):
            self.assertGreater((self.directory / f"{name}.svg").stat().st_size, 5000)
        page = (self.directory / "report.html").read_text("utf-8")
        self.assertIn("Spread of the budding time", page)
        self.assertIn("Linear noise ends", page)

    @unittest.skipUnless(chromium(), "chromium is not installed (Debian package chromium)")
    def test_one_standard_deviation_in_space(self):
        with Browser() as browser:
            browser.open(self.directory / "report.html", READY)
            browser.evaluate("document.getElementById('turn').click()")
            before = browser.evaluate("document.getElementById('view').toDataURL()")
            browser.evaluate("document.querySelector('input[value=noise]').click()")
            self.assertNotEqual(browser.evaluate("document.getElementById('view').toDataURL()"), before)
            text = browser.evaluate("document.getElementById('says').textContent")
            self.assertIn("thermal noise is 1.8 nm at most", text)  # at budding
            self.assertEqual(browser.problems, [])

    def test_a_broken_table(self):
        directory = scratch_directory(self)
        write_tables(directory)
        write_noise(directory)
        (directory / "noise.csv").write_text("time_us\nnever\n")
        process = call("modes", directory)
        self.assertEqual(process.returncode, 4)
        self.assertIn("holds no modes", process.stderr)


class ModesDirectory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = scratch_directory(cls)
        write_tables(cls.directory)
        flat = synthetic.SphereOnPlane(1e5, 1e-3, 80.0, 1e-9)
        synthetic.write_run(cls.directory / "run", "boundary-integral", lambda t: flat, [0, 1.0])
        cls.process = call("modes", cls.directory, "--run", cls.directory / "run")

    def test_reader(self):
        modes = endoflow.load_modes(self.directory)
        self.assertIsNone(modes.noise)
        self.assertEqual(modes.modes, list(ORDERS))
        self.assertEqual(modes.initial_shapes, list(INITIAL))
        self.assertEqual((modes.budding, modes.last_index), (BUDDING, 2))
        np.testing.assert_allclose(modes.rates[2], [growth(2, time) for time in TIMES])
        np.testing.assert_allclose(modes.perturbations[3, "edge"]["gain"], np.exp(-3 * np.array(TIMES)))
        self.assertTrue(np.isnan(modes.perturbations[3, "coat"]["gain"]).all())

    def test_everything_is_written(self):
        self.assertEqual((self.process.returncode, self.process.stderr), (0, ""))
        for name in ("modes_rates", "modes_perturbations", "modes_shapes"):
            for suffix in ("png", "svg"):
                self.assertGreater((self.directory / f"{name}.{suffix}").stat().st_size, 5000)
        page = (self.directory / "report.html").read_text("utf-8")
        self.assertIsNone(re.search(r'(?:src|href)="(?!data:)', page))
        self.assertIn("0.1 nm becomes", page)
        self.assertEqual(unnamed_basis(page), [])

    def test_displacements_of_the_surfaces(self):
        from comparisons.page.modes_page import surface

        meridian = endoflow.load_modes(self.directory).meridians[-1]
        points, quads, arrays = surface(meridian, 1.0)
        self.assertEqual(quads.max(), len(points) - 1)
        vectors = arrays["mode_2_displacement_nm"]
        self.assertEqual(vectors.shape, points.shape)
        size = np.linalg.norm(vectors, axis=1)
        self.assertAlmostEqual(size.max(), 1, delta=1e-3)  # points 1 nm apart miss the hump's top by less
        # Half a turn leaves mode 2 as it is and turns the vector; mode 1 changes its sign.
        half = len(points) // 2
        turned = np.array([-1, -1, 1])
        np.testing.assert_allclose(vectors[half:] * turned, vectors[:half], atol=1e-12)
        odd = arrays["mode_1_displacement_nm"]
        np.testing.assert_allclose(odd[half:] * turned, -odd[:half], atol=1e-12)

    def test_a_directory_without_modes(self):
        process = call("modes", scratch_directory(self))
        self.assertEqual(process.returncode, 4)
        self.assertIn("holds no modes", process.stderr)

    @unittest.skipUnless(chromium(), "chromium is not installed (Debian package chromium)")
    def test_page(self):
        picture = "document.getElementById('view').toDataURL()"
        text = "document.getElementById('says').textContent"
        with Browser() as browser:
            browser.open(self.directory / "report.html", READY)
            browser.evaluate("document.getElementById('turn').click()")
            before = browser.evaluate(picture)
            self.assertIn("m = 1: grows at +1.14/µs", browser.evaluate(text))  # at budding
            browser.evaluate("document.querySelectorAll('input[name=mode]')[1].click()")
            self.assertIn("m = 2: grows at −1.52/µs", browser.evaluate(text))
            self.assertNotEqual(browser.evaluate(picture), before)
            self.assertFalse(browser.evaluate("document.getElementById('noise-kind').checkVisibility()"))
            pictures = []
            for kind in ("fastest", "worst", "fastest"):
                browser.evaluate(f"document.querySelector('input[value={kind}]').click()")
                pictures.append(browser.evaluate(picture))
            self.assertNotEqual(pictures[0], pictures[1])
            self.assertEqual(pictures[0], pictures[2])
            browser.evaluate("document.getElementById('turn').click()")
            still = browser.evaluate(picture)
            moved = f"new Promise(done => {{ const look = () => {picture} !== {still!r} ? done(true) : setTimeout(look, 20); look(); }})"
            self.assertTrue(browser.evaluate(moved))
            browser.resize(390, 800)
            self.assertLessEqual(browser.evaluate("document.documentElement.scrollWidth"), 390)
            self.assertEqual(browser.problems, [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
