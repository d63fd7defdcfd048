"""The laboratory's page in a real browser, as its tests open it and use it."""

import os
import pathlib
import re
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "comparisons"))
import browser

PAGE = pathlib.Path(os.environ.get("ENDOFLOW_PAGE", "build/web/index.html"))

# A run of a second, which ends before it buds.
SHORT = "time.end=0.05"

# What a page from a disk makes for itself, its worker and its downloads: nobody else's have an origin of null.
OWN = re.compile(r"network request: blob:null/[0-9a-f-]{36}")

# Whether a person sees an element.
VISIBLE = "((id) => document.getElementById(id).checkVisibility())"


def needs_page(test):
    """Skips a class of tests where there is no browser or no page."""
    built = unittest.skipUnless(PAGE.exists(), "the page is not built: make web")
    return unittest.skipUnless(browser.chromium(), "chromium is not installed")(built(test))


class Page(unittest.TestCase):
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
        self.assertEqual([problem for problem in self.browser.problems if not OWN.fullmatch(problem)], [])
        self.browser.resize(1366, 768)
        self.browser.prefer("light")

    def open(self, settings="", ready="window.laboratory?.run?.rows.length > 2"):
        """Open the page with a link's settings."""
        self.browser.visit(f"{PAGE.resolve().as_uri()}#{settings}")
        self.wait(ready)

    def wait(self, condition, seconds=300):
        end = time.monotonic() + seconds
        while self.browser.evaluate(condition) is not True:
            if time.monotonic() > end:
                self.fail(f"never: {condition}; {self.browser.problems}")
            time.sleep(0.05)

    def press(self, button):
        """Click the button of an id."""
        self.browser.evaluate(f"document.getElementById('{button}').click()")

    def type(self, field, value):
        """Give a field or a list of choices a value, as a person does."""
        self.browser.evaluate(
            f"""(() => {{ const input = document.getElementById('{field}');
            input.value = '{value}'; input.dispatchEvent(new Event('change')); }})()"""
        )

    def slide(self, slider, value):
        """Move a slider of the settings, or choose from a list of them, as a person does."""
        self.browser.evaluate(
            f"""(() => {{ const input = document.getElementById('slider-{slider}');
            input.value = '{value}'; for (const kind of ['input', 'change']) input.dispatchEvent(new Event(kind)); }})()"""
        )

    def values(self):
        """All settings that are no defaults."""
        return self.browser.evaluate("laboratory.settings.values")

    def text(self, part):
        """What an element says when everything until now has been drawn."""
        self.browser.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        return self.browser.evaluate(f"document.getElementById('{part}').textContent")
