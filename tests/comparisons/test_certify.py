"""`endoflow run ENGINE CASE --certify`: errors from more accurate runs; coverage over cases whose limits are known."""

import json
import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import locations  # noqa: F401
import synthetic
from comparisons.studies.certification import SAFETY, certificate, denser_settings, finer_settings, in_words, layer_parts, sharp_parts, thinner_settings
from comparisons.page.run_page import run_html
from engines import options
from scratch import scratch_directory
from studies import StudyTest

import endoflow

#: The sharp engine's budding times, refined until six digits stood: settings, µs (docs/results/sharp-refinement.md).
CONVERGED = (
    ((), 0.8259243),
    (("molecules.patch_radius=28", "time.end=1.3"), 1.19549),
    (("molecules.interface_width=2.4",), 0.93616),
    (("molecules.interface_width=0.6",), 0.78388),
)

#: Half of the last digit of most of them, µs.
LAST_DIGIT = 5e-6


class Numbers(unittest.TestCase):
    def setUp(self):
        self.scratch = scratch_directory(self)

    def run_at(self, name, offset):
        membrane = lambda t: synthetic.budding_membrane(t, 1.0, offset)  # noqa: E731
        synthetic.write_run(self.scratch / name, "phase-field", membrane, [0.0, 0.5, 1.0])
        return endoflow.load(self.scratch / name)

    def test_error_is_the_distance_to_the_finer_run(self):
        coarse, fine = self.run_at("coarse", 0.1), self.run_at("fine", 0.0)
        found = certificate(coarse, sharp_parts(coarse, fine, fine))
        self.assertEqual(found["time_us"], 1.0)
        for name in ("neck_radius_nm", "membrane_area_nm2"):
            distance = abs(coarse.history[name][-1] - fine.history[name][-1])
            self.assertAlmostEqual(found["values"][name]["error"], SAFETY * distance, delta=1e-9 * distance)
        budding = found["values"]["budding_time_us"]
        self.assertGreater(budding["error"], 0)
        self.assertEqual(budding["value"], coarse.event_time("budding"))

    def test_errors_that_cancel_are_added(self):
        """Elements move the membrane one way, steps the other: a run that is right by that is not certified to be."""
        run, denser, fine = self.run_at("run", 0.0), self.run_at("denser", 0.1), self.run_at("fine", 0.0)
        found = certificate(run, sharp_parts(run, denser, fine))["values"]["membrane_area_nm2"]
        distance = abs(denser.history["membrane_area_nm2"][-1] - fine.history["membrane_area_nm2"][-1])
        self.assertAlmostEqual(found["error"], 2 * SAFETY * distance, delta=1e-9 * distance)

    def test_a_layer_is_extrapolated_with_its_square(self):
        """The membrane lies 0.1 ε² off: at second order what two layers say of the limit is exact up to curvature."""
        thick, thin, limit = self.run_at("thick", 0.1), self.run_at("thin", 0.05), self.run_at("limit", 0.0)
        found = certificate(thick, layer_parts(thick, thick, thin, 0.5**0.5))["values"]["neck_radius_nm"]
        self.assertEqual(found["parts"]["space and time"], 0.0)
        exact = abs(thick.history["neck_radius_nm"][-1] - limit.history["neck_radius_nm"][-1])
        self.assertAlmostEqual(found["parts"]["layer"] / SAFETY, exact, delta=0.02 * exact)

    def test_what_a_run_has_not_gets_no_interval(self):
        flat = lambda t: synthetic.budding_membrane(0.1 * t, 1.0, 0.0)  # noqa: E731
        synthetic.write_run(self.scratch / "flat", "boundary-integral", flat, [0.0, 1.0])
        flat, fine = endoflow.load(self.scratch / "flat"), self.run_at("fine", 0.0)
        found = certificate(flat, sharp_parts(flat, fine, fine))
        self.assertNotIn("budding_time_us", found["values"])

    def test_runs_that_the_neck_ends(self):
        """Each is looked at where it ended; a radius that ends a run is no result of it."""
        coarse, fine = self.run_at("coarse", 0.1), self.run_at("fine", 0.0)
        for run, reason in ((coarse, "budded"), (fine, "neck-closed")):
            run.record["exit_reason"] = reason
        found = certificate(coarse, sharp_parts(coarse, fine, fine))
        self.assertIsNone(found["time_us"])
        self.assertEqual([*found["values"]], ["budding_time_us", "membrane_area_nm2"])

    def test_words(self):
        entry = {"value": 0.82588873, "error": 4.1e-5, "unit": "µs"}
        self.assertEqual(in_words(entry), "0.82589 ± 0.00004 µs")
        self.assertEqual(in_words({"value": 25004.1, "error": 12.0, "unit": "nm²"}), "25004 ± 12 nm²")
        self.assertEqual(in_words({"value": 5.0, "error": 0.0, "unit": "nm"}), "5 ± 0 nm")


