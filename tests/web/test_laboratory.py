#!/usr/bin/env python3
"""The laboratory in a real browser: its numbers are the native engine's, its links and files round trips, and it asks nobody."""

import csv
import json
import math
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

from laboratory_page import PAGE, SHORT, VISIBLE, Page, needs_page

PROGRAM = os.environ.get("ENDOFLOW_PROGRAM", "build/endoflow")

# Both engines make the same steps, but sums in WebAssembly are added in another order: the integrator's steps then differ
# in their last digits. Budding times agree to some 1e-8.
SAME = 1e-6

CASES = {
    "": [],
    "molecules.patch_radius=28": ["molecules.patch_radius=28"],
    "fluid.dynamics=geometric": ["fluid.dynamics=geometric"],
}

# A request that the content security policy must refuse, from wherever it runs; resolves to the directive that refused it.
FORBIDDEN = """new Promise((resolve) => {
    addEventListener("securitypolicyviolation", (event) => resolve(event.effectiveDirective));
    fetch("http://localhost:9/").then(() => resolve("allowed"), () => setTimeout(() => resolve("failed otherwise"), 1000));
})"""

IN_A_WORKER = """new Promise((resolve) => {
    const source = `${%s}.then(postMessage)`;
    new Worker(URL.createObjectURL(new Blob([source]))).onmessage = ({ data }) => resolve(data);
})""" % json.dumps(FORBIDDEN)

# Pixels of a canvas that have a colour of the theme.
PIXELS = """((id, name) => {
    const canvas = document.getElementById(id), { width, height } = canvas;
    const hex = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    const colour = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
    const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) count += colour.every((value, k) => data[i + k] === value);
    return count;
})"""


# What is refused of the ends of all sliders, of all words and boxes; those that know of other settings one after the other, too.
EVERY_SLIDER = """(async () => {
    const { panel, settings, engine } = laboratory, begin = settings.values, refused = [];
    const seen = ({ input, element }) => !input.disabled && !element.hidden;
    const places = ({ input }) => input.type === "range" ? [() => { input.value = input.min; }, () => { input.value = input.max; }]
        : input.type === "checkbox" ? [() => { input.checked = !input.checked; }]
        : [...input.options].map(({ value }) => () => { input.value = value; });
    const put = (control, place) => {
        place();
        control.input.dispatchEvent(new Event(control.input.type === "range" ? "input" : "change"));
    };
    await engine.ask("stop");
    const anew = () => { settings.values = { ...begin }; panel.show(); };
    const check = async (said) => {
        const { error } = await engine.ask("check", { text: settings.toToml() });
        if (error) refused.push(`${said}: ${error}`);
    };
    const knows = ({ row }) => row.limits || row.implies || row.when;
    for (const first of panel.sliders) for (const place of places(first)) {
        anew();
        if (!seen(first)) continue;
        put(first, place);
        await check(first.row.key);
        const between = { ...settings.values };
        for (const second of knows(first) ? panel.sliders.filter(knows) : []) for (const other of places(second)) {
            settings.values = { ...between };
            panel.show();
            if (!seen(second)) continue;
            put(second, other);
            await check(`${first.row.key}, ${second.row.key}`);
        }
    }
    anew();
    clearTimeout(laboratory.soon);
    return refused;
})()"""


def native_run(settings, scratch):
    """Directory of a run of the native engine."""
    case = pathlib.Path(scratch) / "case.toml"
    case.write_text("")
    sets = [word for value in [*settings, "output.field_interval=0", "output.stop_at_budding=true"] for word in ("--set", value)]
    run = pathlib.Path(scratch) / "run"
    subprocess.run([PROGRAM, "run", "boundary-integral", case, "-o", run, *sets], check=True, stdout=subprocess.DEVNULL)
    return run


def native_budding(settings):
    """Budding time [µs] of the native engine."""
    with tempfile.TemporaryDirectory() as scratch:
        return json.loads((native_run(settings, scratch) / "run.json").read_text())["events"]["budding"]["time_us"]


