"""report.html in a real browser, opened from a file."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import locations
import synthetic
from browser import Browser, chromium
from command import compare
from comparisons.measures.metrics import flattened
from comparisons.page.html import code, count_or_figures, figures, percent, prose, setting
from scratch import scratch_directory

READY = "document.documentElement?.dataset.ready === 'true'"
PICTURE = "document.getElementById('membranes').toDataURL()"
SLIDER = "document.getElementById('time')"
CHARTS = (locations.ROOT / "comparisons" / "page" / "assets" / "charts.js").read_text(encoding="utf-8")
FRAME = f"Number({SLIDER}.value)"

#: Moves the slider over 60 frames as a user's drag does; the answer is the mean time of one, in ms, and how often the
#: clock beside the picture changed.
DRAG = """(() => {
  const slider = document.getElementById('time');
  const clocks = new Set();
  const start = performance.now();
  for (let i = 0; i < 60; ++i) {
    slider.value = String(2 * i);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    clocks.add(document.getElementById('clock').textContent);
  }
  document.getElementById('membranes').getContext('2d').getImageData(0, 0, 1, 1);
  return [(performance.now() - start) / 60, clocks.size];
})()"""


@unittest.skipUnless(chromium(), "chromium is not installed (Debian package chromium)")
class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = scratch_directory(cls)
        a, b = synthetic.write_pair(scratch, count=21)
        case = synthetic.parameters(molecules__transport="fickian</script><b>")
        synthetic.write_run(
            b,
            "phase-field",
            lambda t: synthetic.budding_membrane(t, 1.0, 0.5),
            [0.05 * i for i in range(21)],
            300,
            case,
        )
        output = scratch / "out"
        compare(a, b, "-o", output).check_returncode()
        cls.report = output / "report.html"
        cls.browser = cls.enterClassContext(Browser())

    def setUp(self):
        self.browser.problems.clear()
        self.browser.resize(1366, 900)
        self.browser.prefer("light")
        self.browser.open(self.report, READY)

    def tearDown(self):
        self.browser.evaluate("1")  # drains pending events
        self.assertEqual(self.browser.problems, [])

    def test_slider_moves_picture_clock_and_cursors(self):
        seen = []
        for frame in (0, 40, 120):
            self.browser.evaluate(f"{SLIDER}.value = {frame}; {SLIDER}.dispatchEvent(new Event('input'))")
            clock = self.browser.evaluate("document.getElementById('clock').textContent")
            cursor = self.browser.evaluate("document.querySelector('#charts .cursor').getAttribute('transform')")
            neck = self.browser.evaluate("document.querySelector('#readout td').textContent")
            seen.append((self.browser.evaluate(PICTURE), clock, cursor, neck))
        for column in zip(*seen):
            self.assertEqual(len(set(column)), 3, column if len(column[0]) < 99 else "the picture")
        self.assertEqual(seen[0][3], "–")  # no neck at the start

    def test_keys(self):
        self.browser.evaluate(f"{SLIDER}.focus()")
        start = self.browser.evaluate(FRAME)
        self.browser.press("ArrowRight")
        self.assertEqual(self.browser.evaluate(FRAME), start + 1)
        self.browser.press("ArrowLeft", shift=True)
        self.assertEqual(self.browser.evaluate(FRAME), start - 9)
        self.browser.evaluate(f"{SLIDER}.blur()")
        self.browser.press("ArrowLeft")
        self.assertEqual(self.browser.evaluate(FRAME), start - 10)
        self.assertRegex(self.browser.evaluate(f"{SLIDER}.getAttribute('aria-valuetext')"), r"^0\.\d+ µs$")

    def test_space_plays_and_pauses(self):
        start = self.browser.evaluate(FRAME)
        self.browser.press(" ")
        self.browser.evaluate("new Promise((done) => setTimeout(done, 500))")
        self.assertEqual(self.browser.evaluate("document.getElementById('play').textContent"), "Pause")
        self.browser.press(" ")
        paused = self.browser.evaluate(FRAME)
        self.assertGreater(paused, start)
        self.browser.evaluate("new Promise((done) => setTimeout(done, 200))")
        self.assertEqual(self.browser.evaluate(FRAME), paused)

    def test_click_in_a_chart_moves_the_time(self):
        box = self.browser.evaluate(
            "(() => { const svg = document.querySelector('#charts svg'); svg.scrollIntoView({block: 'center'}); const b = svg.getBoundingClientRect();"
            " return [b.left + 0.5 * b.width, b.top + 0.5 * b.height]; })()"
        )
        self.browser.click(*box)
        # The plot area spans 52 to 304 of 320 units, so the middle is at (160 − 52)/252 of the time axis from 0 to 1 µs.
        clock = float(self.browser.evaluate("document.getElementById('clock').textContent"))
        self.assertAlmostEqual(clock, 108 / 252, delta=0.01)

    def test_drag_draws_every_frame(self):
        """Says how fast, but does not fail on a busy machine: the aim is 30 frames a second."""
        self.browser.evaluate(DRAG)
        milliseconds, pictures = self.browser.evaluate(DRAG)
        print(f"{1000 / milliseconds:.0f} frames/s ... ", end="", file=sys.stderr)
        self.assertEqual(pictures, 60)

    def test_light_and_dark(self):
        ground = "getComputedStyle(document.body).backgroundColor"
        light, light_picture = self.browser.evaluate(ground), self.browser.evaluate(PICTURE)
        self.browser.prefer("dark")
        self.browser.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        self.assertNotEqual(self.browser.evaluate(ground), light)
        self.assertNotEqual(self.browser.evaluate(PICTURE), light_picture)
        self.browser.evaluate("document.getElementById('theme-toggle').click()")
        self.assertEqual(self.browser.evaluate(ground), light)

    def test_outlines_of_the_other_side(self):
        before = self.browser.evaluate(PICTURE)
        self.browser.evaluate("document.getElementById('show-outlines').click()")
        self.assertNotEqual(self.browser.evaluate(PICTURE), before)

    def test_velocity_arrows(self):
        before = self.browser.evaluate(PICTURE)
        self.browser.press("v")
        self.assertTrue(self.browser.evaluate("document.getElementById('show-arrows').checked"))
        self.assertNotEqual(self.browser.evaluate(PICTURE), before)
        self.assertRegex(self.browser.evaluate("document.getElementById('arrow-note').textContent"), "longest .* nm/µs")
        self.browser.press("v")
        self.assertEqual(self.browser.evaluate(PICTURE), before)

    def test_shows_differing_parameters_and_escapes_them(self):
        marked = self.browser.evaluate("[...document.querySelectorAll('tr.differs')].map((row) => row.innerText)")
        self.assertEqual(len(marked), 1)
        self.assertIn("fickian</script><b>", marked[0])
        self.assertIn("molecules.transport", self.browser.evaluate("document.querySelector('.warnings').innerText"))

    def test_no_sideways_scrolling_on_a_narrow_screen(self):
        for width in (400, 800, 1366):
            self.browser.resize(width, 800)
            self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), width)

    def test_the_picture_is_on_the_first_screen(self):
        """Of a laptop and of a projector, below the page's name and one warning."""
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('.warnings li').length"), 1)
        for width in (1366, 1024):
            self.browser.resize(width, 768)
            self.browser.open(self.report, READY)
            box = self.browser.evaluate(
                "(() => { const b = document.getElementById('membranes').getBoundingClientRect();"
                " return [b.top, b.bottom, b.width]; })()"
            )
            self.assertGreater(box[0], 0)
            self.assertLess(box[1], 768)
            self.assertGreater(box[2], 0.55 * width)

    def test_the_bench_counts_every_picture(self):
        bench = locations.ROOT / "bench" / "page.py"
        process = subprocess.run(
            [sys.executable, str(bench), str(self.report), "--repeats", "1"], capture_output=True, text=True
        )
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        found = dict(re.findall(r"^(\S.*?) {2,}([\d.]+)", process.stdout, re.M))
        self.assertEqual(float(found["size, MB"]), round(self.report.stat().st_size / 1e6, 2))
        self.assertEqual(float(found["pictures"]), self.browser.evaluate(f"Number({SLIDER}.max)") + 1)
        self.assertGreater(float(found["pictures a second"]), 0)

    def chart_code(self, expression):
        """Value of an expression that sees the functions of charts.js."""
        return self.browser.evaluate(f"(() => {{ {CHARTS}\nreturn {expression}; }})()")

    def test_ticks_of_one_axis_are_written_alike(self):
        for ticks, texts in (
            ([1e-4, 1e-2, 1], ["10⁻⁴", "10⁻²", "10⁰"]),
            ([0, 0.00015, 0.0003], ["0", "1.5·10⁻⁴", "3·10⁻⁴"]),
            ([-0.5, 0, 20000], ["-0.5", "0", "20000"]),
        ):
            self.assertEqual(self.chart_code(f"tickTexts({ticks})"), texts)

    def test_time_axis_has_at_least_four_ticks(self):
        for last in (0.011, 0.86, 1, 1.9, 3, 4.1, 20):
            count = len(self.chart_code(f"roundTicks(0, {last}, false, 4)"))
            self.assertTrue(4 <= count <= 7, (last, count))

    def test_lines_of_charts_end_at_the_axis(self):
        """A strain that starts from zero lies below every logarithmic axis."""
        shown = self.browser.evaluate(
            "[...document.querySelectorAll('#charts svg')].map((svg) => [svg.querySelector('.frame').getAttribute('d'),"
            " svg.querySelector('clipPath rect').getAttribute('height'),"
            " [...svg.querySelectorAll('.series-0, .series-1')].map((p) => p.getAttribute('clip-path') === `url(#${svg.querySelector('clipPath').id})`)])"
        )
        self.assertGreater(len(shown), 5)
        for frame, height, clipped in shown:
            self.assertEqual(frame.split("V")[1].split("H")[0], height)
            self.assertEqual(clipped, [True, True])

    def test_buttons_are_whole_on_a_phone(self):
        self.browser.resize(390, 844)
        for name in ("theme-toggle", "play"):
            room = self.browser.evaluate(f"(() => {{ const b = document.getElementById('{name}'); return b.scrollWidth - b.clientWidth; }})()")
            self.assertEqual(room, 0, name)

    def test_every_control_has_a_name(self):
        unnamed = self.browser.evaluate(
            "[...document.querySelectorAll('button, input, canvas, #charts svg')].filter((e) =>"
            " !(e.getAttribute('aria-label') || e.closest('label'))).map((e) => e.outerHTML)"
        )
        self.assertEqual(unnamed, [])


