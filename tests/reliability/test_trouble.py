"""A run in trouble with its directory: one clear error and exit code 4, or no trouble at all.

    python3 tests/reliability/test_trouble.py build/endoflow [BoundaryIntegral] [PhaseField]
"""

import json
import os
import resource
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

from engines import COARSE, options, texts  # noqa: E402
from scratch import scratch_directory  # noqa: E402

PROGRAM = None

ENGINES = {
    # name of the engine, settings of a run whose steps take a fraction of a second and that writes after every step
    "boundary-integral": (*texts(COARSE["boundary-integral"]), "boundary_integral.threads=1",
                          "output.shape_interval=0.0005"),
    "phase-field": texts(COARSE["phase-field"]),
}


def command(engine, directory, *settings, restart=False):
    words = [PROGRAM, "run", engine, "/dev/null", "-o", directory]
    words += options((*ENGINES[engine], "output.field_interval=0", "output.checkpoint_interval=0", *settings))
    return [str(word) for word in words] + (["--restart"] if restart else [])


def without_power_over_permissions(words):
    """Root may write everywhere; without these capabilities it may not."""
    if os.geteuid() != 0:
        return words
    return ["setpriv", "--bounding-set=-dac_override,-dac_read_search", *words]


def files(directory):
    return {file.relative_to(directory): file.read_bytes() for file in directory.rglob("*") if file.is_file()}


def limit_files(process, size):
    """No file grows beyond this size any more, and a write that would fails, as on a full disk."""
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (size, size))