@needs_page
class Laboratory(Page):
    """What it computes."""

    def test_budding_is_the_native_engine_s(self):
        for link, settings in CASES.items():
            with self.subTest(link):
                self.open(link)
                self.wait("laboratory.run.events.budding !== undefined")
                native = native_budding(settings)
                self.assertLess(abs(self.browser.evaluate("laboratory.run.events.budding.time_us") / native - 1), SAME)

    def budding_of_what_is_set(self):
        """Budding time [µs] of the settings that have just been moved."""
        self.wait("JSON.stringify(laboratory.run.values) === JSON.stringify(laboratory.settings.values)")
        self.wait("laboratory.run.events.budding !== undefined")
        return self.browser.evaluate("laboratory.run.events.budding.time_us")

    def test_actin_s_force_is_the_native_engine_s(self):
        """From the sliders, on its ring and, once that is taken away, on the rim."""
        self.open(SHORT)
        self.assertFalse(self.browser.evaluate(f"{VISIBLE}('slider-membrane-coat_force_ring')"))
        self.open()
        self.slide("membrane-coat_force", 20)
        self.assertTrue(self.browser.evaluate(f"{VISIBLE}('slider-membrane-coat_force_ring')"))
        force, ring = "membrane.coat_force=20", "membrane.coat_force_ring=[42.3, 54.9]"
        self.assertEqual(self.values(), {"membrane.coat_force": 20, "membrane.coat_force_ring": [42.3, 54.9]})
        found = [self.budding_of_what_is_set()]
        self.press("slider-membrane-coat_force_ring")
        self.assertEqual(self.values(), {"membrane.coat_force": 20})
        found.append(self.budding_of_what_is_set())
        for budding, settings in zip(found, ([force, ring], [force])):
            with self.subTest(settings=settings):
                self.assertLess(abs(budding / native_budding(settings) - 1), SAME)
        self.assertGreater(abs(found[0] / found[1] - 1), 1e-3)
        self.assertTrue(all(abs(budding / native_budding([]) - 1) > 1e-3 for budding in found))

    def test_a_coat_that_matures_is_the_native_engine_s(self):
        self.open()
        self.assertFalse(self.browser.evaluate(f"{VISIBLE}('maturity')"))
        self.slide("molecules-maturation", "cooperative")
        self.assertEqual(self.values()["molecules.maturation_rate"], 0.5)
        self.slide("molecules-maturation_rate", 600)
        self.slide("molecules-maturation_start", 0.1)
        values = self.values()
        wanted = {"molecules.maturation": "cooperative", "molecules.maturation_rate": 2.5, "molecules.maturation_start": 0.1}
        self.assertEqual(values, wanted)
        native = native_budding([f"{name}={value}" for name, value in values.items()])
        self.assertLess(abs(self.budding_of_what_is_set() / native - 1), SAME)
        self.assertTrue(self.browser.evaluate(f"{VISIBLE}('maturity')"))
        self.wait(f"{PIXELS}('maturity', '--accent') > 50")
        # χ = tanh(k t + artanh χ₀), as closely as the engine's tolerance has it.
        for row in self.browser.evaluate("laboratory.run.rows"):
            self.assertAlmostEqual(row["maturity"], math.tanh(2.5 * row["time"] + math.atanh(0.1)), delta=1e-4)
        self.slide("molecules-maturation", "none")
        self.assertEqual(self.values(), {})
        self.wait(f"!{VISIBLE}('maturity')")

    def test_wrong_input_is_refused_as_on_the_command_line(self):
        self.open()
        self.type("all-molecules-patch_radius", "-3")
        self.wait("laboratory.state === 'failed'")
        message = self.text("error")
        refused = subprocess.run([PROGRAM, "check", "/dev/null", "--set", "molecules.patch_radius=-3"], capture_output=True, text=True)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("molecules.patch_radius", message)
        self.assertIn("> 0", message)
        self.assertTrue(message.startswith("case.toml:2:"), message)
        self.type("all-molecules-patch_radius", "wide")
        self.wait("document.getElementById('error').textContent.includes('patch_radius is a string')")

    def test_what_stops_the_solver_is_said_with_its_remedy(self):
        self.open("membrane.pole_force=5000&boundary_integral.elements=12")
        self.wait("laboratory.state === 'stopped'")  # it buds
        self.press("stop")
        self.wait("laboratory.state === 'failed' || laboratory.state === 'ended'")
        self.assertRegex(self.text("error"), "^membrane-near-wall: .*; enlarge domain.radius or domain.height")
        self.assertEqual(self.text("verdict")[:10], "Buds after")
        self.assertRegex(self.text("warnings"), "area-strain at t = .*; leave boundary_integral.elements and time.tolerance at 0")

    def test_a_run_pauses_where_it_buds(self):
        self.open("time.end=0.9")
        self.wait("laboratory.state === 'stopped'")
        budding = self.browser.evaluate("laboratory.run.events.budding.time_us")
        times = self.browser.evaluate("laboratory.run.rows.map(({ time }) => time)")
        self.assertLess(budding, times[-1])
        self.assertEqual(self.text("verdict"), f"Buds after {budding:.4g} µs")
        self.press("stop")
        self.wait("laboratory.state === 'ended'")
        self.assertEqual(self.browser.evaluate("laboratory.run.rows.at(-1).time"), 0.9)

    def test_stop_and_continue_change_nothing(self):
        self.open("time.end=0.3")
        self.wait("laboratory.state === 'ended'")
        whole = self.browser.evaluate("laboratory.run.rows")
        self.open("time.end=0.3")
        self.press("stop")
        self.wait("laboratory.state === 'stopped'")
        stopped = self.browser.evaluate("laboratory.run.rows.length")
        self.assertLess(stopped, len(whole))
        self.browser.evaluate("new Promise((resolve) => setTimeout(resolve, 300))")
        self.assertEqual(self.browser.evaluate("laboratory.run.rows.length"), stopped)
        self.press("stop")
        self.wait("laboratory.state === 'ended'")
        self.assertEqual(self.browser.evaluate("laboratory.run.rows"), whole)

    def test_restart_begins_anew(self):
        self.open(SHORT)
        self.wait("laboratory.state === 'ended'")
        whole = self.browser.evaluate("laboratory.run.rows")
        self.press("restart")
        self.wait("laboratory.run.id === 2 && laboratory.state === 'ended'")
        self.assertEqual(self.browser.evaluate("laboratory.run.rows"), whole)

    def test_a_long_run_keeps_few_shapes(self):
        self.open(SHORT)
        self.wait("laboratory.state === 'ended'")
        self.browser.evaluate(
            """(() => { for (let i = 1; i <= 5000; ++i)
            laboratory.progress({ run: laboratory.run.id, rows: [], warnings: [], time_us: i, shape: new Float32Array(10) }); })()"""
        )
        times = self.browser.evaluate("laboratory.run.frames.map(({ time }) => time)")
        self.assertLessEqual(len(times), 1200)
        self.assertGreater(len(times), 500)
        self.assertEqual((times[0], times[-1]), (0, 5000))
        self.assertEqual(times, sorted(times))

    def test_a_kept_curve_stays_in_sight(self):
        self.open(SHORT)
        self.wait("laboratory.state === 'ended'")
        kept = self.browser.evaluate("laboratory.run.rows")
        self.assertEqual(self.browser.evaluate(f"{PIXELS}('height', '--kept')"), 0)
        self.press("keep")
        self.type("all-molecules-patch_radius", "30")
        self.wait("laboratory.run.rows.length > 3")
        self.assertEqual(self.browser.evaluate("laboratory.kept.rows"), kept)
        self.assertIn("end = 0.05", self.text("kept"))
        self.wait(f"{PIXELS}('height', '--kept') > 50")
        self.press("forget")
        self.wait(f"{PIXELS}('height', '--kept') === 0")


