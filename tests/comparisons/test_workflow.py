"""cases/Snakefile, executed by Snakemake: what is missing is run, what was interrupted goes on, what is there is left alone.

    ENDOFLOW_PROGRAM=build/endoflow python3 tests/comparisons/test_workflow.py
"""

import json
import os
import shutil
import signal
import subprocess
import time
import unittest

import locations
from scratch import scratch_directory

PROGRAM = os.path.abspath(os.environ.get("ENDOFLOW_PROGRAM", "endoflow"))


@unittest.skipUnless(shutil.which("snakemake"), "snakemake is not installed (Debian package snakemake)")
@unittest.skipUnless(os.access(PROGRAM, os.X_OK), "ENDOFLOW_PROGRAM names no program")
class Workflow(unittest.TestCase):
    def setUp(self):
        self.scratch = scratch_directory(self)

    def snakemake(self, until, *words):
        """The command line, for runs to `until` µs; words: options or targets."""
        snakefile = str(locations.ROOT / "cases" / "Snakefile")
        return ["snakemake", "--snakefile", snakefile, *words, "--cores", "2", "--config", f"endoflow={PROGRAM}", f"until={until}"]

    def execute(self, until, *words):
        """What Snakemake says; it must succeed."""
        process = subprocess.run(self.snakemake(until, *words), cwd=self.scratch, capture_output=True, text=True, timeout=1200)
        self.assertEqual(process.returncode, 0, process.stderr)
        return process.stdout + process.stderr

    def record(self, radius):
        return json.loads((self.scratch / f"out/workflow/runs/{radius}/run.json").read_text())

    def test_executed(self):
        self.assertIn("run boundary-integral", self.execute(0.01, "--dry-run", "--printshellcmds"))
        self.execute(0.01)
        for radius in (28, 36, 44):
            self.assertEqual((self.record(radius)["state"], self.record(radius)["parameters"]["molecules"]["patch_radius"]), ("finished", radius))
        for radius in (28, 36):
            self.assertTrue((self.scratch / f"out/workflow/pairs/{radius}/report.html").is_file())
        self.assertIn("Nothing to be done", self.execute(0.01))

    def test_an_interrupted_run_goes_on(self):
        """Ctrl-C in a terminal reaches Snakemake and the program; the workflow called again continues the run."""
        target = "out/workflow/runs/36.done"
        running = subprocess.Popen(
            self.snakemake(20, target),
            cwd=self.scratch,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        history = self.scratch / "out/workflow/runs/36/history.csv"
        for _ in range(2400):
            if history.exists() and history.read_text().count("\n") > 3:
                break
            time.sleep(0.05)
        os.killpg(running.pid, signal.SIGINT)
        running.wait(600)
        self.assertEqual(self.record(36)["state"], "interrupted")
        self.assertFalse((self.scratch / target).exists())
        self.execute(1.05 * self.record(36)["time_us"], target)
        self.assertEqual((self.record(36)["state"], self.record(36)["restarts"]), ("finished", 1))


if __name__ == "__main__":
    unittest.main()