class Settings(unittest.TestCase):
    def settings(self, engine, notes=None, **changes):
        parameters = synthetic.parameters(**{"phase_field__cell_size": 0.0, **changes})
        return dict(text.split("=") for text in finer_settings(engine, parameters, notes or {}))

    def test_elements_and_steps_of_the_sharp_engine(self):
        found = self.settings("boundary-integral")
        self.assertEqual(found["boundary_integral.elements"], "48")
        self.assertEqual(float(found["time.tolerance"]), 1e-5)
        denser = dict(text.split("=") for text in denser_settings(synthetic.parameters(), {}))
        self.assertEqual(denser["boundary_integral.elements"], "48")
        self.assertEqual(float(denser["time.tolerance"]), 1e-4)

    def test_cells_of_the_diffuse_engine(self):
        found = self.settings("phase-field", {"cell_size_nm": 1.2})
        self.assertAlmostEqual(float(found["phase_field.cell_size"]), 1.2 / 2**0.5, places=9)
        self.assertEqual(float(found["time.tolerance"]), 1e-5)
        thinner = dict(text.split("=") for text in thinner_settings(synthetic.parameters(phase_field__cell_size=0.0)))
        self.assertAlmostEqual(float(thinner["phase_field.epsilon"]), 1.2 / 2**0.5, places=9)
        self.assertNotIn("phase_field.cell_size", thinner)


class Command(StudyTest):
    def certify(self, engine, *arguments):
        return self.call("certify", engine, "case.toml", "--certify", "-o", "out", *arguments)

    def certificate(self):
        return json.loads((self.scratch / "out" / "run.json").read_text())["certificate"]

    def test_sharp(self):
        result = self.certify("boundary-integral", "--set", "time.tolerance=2e-3")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.runs(), ["out fresh", "out/certify/denser fresh", "out/certify/finer fresh"])
        self.assertRegex(result.stdout, r"budding +[\d.]+ ± [\d.]+ µs")
        self.assertGreater(self.certificate()["values"]["neck_radius_nm"]["error"], 0)
        page = run_html(endoflow.load(self.scratch / "out"), {}, self.scratch)
        self.assertIn("Certified", page)
        # Once more: nothing is computed again.
        self.assertEqual(self.certify("boundary-integral", "--set", "time.tolerance=2e-3").returncode, 0)
        self.assertEqual(self.runs(), [])

    def test_diffuse_adds_its_layer(self):
        result = self.certify("phase-field")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.runs(), ["out fresh", "out/certify/finer fresh", "out/certify/thinner fresh"])
        parts = self.certificate()["values"]["membrane_area_nm2"]["parts"]
        self.assertEqual([*parts], ["space and time", "layer"])
        self.assertGreater(parts["layer"], 0)

    def test_a_run_that_fails(self):
        result = self.certify("boundary-integral", "--set", "molecules.patch_radius=13")
        self.assert_one_line(result, 3, "step-underflow")
        self.assertEqual(self.runs(), ["out fresh"])

    def test_interrupted_and_continued(self):
        (self.scratch / "case.toml").write_text('[case]\nname = "slow"\n')
        process = self.start("certify", "boundary-integral", "case.toml", "--certify", "-o", "out")
        while not (self.scratch / "out" / "ready").exists():
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertIn("the same command continues", errors)
        self.runs()
        (self.scratch / "case.toml").write_text("")
        self.assertEqual(self.certify("boundary-integral").returncode, 0)
        self.assertEqual(self.runs(), ["out restart", "out/certify/denser fresh", "out/certify/finer fresh"])


class Coverage(unittest.TestCase):
    def test_intervals_hold_the_converged_values(self):
        """Each interval holds the limit, also of an edge not resolved, and is no wider than five times the error.

        A run that is right to 1e-4 by luck, its errors of space and time being opposite, may be given 5e-4.
        """
        program = os.environ["ENDOFLOW_PROGRAM"]
        for settings, converged in CONVERGED:
            with self.subTest(settings), tempfile.TemporaryDirectory() as scratch:
                chosen = ("output.stop_at_budding=true", "output.field_interval=0", "time.end=1", *settings)
                run = [program, "run", "boundary-integral", "standard", "--certify", "-o", f"{scratch}/run", *options(chosen)]
                result = subprocess.run(run, capture_output=True, text=True, timeout=1200)
                self.assertEqual(result.returncode, 0, result.stderr)
                record = json.loads((Path(scratch) / "run" / "run.json").read_text())
                found = record["certificate"]["values"]["budding_time_us"]
                error = abs(found["value"] - converged)
                self.assertLessEqual(error, found["error"] + LAST_DIGIT)
                self.assertLessEqual(found["error"], max(5 * error, 5e-4 * converged))
                summary = subprocess.run([program, "summary", f"{scratch}/run"], capture_output=True, text=True)
                self.assertRegex(summary.stdout, r"certified: budding [\d.]+ ± [\d.]+ µs")


if __name__ == "__main__":
    unittest.main()