def processes_of(program, directory):
    """The processes of a program that were started with this directory."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            words = (entry / "cmdline").read_text().split("\0")
        except OSError:  # it has just ended
            continue
        if Path(words[0]).name == program and str(directory) in words:
            found.append(int(entry.name))
    return found


class AnyEngine:
    """What every engine must bear."""

    @classmethod
    def setUpClass(cls):
        cls.finished = scratch_directory(cls) / "run"  # with two checkpoints, to be copied
        subprocess.run(command(cls.engine, cls.finished, "time.end=2e-5"), stdout=subprocess.DEVNULL, check=True)

    def setUp(self):
        self.directory = scratch_directory(self) / "run"

    def start(self, *settings, restart=False, **how):
        words = without_power_over_permissions(command(self.engine, self.directory, *settings, restart=restart))
        return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **how)

    def copy_finished_run(self):
        shutil.copytree(self.finished, self.directory)

    def assert_io_error(self, process, *words):
        """Exit code 4 and one line of ours; a library may have written lines of its own before it."""
        _, errors = process.communicate(timeout=1200)
        self.assertEqual(process.returncode, 4, errors)
        self.assertEqual(errors.count("endoflow: "), 1, errors)
        for word in words:
            self.assertIn(word, errors.splitlines()[-1])

    def assert_finishes(self, process):
        _, errors = process.communicate(timeout=1200)
        self.assertEqual((process.returncode, errors), (0, ""))

    def assert_goes_on(self, *settings):
        self.assert_finishes(self.start(*settings, restart=True))

    def assert_goes_on_from_its_history(self):
        last_row = (self.directory / "history.csv").read_text().splitlines()[-1]
        self.assert_goes_on(f"time.end={1.01 * float(last_row.split(',')[0]):.17g}")

    def shape_times(self):
        with h5py.File(self.directory / "shapes.h5") as file:
            return [float(shape.attrs["time"]) for shape in file["shapes"].values()]

    def wait_until(self, process, reached):
        while process.poll() is None and not reached():
            time.sleep(0.02)

    def wait_for_rows(self, process, count):
        history = self.directory / "history.csv"
        self.wait_until(process, lambda: history.exists() and history.read_text().count("\n") > count)

    def wait_for_checkpoints(self, process):
        self.wait_until(process, (self.directory / "checkpoint" / "state.previous.h5").exists)

    def test_directory_that_cannot_be_written(self):
        self.directory.mkdir(mode=0o555)
        self.assert_io_error(self.start(), str(self.directory), "not a writable directory")
        self.assertEqual(list(self.directory.iterdir()), [])

    def test_last_word_on_a_full_disk(self):
        """run.json does not go on saying that the run is at work."""
        process = self.start("time.end=5")
        self.wait_for_checkpoints(process)
        limit_files(process, 2000)
        self.assert_io_error(process, str(self.directory))
        self.assertEqual(json.loads((self.directory / "run.json").read_text())["state"], "failed")

    def test_directory_removed_while_running(self):
        process = self.start("time.end=5")
        self.wait_for_checkpoints(process)
        self.directory.rename(self.directory.with_name("moved"))
        self.assert_io_error(process, str(self.directory))
        self.assertFalse(self.directory.exists())

    def test_disk_full_after_a_checkpoint(self):
        process = self.start("time.end=5")
        self.wait_for_checkpoints(process)
        limit_files(process, 2000)
        self.assert_io_error(process, str(self.directory))
        self.assert_goes_on_from_its_history()

    def test_damaged_checkpoint(self):
        self.copy_finished_run()
        latest, previous = (self.directory / "checkpoint" / name for name in ("state.h5", "state.previous.h5"))
        latest.write_bytes(latest.read_bytes()[:20000])
        self.assert_goes_on("time.end=2e-5")
        for file in (latest, previous):
            file.write_bytes(file.read_bytes()[:20000])
        before = files(self.directory)
        self.assert_io_error(self.start(restart=True), "state.h5", "damaged")
        self.assertEqual(files(self.directory), before)


class BoundaryIntegral(AnyEngine, unittest.TestCase):
    engine = "boundary-integral"

    def test_disk_full(self):
        """At every place where files grow."""
        for size in (0, 100, 1000, 5000, 20000, 50000):
            with self.subTest(size):
                limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))  # noqa: E731
                self.assert_io_error(self.start("time.end=5", preexec_fn=limit), str(self.directory))
                shutil.rmtree(self.directory, ignore_errors=True)

    def test_somebody_reads_the_shapes(self):
        process = self.start("time.end=0.01")
        self.wait_for_rows(process, 1)
        with h5py.File(self.directory / "shapes.h5", "r"):
            self.assert_finishes(process)
        with h5py.File(self.directory / "shapes.h5", "r") as file:
            self.assertEqual(len(file["shapes"]), 21 + 8)  # and eight before the first multiple

    def test_shapes_of_a_continued_run_come_at_multiples_after_the_restart(self):
        """The restart is from where the integrator last started anew, 2e-5 µs or later."""
        often = "boundary_integral.restart_interval=5"
        _, errors = self.start("time.end=1e-4", often).communicate(timeout=1200)
        self.assertEqual(errors, "")
        self.assert_goes_on("time.end=1.6e-4", "output.shape_interval=2e-5", often)
        with h5py.File(self.directory / "checkpoint" / "state.h5") as file:
            self.assertGreater(file.attrs["time_us"], 2e-5)
        segments = json.loads((self.directory / "run.json").read_text())["segments"]
        later = [time for time in self.shape_times() if time > segments[-1]["begin_us"]]
        first = round(later[0] / 2e-5)
        self.assertGreaterEqual(first, 2)
        np.testing.assert_allclose(later, 2e-5 * np.arange(first, 9), rtol=1e-12)


class PhaseField(AnyEngine, unittest.TestCase):
    engine = "phase-field"

    def test_shapes_of_a_continued_run_come_at_multiples_after_the_restart(self):
        self.copy_finished_run()
        before = self.shape_times()
        self.assertEqual((before[0], before[-1]), (0, 2e-5))
        self.assert_goes_on("time.end=4e-5", "output.shape_interval=6e-6")
        np.testing.assert_allclose(self.shape_times(), [*before, 2.4e-5, 3e-5, 3.6e-5, 4e-5], rtol=1e-12)

    def test_directory_of_a_long_name(self):
        """MPI's own file beside the checkpoint's would have a name beyond its buffer."""
        self.directory = self.directory / ("a" * 140) / ("b" * 140)
        self.directory.mkdir(parents=True)
        self.assert_finishes(self.start("time.end=2e-5"))
        self.assert_goes_on("time.end=4e-5")

    def test_disk_full_while_vectors_are_written(self):
        """The saved vectors are by far the largest file, and are written by MPI, which says nothing."""
        process = self.start("time.end=5")
        self.wait_for_checkpoints(process)
        limit_files(process, 300000)
        self.assert_io_error(process, str(self.directory / "checkpoint"), "disk")
        self.assert_goes_on("time.end=1e-4")

    def test_disk_full_while_fields_are_written(self):
        process = self.start("time.end=5", "output.field_interval=1e-5")
        self.wait_until(process, (self.directory / "fields" / "fields_000000.vtu").exists)
        limit_files(process, (self.directory / "fields" / "fields_000000.vtu").stat().st_size // 2)
        self.assert_io_error(process, str(self.directory), "disk")

    def test_damaged_mesh(self):
        self.copy_finished_run()
        for name in ("mesh", "mesh.info", "mesh_fixed.data"):
            with self.subTest(name):
                shutil.rmtree(self.directory)
                self.copy_finished_run()
                for file in self.directory.glob(f"checkpoint/mesh-*/{name}"):
                    content = bytearray(file.read_bytes())
                    content[len(content) // 2] ^= 1
                    file.write_bytes(content)
                self.assert_io_error(self.start(restart=True), "checkpoint/mesh-", "damaged")

    def test_checkpoint_of_another_engine_or_scheme(self):
        self.copy_finished_run()
        process = self.start("phase_field.scheme=paper", restart=True)
        _, errors = process.communicate(timeout=1200)
        self.assertEqual(process.returncode, 2, errors)
        self.assertIn("phase_field.scheme", errors)
        shutil.rmtree(self.directory)
        subprocess.run(command("boundary-integral", self.directory, "time.end=2e-5"), stdout=subprocess.DEVNULL,
                       check=True)
        before = files(self.directory)
        self.assert_io_error(self.start(restart=True), "boundary-integral", "run without --restart")
        self.assertEqual(files(self.directory), before)

    def test_killed_process(self):
        """MPI ends the others; what was written is enough to go on, here with one process."""
        words = command(self.engine, self.directory, "time.end=5")
        process = subprocess.Popen(["mpirun", "-n", "2", *words], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        self.wait_for_checkpoints(process)
        ranks = processes_of("endoflow-phase-field", self.directory)
        self.assertEqual(len(ranks), 2, process.poll() and process.communicate())
        os.kill(ranks[-1], signal.SIGKILL)
        _, errors = process.communicate(timeout=1200)
        self.assertNotEqual(process.returncode, 0)
        self.assertIn("Killed", errors)
        self.assert_goes_on_from_its_history()


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
