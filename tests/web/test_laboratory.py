#!/usr/bin/env python3
"""The laboratory in a real browser: its numbers are the native engine's, its links and files round trips, and it asks nobody."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "comparisons"))
import browser

PAGE = pathlib.Path(os.environ.get("ENDOFLOW_PAGE", "build/web/index.html"))
PROGRAM = os.environ.get("ENDOFLOW_PROGRAM", "build/endoflow")

# Both engines make the same steps, but sums in WebAssembly are added in another order: the integrator's steps then differ
# in their last digits. Budding times agree to some 1e-8.
SAME = 1e-6

CASES = {
    "": [],
    "molecules.patch_radius=28": ["molecules.patch_radius=28"],
    "fluid.dynamics=geometric": ["fluid.dynamics=geometric"],
}


def native_budding(settings):
    """Budding time [µs] of the native engine."""
    with tempfile.TemporaryDirectory() as scratch:
        case = pathlib.Path(scratch) / "case.toml"
        case.write_text("")
        sets = [word for value in [*settings, "output.field_interval=0", "output.stop_at_budding=true"] for word in ("--set", value)]
        run = pathlib.Path(scratch) / "run"
        subprocess.run([PROGRAM, "run", "boundary-integral", case, "-o", run, *sets], check=True, stdout=subprocess.DEVNULL)
        return json.loads((run / "run.json").read_text())["events"]["budding"]["time_us"]


@unittest.skipUnless(browser.chromium(), "chromium is not installed")
@unittest.skipUnless(PAGE.exists(), "the page is not built: make web")
class Laboratory(unittest.TestCase):
    """One browser for all; each test opens the page anew."""

    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser(1366, 768)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def setUp(self):
        self.browser.problems.clear()

    def tearDown(self):
        self.assertEqual([problem for problem in self.browser.problems if "blob:" not in problem], [])

    def open(self, settings="", ready="window.laboratory?.run?.rows.length > 2"):
        """Open the page with a link's settings."""
        page = self.browser
        page.evaluate("location.href = 'about:blank'")
        time.sleep(0.1)
        page._call("Page.navigate", {"url": f"{PAGE.resolve().as_uri()}#{settings}"})
        self.wait(ready)

    def wait(self, condition, seconds=300):
        end = time.monotonic() + seconds
        while self.browser.evaluate(condition) is not True:
            if time.monotonic() > end:
                self.fail(f"never: {condition}; {self.browser.problems}")
            time.sleep(0.05)

    def budding(self):
        return self.browser.evaluate("laboratory.run.events.budding.time_us")

    def test_budding_is_the_native_engine_s(self):
        for link, settings in CASES.items():
            with self.subTest(link):
                self.open(link)
                self.wait("laboratory.run.events.budding !== undefined")
                native = native_budding(settings)
                self.assertLess(abs(self.budding() / native - 1), SAME)

    def test_wrong_input_is_refused_as_on_the_command_line(self):
        self.open()
        page = self.browser
        page.evaluate("""(() => { const input = document.getElementById('all-molecules-patch_radius');
            input.value = '-3'; input.dispatchEvent(new Event('change')); })()""")
        self.wait("laboratory.state === 'failed'")
        message = page.evaluate("document.getElementById('error').textContent")
        refused = subprocess.run([PROGRAM, "check", "/dev/null", "--set", "molecules.patch_radius=-3"], capture_output=True, text=True)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("molecules.patch_radius", message)
        self.assertIn("> 0", message)
        self.assertTrue(message.startswith("case.toml:2:"), message)
        page.evaluate("""(() => { const input = document.getElementById('all-molecules-patch_radius');
            input.value = 'wide'; input.dispatchEvent(new Event('change')); })()""")
        self.wait("document.getElementById('error').textContent.includes('wide')")

    def test_what_stops_the_solver_is_said_with_its_remedy(self):
        self.open("membrane.pole_force=5000&boundary_integral.elements=12")
        self.wait("laboratory.state === 'failed' || laboratory.state === 'ended'")
        self.assertEqual(self.browser.evaluate("laboratory.state"), "failed")
        self.assertIn(";", self.browser.evaluate("document.getElementById('error').textContent"))

    def test_stop_and_continue_change_nothing(self):
        settings = "fluid.dynamics=geometric"
        self.open(settings)
        self.wait("laboratory.state === 'ended'")
        whole = self.browser.evaluate("laboratory.run.rows")
        self.open(settings)
        press = "document.getElementById('stop').click()"
        self.browser.evaluate(press)
        self.wait("laboratory.state === 'stopped'")
        time.sleep(0.3)
        stopped = self.browser.evaluate("laboratory.run.rows.length")
        self.assertLess(stopped, len(whole))
        time.sleep(0.3)
        self.assertEqual(self.browser.evaluate("laboratory.run.rows.length"), stopped)
        self.browser.evaluate(press)
        self.wait("laboratory.state === 'ended'")
        self.assertEqual(self.browser.evaluate("laboratory.run.rows"), whole)

    def test_a_link_holds_all_settings(self):
        self.open("molecules.patch_radius=31.5&molecules.transport=fickian&membrane.inextensible=false")
        values = self.browser.evaluate("laboratory.settings.values")
        self.assertEqual(values, {"molecules.patch_radius": 31.5, "molecules.transport": "fickian", "membrane.inextensible": False})
        link = self.browser.evaluate("location.hash")
        self.open(link.removeprefix("#"))
        self.assertEqual(self.browser.evaluate("laboratory.settings.values"), values)
        self.open("no.such=1&molecules.patch_radius=30")
        self.assertEqual(self.browser.evaluate("laboratory.settings.values"), {"molecules.patch_radius": 30})
        self.assertIn("no.such=1", self.browser.evaluate("document.getElementById('error').textContent"))

    def test_the_case_it_saves_is_the_one_it_shows(self):
        self.open("molecules.patch_radius=31.5&molecules.transport=fickian&membrane.inextensible=false&domain.radius=90")
        text = self.browser.evaluate("laboratory.caseText()")
        with tempfile.TemporaryDirectory() as scratch:
            case = pathlib.Path(scratch) / "case.toml"
            case.write_text(text)
            subprocess.run([PROGRAM, "check", case], check=True, stdout=subprocess.DEVNULL)
        self.assertIn("patch_radius = 31.5", text)

    def test_every_case_of_the_list_opens(self):
        self.open()
        self.wait("laboratory.presetsRead === true")
        for name in self.browser.evaluate("[...document.getElementById('preset').options].map((o) => o.value).filter(Boolean)"):
            with self.subTest(name):
                self.browser.evaluate(f"(() => {{ const s = document.getElementById('preset'); s.value = '{name}'; s.dispatchEvent(new Event('change')); }})()")
                self.wait("laboratory.state === 'running' && laboratory.run.rows.length > 1")
                self.assertEqual(self.browser.evaluate("document.getElementById('preset').value"), name)

    def test_the_tour_sets_the_laboratory(self):
        self.open()
        self.browser.evaluate("document.getElementById('tour-open').click()")
        titles = []
        for _ in range(6):
            self.wait("laboratory.run.rows.length > 1 && laboratory.state !== 'failed'")
            titles.append(self.browser.evaluate("document.activeElement.textContent"))
            self.browser.evaluate("document.getElementById('tour-next').click()")
            time.sleep(0.1)
        self.assertEqual(len(set(titles)), 6)
        self.assertEqual(self.browser.evaluate("laboratory.settings.values"), {"fluid.dynamics": "geometric"})


if __name__ == "__main__":
    unittest.main()
