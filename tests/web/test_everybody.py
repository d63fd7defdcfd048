#!/usr/bin/env python3
"""The laboratory for everybody: its tour, its keys, names for those who hear it, narrow windows, contrast."""

import pathlib
import re
import unittest

from laboratory_page import SHORT, Page, needs_page


@needs_page
class ForEverybody(Page):
    """The tour, keyboard, screen readers, small windows, motion."""

    def test_the_tour_sets_the_laboratory(self):
        self.open()
        self.press("tour-open")
        titles = []
        for step in range(1, 7):
            self.wait(f"document.getElementById('tour-place').textContent === 'Step {step} of 6'")
            self.wait("laboratory.run.rows.length > 1 && laboratory.state !== 'failed'")
            titles.append(self.browser.evaluate("document.activeElement.textContent"))
            self.press("tour-next")
        self.assertEqual(len(set(titles)), 6)
        self.assertEqual(self.browser.evaluate("laboratory.settings.values"), {"fluid.dynamics": "geometric"})

    def test_keys_go_through_time(self):
        self.open(SHORT)
        self.wait("laboratory.state === 'ended'")
        last = self.browser.evaluate("laboratory.run.frames.length - 1")
        self.browser.evaluate("document.getElementById('stage').focus()")
        self.browser.press("ArrowLeft")
        self.wait(f"document.getElementById('when').value === '{last - 1}'")
        self.browser.press("Home")
        self.wait("document.getElementById('stage').getAttribute('aria-label').includes('at 0 microseconds')")
        self.browser.press("ArrowRight")
        self.wait("document.getElementById('when').value === '1'")

    def test_everything_has_a_name(self):
        self.open("time.end=0.3")  # there is a neck by then
        self.wait("laboratory.state === 'ended'")
        self.browser.evaluate("document.getElementById('all').open = true")
        parts = self.browser.named_parts()
        controls = [part for part in parts if part[0] in ("button", "slider", "textbox", "combobox", "checkbox", "link", "image", "DisclosureTriangle")]
        self.assertGreater(len(controls), 80)
        self.assertEqual([part for part in controls if not part[1].strip()], [])
        images = [name for role, name, _ in parts if role == "image"]
        self.assertEqual(len(images), 4)
        for name, unit in zip(images, ("nm", "nm", "nm", "pN nm")):
            self.assertIn(unit, name)
            self.assertRegex(name, r"\d")

    def test_tab_reaches_everything_in_the_page_s_order(self):
        self.open(SHORT)
        self.wait("laboratory.state === 'ended'")
        wanted = self.browser.evaluate(
            """[...document.querySelectorAll("a[href], button, input, select, summary, [tabindex='0']")]
            .filter((part) => part.checkVisibility() && !part.disabled).map((part) => part.id || part.textContent)"""
        )
        reached = []
        for _ in wanted:
            self.browser.press("Tab")
            reached.append(self.browser.evaluate("document.activeElement.id || document.activeElement.textContent"))
        self.assertEqual(reached, wanted)

    def test_no_window_is_too_narrow(self):
        """A laptop's at 200 % and 400 %, a phone's: WCAG 2.2, 1.4.4 and 1.4.10."""
        self.open(SHORT)
        for width, height in ((683, 384), (390, 844), (320, 640)):
            with self.subTest(width=width):
                self.browser.resize(width, height)
                self.browser.evaluate("document.getElementById('all').open = true")
                self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), width)

    def test_reduced_motion_shows_the_end_alone(self):
        self.browser.prefer("light", motion="reduce")
        self.open(SHORT, ready="window.laboratory?.state === 'running'")
        self.browser.evaluate(
            """(() => { const { stage } = laboratory, draw = stage.draw.bind(stage); window.drawn = new Set();
            stage.draw = (frame, kept) => { drawn.add(frame?.time); draw(frame, kept); }; })()"""
        )
        self.wait("laboratory.state === 'ended'")
        self.wait("drawn.has(laboratory.run.frames.at(-1).time)")
        self.assertLessEqual(self.browser.evaluate("drawn.size"), 2)


def luminance(colour):
    """Relative luminance of "#rrggbb" (WCAG 2.2)."""
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), linear))


class Contrast(unittest.TestCase):
    """WCAG 2.2, 1.4.3 and 1.4.11: 4.5 for text, 3 for what has to be seen without being read."""

    TEXT = ["ink page", "ink panel", "muted page", "muted panel", "muted outside", "muted inside", "ink inside",
            "coated panel", "on-accent accent", "warn-ink warn", "bad-ink bad"]  # fmt: skip
    SEEN = ["control panel", "control page", "focus page", "focus panel", "accent panel", "kept panel", "kept inside",
            "kept outside", "bare inside", "bare outside", "coated inside", "coated outside"]  # fmt: skip

    def test_of_both_themes(self):
        style = (pathlib.Path(__file__).resolve().parents[2] / "web" / "page" / "style.css").read_text(encoding="utf-8")
        themes = [dict(re.findall(r"--([\w-]+): (#\w{6})", block)) for block in re.findall(r":root \{(.*?)\}", style, re.S)]
        self.assertEqual(len(themes), 2)
        for theme in themes:
            for least, pairs in ((4.5, self.TEXT), (3, self.SEEN)):
                for pair in pairs:
                    dark, light = sorted(luminance(theme[name]) for name in pair.split())
                    self.assertGreaterEqual((light + 0.05) / (dark + 0.05), least, pair)


if __name__ == "__main__":
    unittest.main(verbosity=2)