class Numbers(unittest.TestCase):
    """How numbers and entries are written."""

    def test_measured_numbers(self):
        for value, text in ((0.0002395, "0.0002395"), (-3.2e-7, "−3.200·10⁻⁷"), (24996.05, "24\u2009996"), (None, "–")):
            self.assertEqual(figures(value), text)

    def test_counts_are_whole(self):
        self.assertEqual([count_or_figures(value, 5) for value in (1803.0, 160388.0, 0.0, 0.00031288)], ["1803", "160\u2009388", "0", "0.00031288"])

    def test_names_in_sentences(self):
        self.assertEqual(prose("as `a_b` < 1"), "as <code>a_<wbr>b</code> &lt; 1")

    def test_relative_differences(self):
        for value, text in ((0.00762, "+0.762 %"), (-1e-6, "< 0.001 %"), (12.0, "+1.20·10³ %"), (-0.5, "−50.0 %"), (1.0, "+100 %")):
            self.assertEqual(percent(value), text)

    def test_settings_are_those_of_a_case_file(self):
        self.assertEqual([setting(value) for value in (True, 1e-9, 80.0, "<box>")], ["true", "1e-09", "80", "&lt;box&gt;"])

    def test_records_in_lists_have_a_row_for_each_entry(self):
        tree = {"segments": [{"begin_us": 0.0, "parameters": {"time.end": 1.0}}, {"begin_us": 0.5}], "orders": [1, 2], "alarms": []}
        flat = {"segments.0.begin_us": 0.0, "segments.0.parameters.time.end": 1.0, "segments.1.begin_us": 0.5, "orders": "1, 2", "alarms": ""}
        self.assertEqual(flattened(tree), flat)

    def test_names_break_at_dots_and_underscores(self):
        self.assertEqual(code("time.max_step"), "<code>time.<wbr>max_<wbr>step</code>")


@unittest.skipUnless(chromium(), "chromium is not installed (Debian package chromium)")
class StudyPage(unittest.TestCase):
    """The page of the studies: static, light and dark."""

    def test_opens_and_follows_the_theme(self):
        from comparisons.page.html import page

        with tempfile.TemporaryDirectory() as scratch, Browser() as browser:
            file = Path(scratch) / "report.html"
            cards = [("Budding", "0.83 µs", "sharp")]
            file.write_text(page("endoflow sweep", "A", "b", ["w"], cards, [("Runs", "<p>x</p>")], file.parent))
            browser.prefer("dark")
            browser.open(file, READY)
            ground = "getComputedStyle(document.body).backgroundColor"
            dark = browser.evaluate(ground)
            browser.evaluate("document.getElementById('theme-toggle').click()")
            self.assertNotEqual(browser.evaluate(ground), dark)
            self.assertIn("0.83 µs", browser.evaluate("document.body.innerText"))
            self.assertEqual(browser.problems, [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