@needs_page
class TakenAlong(Page):
    """Links, files, and what must not leave the page."""

    def test_a_link_holds_all_settings(self):
        self.open("molecules.patch_radius=31.5&molecules.transport=fickian&membrane.inextensible=false")
        values = self.browser.evaluate("laboratory.settings.values")
        self.assertEqual(values, {"molecules.patch_radius": 31.5, "molecules.transport": "fickian", "membrane.inextensible": False})
        link = self.browser.evaluate("location.hash")
        self.open(link.removeprefix("#"))
        self.assertEqual(self.browser.evaluate("laboratory.settings.values"), values)
        self.open("no.such=1&molecules.patch_radius=30")
        self.assertEqual(self.browser.evaluate("laboratory.settings.values"), {"molecules.patch_radius": 30})
        self.assertIn("no.such=1", self.text("error"))

    def test_the_ring_follows_the_coat(self):
        link = "molecules.patch_radius=60&domain.radius=200&membrane.coat_force=10&membrane.coat_force_ring=80%2C120"
        self.open(link)
        self.assertEqual(self.browser.evaluate("location.hash"), f"#{link}")
        self.assertTrue(self.browser.evaluate("document.getElementById('slider-membrane-coat_force_ring').checked"))
        self.slide("molecules-patch_radius", 53)
        self.assertEqual(self.values()["membrane.coat_force_ring"], [74, 116])
        self.type("all-domain-radius", 109)
        self.assertEqual(self.values()["membrane.coat_force_ring"], [61, 77])
        self.slide("membrane-coat_force", 0)
        self.assertEqual(self.values(), {"molecules.patch_radius": 53, "domain.radius": 109})
        self.slide("membrane-coat_force", 20)
        self.assertEqual(self.values()["membrane.coat_force_ring"], [61, 77])

    def test_no_slider_asks_for_what_is_refused(self):
        """From each case of the list."""
        self.open()
        self.wait("laboratory.presetsRead === true")
        presets = self.browser.evaluate("[...document.getElementById('preset').options].map((o) => o.value).filter(Boolean)")
        for name in ["", *presets]:
            with self.subTest(name):
                if name:
                    self.type("preset", name)
                self.wait("laboratory.state !== 'loading' && laboratory.run.rows.length > 1")
                refused = self.browser.evaluate(EVERY_SLIDER)
                self.assertEqual(refused, [])

    def test_what_it_saves(self):
        settings = ["molecules.patch_radius=31.5", "molecules.transport=fickian", "time.end=0.01", "domain.radius=90"]
        self.open("&".join(settings))
        self.wait("laboratory.state === 'ended'")
        with tempfile.TemporaryDirectory() as scratch:
            saved = pathlib.Path(scratch) / "saved"
            saved.mkdir()
            self.browser.download_to(saved)

            def content(button, name):
                self.press(button)
                end = time.monotonic() + 60
                while not (saved / name).exists() and time.monotonic() < end:
                    self.browser.evaluate("new Promise((resolve) => setTimeout(resolve, 50))")
                return (saved / name).read_bytes()

            self.assertIn(b"patch_radius = 31.5", content("save-case", "case.toml"))
            subprocess.run([PROGRAM, "check", saved / "case.toml"], check=True, stdout=subprocess.DEVNULL)
            columns, *rows = csv.reader(content("save-history", "history.csv").decode().splitlines())
            native = (native_run(["time.end=1e-4"], scratch) / "history.csv").read_text()
            self.assertEqual(columns, native.splitlines()[0].split(","))
            self.assertEqual(len(rows), self.browser.evaluate("laboratory.run.rows.length"))
            self.assertEqual(float(rows[-1][0]), self.browser.evaluate("laboratory.run.rows.at(-1).time"))
            self.assertTrue(content("save-picture", "membrane.png").startswith(b"\x89PNG\r\n"))
            self.assertFalse(self.browser.evaluate("document.getElementById('save-film').hidden"))
            self.assertTrue(content("save-film", "membrane.webm").startswith(b"\x1a\x45\xdf\xa3"))

    def test_every_case_of_the_list_opens(self):
        self.open()
        self.wait("laboratory.presetsRead === true")
        for name in self.browser.evaluate("[...document.getElementById('preset').options].map((o) => o.value).filter(Boolean)"):
            with self.subTest(name):
                self.type("preset", name)
                self.wait("laboratory.state === 'running' && laboratory.run.rows.length > 1")
                self.assertEqual(self.browser.evaluate("document.getElementById('preset').value"), name)

    def test_axes_of_a_membrane_at_rest(self):
        """Heights are round-off before the first step of a membrane that starts flat."""
        self.open()
        row = "{time: 0, neck: null, height: 1e-15, energy: 0}"
        self.browser.evaluate(f"laboratory.charts[1].draw({{rows: [{row}], events: {{}}}}, null)")

    def test_axes_of_a_membrane_that_sinks(self):
        """Heights have a sign: the whole curve is seen."""
        self.open(SHORT)
        self.wait("laboratory.state === 'ended'")
        rows = "[0, 1, 2].map((i) => ({ time: i, neck: null, height: -20 * i, energy: 0 }))"
        self.browser.evaluate(f"laboratory.charts[1].draw({{ rows: {rows}, events: {{}} }}, null)")
        self.assertGreater(self.browser.evaluate(f"{PIXELS}('height', '--accent')"), 150)

    def test_no_request_leaves_the_page(self):
        self.open()
        self.assertEqual(self.browser.evaluate(FORBIDDEN), "connect-src")
        self.assertEqual(self.browser.evaluate(IN_A_WORKER), "connect-src")
        self.browser.problems.clear()  # of what was refused
        self.assertNotRegex(PAGE.read_text(encoding="utf-8"), r"""(?:src|href)=["']?(?:https?:)?//""")


if __name__ == "__main__":
    unittest.main(verbosity=2)
