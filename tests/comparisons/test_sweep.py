"""`endoflow sweep` with a program that writes runs in closed form: table, plots, messages."""

import unittest

import locations  # noqa: F401
from browser import Browser, chromium
from command import unnamed_basis
from studies import BOUNDARY_INTEGRAL, PATCHES, SweepTest

from comparisons.page import sweep_page
from comparisons.files import cell


class Sweep(SweepTest):
    def test_table_and_plots(self):
        process = self.sweep("--vary", PATCHES, *BOUNDARY_INTEGRAL, "--until", "1")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        rows = self.rows()
        self.assertEqual([row["molecules.patch_radius"] for row in rows], ["20", "40", "60"])
        self.assertEqual({row["state"] for row in rows}, {"finished"})
        self.assertEqual(rows[1]["directory"], "out/case/sweep/patch_radius=40/boundary-integral")
        self.assertAlmostEqual(float(rows[0]["budding_time_us"]), 0.7346, places=3)
        self.assertAlmostEqual(float(rows[0]["neck_radius_nm"]), 0.78, places=1)
        for column in ("bud_diameter_nm", "bud_height_nm", "membrane_area_nm2", "bending_energy_pN_nm", "wall_s"):
            self.assertGreater(float(rows[0][column]), 0)
        self.assertEqual((self.scratch / "out/case/sweep/sweep.png").read_bytes()[:4], b"\x89PNG")
        page = (self.scratch / "out/case/sweep/report.html").read_text()
        self.assertIn("molecules.patch_radius", page)
        self.assertEqual(unnamed_basis(page), [])
        for head in ("<code>molecules.patch_radius</code>", "budding time (µs)", "membrane area (nm²)"):
            self.assertIn(f'<th scope="col">{head}</th>', page)
        self.assertIn("3 of 3 done", process.stdout)

    def test_two_parameters_and_both_engines(self):
        vary = ("--vary", "molecules.patch_radius=20,30", "--vary", "molecules.transport=fickian,advection")
        process = self.sweep(*vary, "--engine", "both", "-o", "s")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertEqual(len(self.rows("s")), 8)
        self.assertIn("s/patch_radius=30/transport=fickian/phase-field fresh", self.runs())
        self.assertTrue((self.scratch / "s/sweep.svg").exists())

    def test_a_parameter_with_two_values(self):
        for option, value, key in (("--set", "time.tolerance=1e-3", "time.tolerance"), ("--until", "1", "time.end")):
            process = self.sweep("--vary", f"{key}=1e-2,1e-1", *BOUNDARY_INTEGRAL, option, value)
            self.assert_one_line(process, 2, f"--vary {key}: --set or --until gives it a value, too")
        self.assertEqual(self.runs(), [])

    def test_empty_argument(self):
        """As of a shell's variable that is not set: the table would land in the present directory."""
        process = self.sweep("--vary", PATCHES, *BOUNDARY_INTEGRAL, "-o", "")
        self.assertEqual(process.returncode, 2)
        self.assertIn("an argument is empty", process.stderr)
        self.assertFalse((self.scratch / "sweep.csv").exists())

    def test_table_is_no_program(self):
        """Spreadsheets compute cells that begin like a formula; numbers stay numbers."""
        texts = {"=1+1": "'=1+1", "@x": "'@x", "-rm": "'-rm", "-5": "-5", "+1e3": "+1e3", "a=b": "a=b"}
        self.assertEqual({text: cell(text) for text in texts}, texts)
        self.assertEqual(cell(-0.5), "-0.5")

    def test_axes_have_units_and_ticks_without_round_off(self):
        """Runs that stop at budding end with a neck of 5 nm to round-off."""
        rows = [
            {
                "molecules.patch_radius": text,
                "engine": "boundary-integral",
                **dict.fromkeys(sweep_page.QUANTITIES, 1.0),
            }
            for text in ("20", "30", "40")
        ]
        for row, necks in zip(rows, (4.9999999999998, 5.0, 4.9999999999999)):
            row["neck_radius_nm"] = necks
        figure = sweep_page.lines(rows, "molecules.patch_radius", "molecules.patch_radius (nm)")
        figure.canvas.draw()
        axes = figure.axes[list(sweep_page.QUANTITIES).index("neck_radius_nm")]
        texts = [label.get_text() for label in axes.get_yticklabels()]
        self.assertLess(max(map(len, texts)), 10, texts)
        self.assertEqual(figure.axes[-1].get_xlabel(), "molecules.patch_radius (nm)")
        self.sweep("--vary", PATCHES, *BOUNDARY_INTEGRAL, "-o", "s")
        self.assertIn("molecules.patch_radius (nm)", (self.scratch / "s/sweep.svg").read_text())

    @unittest.skipUnless(chromium(), "no Chromium")
    def test_page_on_a_phone(self):
        """The page does not move sideways; plots and the table do, plots with letters of a size, rows with their heading."""
        self.sweep("--vary", PATCHES, *BOUNDARY_INTEGRAL, "-o", "a_directory_with_quite_a_long_name_for_a_narrow_screen")
        with Browser() as browser:
            browser.resize(400, 800)
            report = self.scratch / "a_directory_with_quite_a_long_name_for_a_narrow_screen" / "report.html"
            browser.open(report, "document.readyState === 'complete' && document.querySelector('.plot img') !== null")
            self.assertLessEqual(browser.evaluate("document.documentElement.scrollWidth"), 400)
            self.assertGreaterEqual(browser.evaluate("document.querySelector('.plot img').width"), 700)
            place = "document.querySelector('tbody th').getBoundingClientRect().left"
            before = browser.evaluate(place)
            browser.evaluate("void (document.querySelector('.table').scrollLeft = 200)")
            self.assertGreater(browser.evaluate("document.querySelector('.table').scrollLeft"), 100)
            self.assertAlmostEqual(browser.evaluate(place), before, delta=13)  # the frame's own padding

    def test_refused_before_anything_runs(self):
        for values, message in (
            ("molecules.patch_radus=1,2", "unknown key molecules.patch_radus"),
            ("molecules.patch_radius=20,2000", "must be at most 1000"),
            ("molecules.patch_radius=20:10:1", "a step of 1 does not lead from 20 to 10"),
            ("patch_radius=20", "it must read section.key="),
        ):
            with self.subTest(values):
                self.assert_one_line(self.sweep("--vary", values, *BOUNDARY_INTEGRAL), 2, message)
        self.assertEqual(self.runs(), [])
        self.assertEqual(self.sweep("--vary", PATCHES).returncode, 2)
        self.assert_one_line(
            self.call("sweep", "no.toml", "--vary", PATCHES, *BOUNDARY_INTEGRAL), 2, "no such case file"
        )

    def test_output_cannot_be_written(self):
        self.assert_one_line(
            self.sweep("--vary", PATCHES, *BOUNDARY_INTEGRAL, "-o", "case.toml/out"),
            4,
            "Not a directory; choose another",
        )


if __name__ == "__main__":
    unittest.main()
