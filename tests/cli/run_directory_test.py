"""Runs that meet in one directory, restarts that ask for less, for nothing or for another problem.

    python3 run_directory_test.py PATH/TO/endoflow [BoundaryIntegral] [PhaseField]
"""

import fcntl
import json
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1]))

from engines import COARSE, launcher_passes_on_last_words, options, texts  # noqa: E402
from scratch import scratch_directory  # noqa: E402

PROGRAM = None

SMALL = {
    "boundary-integral": ("boundary_integral.elements=24", "boundary_integral.threads=1"),
    "phase-field": texts(COARSE["phase-field"]),
}


def files(directory):
    return {path.relative_to(directory): path.read_bytes() for path in directory.rglob("*") if path.is_file()}


class AnyEngine:
    def setUp(self):
        self.directory = scratch_directory(self) / "run"

    @classmethod
    def setUpClass(cls):
        cls.finished = scratch_directory(cls) / "run"
        subprocess.run(cls.words(cls.finished, "time.end=5e-5"), stdout=subprocess.DEVNULL, check=True)

    @classmethod
    def words(cls, directory, *settings, restart=False):
        words = [PROGRAM, "run", cls.engine, "/dev/null", "-o", str(directory)]
        words += options((*SMALL[cls.engine], "output.field_interval=0", *settings))
        return words + (["--restart"] if restart else [])

    def run_with(self, *settings, restart=False, launcher=()):
        return subprocess.run([*launcher, *self.words(self.directory, *settings, restart=restart)],
                              capture_output=True, text=True, timeout=1200)

    def copy_finished_run(self):
        shutil.copytree(self.finished, self.directory)
        return files(self.directory)

    def assert_refused(self, result, code, *words):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stderr.count("endoflow: "), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_second_run_in_the_same_directory(self):
        """It says who has the directory, and neither changes anything nor is held up by a run that was killed."""
        first = subprocess.Popen(self.words(self.directory, "time.end=5"), stdout=subprocess.DEVNULL)
        history = self.directory / "history.csv"
        while first.poll() is None and not (history.exists() and history.read_text().count("\n") > 2):
            time.sleep(0.05)
        for restart in (False, True):
            second = self.run_with("molecules.patch_radius=22", restart=restart)
            self.assert_refused(second, 4, str(self.directory), "in use by process", f" {first.pid} ", os.uname().nodename)
        self.assertIsNone(first.poll())
        self.assertFalse((self.directory / "earlier").exists())
        first.kill()
        first.wait()
        third = self.run_with("time.end=2e-5")
        self.assertEqual(third.returncode, 0, third.stderr)
        self.assertTrue((self.directory / "earlier" / "1").exists())

    def test_restart_while_another_run_starts(self):
        """The earlier run.json has been moved away and the next one is not there yet: somebody has the directory."""
        self.directory.mkdir()
        with open(self.directory / "lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assert_refused(self.run_with("time.end=1e-4", restart=True), 4, "in use by another process")
        self.assert_refused(self.run_with("time.end=1e-4", restart=True), 4, "no run to continue")

    def test_restart_that_has_nothing_to_do(self):
        before = self.copy_finished_run()
        for end in ("5e-5", "1e-5", "1e-12"):
            with self.subTest(end):
                result = self.run_with(f"time.end={end}", restart=True)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertIn(f"already at t = 5e-05 µs, nothing to do; results in {self.directory}", result.stdout)
                self.assertEqual(files(self.directory), before)
        self.assert_refused(self.run_with("time.end=0", restart=True), 2, "time.end", "> 0")
        self.assertEqual(files(self.directory), before)

    def test_restart_with_another_problem(self):
        before = self.copy_finished_run()
        for key, value in (("molecules.patch_radius", "21"), ("membrane.constitutive_law", "lumped"),
                           ("fluid.viscosity_intracellular", "0.02"), self.own_setting):
            with self.subTest(key):
                result = self.run_with("time.end=1", f"{key}={value}", restart=True)
                self.assert_refused(result, 2, key, "a restart cannot change")
                self.assertEqual(files(self.directory), before)
        result = self.run_with("time.end=6e-5", "output.shape_interval=2e-5", restart=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        segments = json.loads((self.directory / "run.json").read_text())["segments"]
        self.assertEqual([part["parameters"]["time.end"] for part in segments], [5e-5, 6e-5])
        self.assertEqual([part["parameters"]["output.shape_interval"] for part in segments], [0, 2e-5])

    def test_damaged_copy_of_the_shapes(self):
        self.copy_finished_run()
        copy, shapes = self.directory / "checkpoint" / "shapes.h5", self.directory / "shapes.h5"
        intact = shapes.read_bytes()
        copy.write_bytes(copy.read_bytes()[:3000])
        result = self.run_with("time.end=5e-5", restart=True)
        self.assertEqual((result.returncode, shapes.read_bytes()), (0, intact))
        shapes.write_bytes(intact[:3000])
        before = files(self.directory)
        self.assert_refused(self.run_with("time.end=1", restart=True), 4, "checkpoint/shapes.h5: cannot")
        self.assertEqual(files(self.directory), before)


class BoundaryIntegral(AnyEngine, unittest.TestCase):
    engine = "boundary-integral"
    own_setting = ("boundary_integral.elements", "32")

    def test_inaccurate_run_says_so(self):
        """An edge of the coat that 24 elements do not resolve: on the terminal, in run.json and in the summary."""
        result = self.run_with("time.end=1e-3", "molecules.interface_width=0.6")
        self.assertEqual(result.returncode, 0, result.stderr)
        alarms = json.loads((self.directory / "run.json").read_text())["alarms"]
        self.assertTrue(alarms)
        summary = subprocess.run([PROGRAM, "summary", str(self.directory)], capture_output=True, text=True).stdout
        for alarm in alarms:
            self.assertGreater(alarm["value"], alarm["bound"])
            self.assertEqual(result.stderr.count(f"warning: {alarm['name']} at t = "), 1)
            self.assertEqual(summary.count(f"alarm: {alarm['name']} at t = "), 1)
            self.assertIn("boundary_integral.elements", alarm["remedy"])

    def test_shapes_at_the_end_and_early(self):
        """A run shorter than output.shape_interval shows how the membrane moved."""
        self.assertEqual(self.run_with("time.end=0.01", "output.shape_interval=0.05").returncode, 0)
        with h5py.File(self.directory / "shapes.h5") as file:
            times = [float(shape.attrs["time"]) for shape in file["shapes"].values()]
        np.testing.assert_allclose(times, [0, *0.05 / 2.0 ** np.arange(8, 2, -1), 0.01], rtol=1e-12)

    def test_shape_at_the_event(self):
        """The last shape of a run that ends at budding is the one with a neck of 5 nm."""
        result = self.run_with("output.stop_at_budding=true", "molecules.interface_width=5", "time.end=5")
        self.assertEqual(result.returncode, 0, result.stderr)
        event = json.loads((self.directory / "run.json").read_text())["events"]["budding"]
        with h5py.File(self.directory / "shapes.h5") as file:
            times = [float(shape.attrs["time"]) for shape in file["shapes"].values()]
        self.assertEqual(times[-1], event["time_us"])
        self.assertEqual(times, sorted(set(times)))
        self.assertAlmostEqual(event["neck_radius_nm"], 5, delta=1e-6)

    def test_several_processes_are_refused(self):
        """mpirun, MPICH's and Slurm's launchers tell by the environment how many there are."""
        for variable in ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"):
            with self.subTest(variable):
                result = self.run_with("time.end=2e-5", launcher=["env", f"{variable}=2"])
                self.assert_refused(result, 2, "one process", "2 were started", "boundary_integral.threads")
                self.assertFalse(self.directory.exists())
        statics = subprocess.run(["env", "PMI_SIZE=2", PROGRAM, "statics", "/dev/null", "-o", str(self.directory)],
                                 capture_output=True, text=True, timeout=1200)
        self.assert_refused(statics, 2, "endoflow statics is one process")
        self.assertFalse(self.directory.exists())


class PhaseField(AnyEngine, unittest.TestCase):
    engine = "phase-field"
    own_setting = ("phase_field.epsilon", "5")

    def test_signals_to_mpirun(self):
        """It kills its processes soon after, in the middle of a step: run.json has a last word, and the run goes on."""
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                shutil.rmtree(self.directory, ignore_errors=True)
                words = self.words(self.directory, "time.end=5", "output.checkpoint_interval=0")
                process = subprocess.Popen(["mpirun", "-n", "2", "--oversubscribe", *words], stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, text=True)
                while process.poll() is None and not (self.directory / "checkpoint" / "state.h5").exists():
                    time.sleep(0.05)
                process.send_signal(number)
                told, errors = process.communicate(timeout=1200)
                if launcher_passes_on_last_words():
                    self.assertIn("interrupted", told, errors)
                self.assertEqual(json.loads((self.directory / "run.json").read_text())["state"], "interrupted")
                rows = (self.directory / "history.csv").read_text().splitlines()
                end = 1.2 * float(rows[-1].split(",")[0])
                result = self.run_with(f"time.end={end:.17g}", restart=True)
                self.assertEqual(result.returncode, 0, result.stderr)

    def test_interruption_within_a_step(self):
        """The first step takes iterations of half a second each: it is given up, and the run goes on from where it was."""
        fine = ("phase_field.epsilon=1", "phase_field.cell_size=1")
        process = subprocess.Popen(self.words(self.directory, *fine, "time.end=5"), stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        history = self.directory / "history.csv"
        while process.poll() is None and not (history.exists() and history.read_text().count("\n") > 1):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        told, errors = process.communicate(timeout=1200)
        self.assertEqual((process.returncode, errors), (130, ""))
        self.assertIn("interrupted, checkpoint written, at t = 0 µs", told)
        self.assertEqual(history.read_text().count("\n"), 2)
        self.assertEqual(self.run_with(*fine, "time.end=1e-7", restart=True).returncode, 0)
        self.assertEqual(history.read_text().count("\n"), 3)

    def test_early_shapes_of_both_schemes(self):
        """Shapes stand at the times of the other engine, and no step ends there for their sake."""
        for scheme in ("paper", "production"):
            with self.subTest(scheme):
                shutil.rmtree(self.directory, ignore_errors=True)
                result = self.run_with(f"phase_field.scheme={scheme}", "time.end=1e-4", "output.shape_interval=8e-5")
                self.assertEqual(result.returncode, 0, result.stderr)
                with h5py.File(self.directory / "shapes.h5") as file:
                    shapes = [(float(shape.attrs["time"]), shape["z"][0]) for shape in file["shapes"].values()]
                times, heights = zip(*shapes)
                np.testing.assert_allclose(times, [0, *8e-5 / 2.0 ** np.arange(8, -1, -1), 1e-4], rtol=1e-12)
                self.assertTrue(np.all(np.diff(heights) > 0), heights)
                rows = np.genfromtxt(self.directory / "history.csv", delimiter=",", names=True)
                self.assertFalse(set(times[1:-1]) & set(rows["time_us"]))

    def test_several_processes_and_a_directory_in_use(self):
        """The first process owns the lock; all end when it does not get it, and when there is nothing to do."""
        self.copy_finished_run()
        mpirun = ("mpirun", "-n", "2", "--oversubscribe")
        result = self.run_with("time.end=5e-5", restart=True, launcher=mpirun)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(result.stdout.count("nothing to do"), 1)
        with open(self.directory / "lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            result = self.run_with("time.end=1", restart=True, launcher=mpirun)
        self.assert_refused(result, 4, "in use by another process")


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
