"""A run in trouble with its directory: one clear error and exit code 4, or no trouble at all.

    python3 tests/reliability/test_trouble.py build/endoflow
"""

import resource
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import h5py

PROGRAM = None


class Trouble(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.directory = Path(holder.name) / "run"

    def start(self, *settings, **how):
        words = [PROGRAM, "run", "boundary-integral", "/dev/null", "-o", self.directory]
        for setting in ("boundary_integral.elements=24", "boundary_integral.threads=1", "output.field_interval=0",
                        "output.checkpoint_interval=0", "output.shape_interval=0.0005", *settings):
            words += ["--set", setting]
        return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **how)

    def assert_io_error(self, process, word):
        _, errors = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 4, errors)
        self.assertEqual(len(errors.strip().splitlines()), 1, errors)
        self.assertIn(word, errors)

    def wait_for_rows(self, process, count):
        history = self.directory / "history.csv"
        while process.poll() is None and not (history.exists() and history.read_text().count("\n") > count):
            time.sleep(0.02)

    def test_disk_full(self):
        """A limit to the size of files acts as a full disk does, at every place where files grow."""
        for size in (0, 100, 1000, 5000, 20000, 50000):
            with self.subTest(size):
                limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))  # noqa: E731
                self.assert_io_error(self.start("time.end=5", preexec_fn=limit), str(self.directory))
                shutil.rmtree(self.directory, ignore_errors=True)

    def test_directory_removed_while_running(self):
        process = self.start("time.end=5")
        self.wait_for_rows(process, 3)
        self.directory.rename(self.directory.with_name("moved"))
        self.assert_io_error(process, str(self.directory))

    def test_somebody_reads_the_shapes(self):
        process = self.start("time.end=0.01")
        self.wait_for_rows(process, 1)
        with h5py.File(self.directory / "shapes.h5", "r"):
            _, errors = process.communicate(timeout=300)
        self.assertEqual((process.returncode, errors), (0, ""))
        with h5py.File(self.directory / "shapes.h5", "r") as file:
            self.assertEqual(len(file["shapes"]), 21)


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
