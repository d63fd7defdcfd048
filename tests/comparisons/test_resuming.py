"""What `endoflow sweep` runs again, continues, leaves out; failures and Ctrl-C."""

import json
import signal
import time
import unittest

import locations  # noqa: F401
import synthetic
from studies import BOUNDARY_INTEGRAL, PATCHES, SweepTest


class Resuming(SweepTest):
    def test_finished_runs_are_not_repeated(self):
        self.sweep("--vary", PATCHES, *BOUNDARY_INTEGRAL, "-o", "s")
        self.assertEqual(len(self.runs()), 3)
        process = self.sweep("--vary", "molecules.patch_radius=20,30,40,60", *BOUNDARY_INTEGRAL, "-o", "s")
        self.assertEqual(self.runs(), ["s/patch_radius=30/boundary-integral fresh"])
        self.assertIn("3 finished before", process.stdout)
        self.sweep(
            "--vary", PATCHES, *BOUNDARY_INTEGRAL, "-o", "s", "--set", "phase_field.epsilon=2"
        )  # not its engine's
        self.assertEqual(self.runs(), [])
        self.sweep("--vary", PATCHES, *BOUNDARY_INTEGRAL, "-o", "s", "--set", "fluid.viscosity_intracellular=0.02")
        self.assertEqual([line.split()[1] for line in self.runs()], ["fresh"] * 3)

    def test_a_later_end_continues(self):
        self.sweep("--vary", "molecules.patch_radius=20", *BOUNDARY_INTEGRAL, "-o", "s", "--until", "0.5")
        self.runs()
        self.sweep("--vary", "molecules.patch_radius=20", *BOUNDARY_INTEGRAL, "-o", "s", "--until", "1")
        self.assertEqual(self.runs(), ["s/patch_radius=20/boundary-integral restart"])

    def test_an_earlier_end_takes_the_longer_run(self):
        patch = ("--vary", "molecules.patch_radius=20", *BOUNDARY_INTEGRAL, "-o", "s")
        self.sweep(*patch, "--until", "1")
        whole = self.rows("s")[0]
        self.runs()
        process = self.sweep(*patch, "--until", "0.5")
        self.assertEqual((process.returncode, self.runs()), (0, []))
        row = self.rows("s")[0]
        self.assertEqual((row["time_us"], row["state"], row["exit_reason"]), ("0.5", "finished", "done"))
        # Budding of the family is at 0.7346 µs, after the earlier end; history.csv has a row at 0.5 µs.
        self.assertEqual((whole["budding_time_us"][:5], row["budding_time_us"]), ("0.734", ""))
        height = synthetic.budding_membrane(0.5, 1.0).bud_height
        self.assertAlmostEqual(float(row["bud_height_nm"]), height, delta=1e-6)

    def test_alarms_have_a_column(self):
        patch = ("--vary", "molecules.patch_radius=20,30", *BOUNDARY_INTEGRAL, "-o", "s")
        self.sweep(*patch)
        file = self.scratch / "s/patch_radius=30/boundary-integral/run.json"
        file.write_text(json.dumps({**json.loads(file.read_text()), "alarms": [synthetic.ALARM]}))
        self.sweep(*patch)
        self.assertEqual([row["alarms"] for row in self.rows("s")], ["", "energy-balance"])
        self.assertIn("accuracy alarm: energy-balance", (self.scratch / "s/report.html").read_text())

    def test_runs_of_different_versions(self):
        """What is finished is not repeated, so a table may hold what another version has computed: it says so."""
        patch = ("--vary", "molecules.patch_radius=20,30", *BOUNDARY_INTEGRAL, "-o", "s")
        self.assertEqual(self.sweep(*patch).stderr, "")
        file = self.scratch / "s/patch_radius=30/boundary-integral/run.json"
        record = json.loads(file.read_text())
        file.write_text(json.dumps({**record, "segments": [{"version": "0.0.1", "git": "later"}]}))
        process = self.sweep(*patch)
        self.assert_one_line(process, 0, "warning: the runs were made by different versions of the program: 0.0.0 .synthetic., 0.0.1 .later.")
        self.assertEqual([row["program"] for row in self.rows("s")], ["0.0.0 (synthetic)", "0.0.0 (synthetic); 0.0.1 (later)"])
        self.assertIn("different versions", (self.scratch / "s/report.html").read_text())

    def test_one_failure_does_not_stop_the_others(self):
        process = self.sweep("--vary", "molecules.patch_radius=13,20,40", *BOUNDARY_INTEGRAL, "--jobs", "1")
        self.assert_one_line(process, 3, "patch_radius=13/boundary-integral: step-underflow: the step became too small")
        self.assertEqual([row["state"] for row in self.rows()], ["failed", "finished", "finished"])
        self.assertIn("step-underflow", self.rows()[0]["exit_reason"])
        self.assertEqual(self.rows()[0]["neck_radius_nm"], "")
        self.assertIn("1 failed", process.stdout)
        self.runs()
        self.sweep("--vary", "molecules.patch_radius=13,20,40", *BOUNDARY_INTEGRAL)
        self.assertEqual(self.runs(), ["out/case/sweep/patch_radius=13/boundary-integral fresh"])

    def test_interruption_stops_members_and_is_continued(self):
        vary = ("--vary", "molecules.patch_radius=20,30,40", *BOUNDARY_INTEGRAL, "--jobs", "1", "-o", "s")
        process = self.start("sweep", "case.toml", *vary, "--set", "case.name=slow")
        self.wait_for(self.scratch / "s/patch_radius=20/boundary-integral/ready")
        process.send_signal(signal.SIGINT)
        self.assert_interrupted(process, 130)
        self.assertEqual([row["state"] for row in self.rows("s")], ["interrupted", "not run", "not run"])
        self.runs()
        self.assertEqual(self.sweep(*vary).returncode, 0)
        self.assertEqual([line.split()[1] for line in self.runs()], ["restart", "fresh", "fresh"])

    def test_closed_terminal_stops_members(self):
        """SIGHUP: no member goes on running behind a sweep that is gone."""
        process = self.start("sweep", "case.toml", "--vary", "molecules.patch_radius=20", *BOUNDARY_INTEGRAL, "-o", "s",
                             "--set", "case.name=slow")
        self.wait_for(self.scratch / "s/patch_radius=20/boundary-integral/ready")
        process.send_signal(signal.SIGHUP)
        self.assert_interrupted(process, 129)
        self.assertEqual([row["state"] for row in self.rows("s")], ["interrupted"])

    def assert_interrupted(self, process, code):
        _, errors = process.communicate(timeout=1200)
        told = "endoflow sweep: interrupted; the same command continues\n"
        self.assertEqual((process.returncode, errors), (code, told))

    def wait_for(self, file):
        deadline = time.monotonic() + 120
        while not file.exists() and time.monotonic() < deadline:
            time.sleep(0.02)

    def test_collect_runs_nothing(self):
        self.sweep("--vary", "molecules.patch_radius=20", *BOUNDARY_INTEGRAL, "-o", "s")
        self.runs()
        process = self.sweep("--vary", "molecules.patch_radius=20,30", *BOUNDARY_INTEGRAL, "-o", "s", "--collect")
        self.assertEqual((process.returncode, self.runs()), (0, []))
        self.assertEqual([row["state"] for row in self.rows("s")], ["finished", "not run"])


if __name__ == "__main__":
    unittest.main()
