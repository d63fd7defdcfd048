"""A library ends the process in the middle of a run: the run's record, its log and stderr say so.

    python3 tests/reliability/test_sudden_end.py build/endoflow PATH/TO/liblibrary_that_ends.so [BoundaryIntegral] [PhaseField]
"""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from engines import COARSE, launcher, launcher_passes_on_last_words, options, texts  # noqa: E402
from scratch import scratch_directory  # noqa: E402

PROGRAM = LIBRARY = None


class AnyEngine:
    def setUp(self):
        self.directory = scratch_directory(self) / "run"

    def words(self, *settings, restart=False):
        words = [PROGRAM, "run", self.engine, "/dev/null", "-o", str(self.directory)]
        words += options((*texts(COARSE[self.engine]), "output.field_interval=0", *settings))
        return words + (["--restart"] if restart else [])

    def run_until(self, how, processes=1, on=0, at=None):
        """The run's exit code and its lines on stderr; the library ends process `on` by `how`."""
        ending = {"LD_PRELOAD": LIBRARY, "LIBRARY_ENDS_BY": how, "LIBRARY_ENDS_AT": str(at or self.calls),
                  "LIBRARY_ENDS_ON": str(on)}
        words = self.words("time.end=5", "output.checkpoint_interval=0")
        words = [*launcher(processes), "env", *(f"{key}={value}" for key, value in ending.items()), *words]
        result = subprocess.run(words, capture_output=True, text=True, timeout=600)
        return result.returncode, result.stderr.splitlines()

    def assert_tells(self, errors, *expected, processes=1):
        """run.json, log.txt and stderr end with one and the same message, which contains what is expected."""
        record = json.loads((self.directory / "run.json").read_text())
        self.assertEqual(record["state"], "failed")
        reason = record["exit_reason"]
        for text in ("unexpected-end", *expected):
            self.assertIn(text, reason)
        rows = (self.directory / "history.csv").read_text().splitlines()[1:]
        reached = float(rows[-1].split(",")[0]) if rows else 0
        self.assertEqual(record["steps"]["accepted"], len(rows))
        self.assertAlmostEqual(record["time_us"], reached, delta=1e-12 * reached)
        self.assertIn(f"({len(rows)} steps)", reason)
        self.assertTrue((self.directory / "log.txt").read_text().endswith(f" error failed: {reason}\n"))
        if processes == 1 or launcher_passes_on_last_words():
            self.assertIn(f"endoflow: {reason}", errors)
        self.assertEqual(sorted(file.name for file in self.directory.glob("*process*")), [])
        return errors

    def assert_last_word(self, errors, *expected):
        self.assertEqual(self.assert_tells(errors, *expected)[-1][:26], "endoflow: unexpected-end: ", errors)

    def assert_goes_on(self):
        """From the last checkpoint, by one step."""
        end = 1.001 * float((self.directory / "history.csv").read_text().splitlines()[-1].split(",")[0])
        subprocess.run(self.words(f"time.end={end:.17g}", restart=True), stdout=subprocess.DEVNULL, check=True)
        record = json.loads((self.directory / "run.json").read_text())
        self.assertEqual((record["state"], record["exit_reason"]), ("finished", "done"))

    def test_exit(self):
        for how in ("exit", "exit as if all were well"):
            with self.subTest(how):
                code, errors = self.run_until(how)
                self.assertEqual(code, 3, errors)
                self.assert_last_word(errors, "exit", "--restart")
        self.assert_goes_on()

    def test_signals(self):
        for how, code in (("abort", -6), ("segmentation fault", -11)):
            with self.subTest(how):
                found, errors = self.run_until(how)
                self.assertEqual(found, code, errors)
                self.assert_last_word(errors, {-6: "SIGABRT", -11: "SIGSEGV"}[code])

    def test_before_the_first_checkpoint(self):
        _, errors = self.run_until("exit", at=1)
        self.assert_last_word(errors, "start again")


class BoundaryIntegral(AnyEngine, unittest.TestCase):
    engine = "boundary-integral"
    calls = 300


class PhaseField(AnyEngine, unittest.TestCase):
    engine = "phase-field"
    calls = 40

    def test_mpi(self):
        for how, expected in (("MPI_Abort", "MPI_Abort"), ("MPI error", "invalid rank")):
            with self.subTest(how):
                code, errors = self.run_until(how)
                self.assertEqual(code, 3, errors)
                self.assert_last_word(errors, expected)

    def test_first_of_two_processes(self):
        code, errors = self.run_until("exit", processes=2)
        self.assertEqual(code, 3, errors)
        self.assert_tells(errors, "exit", processes=2)
        self.assert_goes_on()

    def test_other_of_two_processes(self):
        """mpirun ends the first one, which says why."""
        for how, expected in (("exit", "exit"), ("abort", "SIGABRT"), ("MPI_Abort", "MPI_Abort"),
                              ("kill", "without a word")):
            with self.subTest(how):
                code, errors = self.run_until(how, processes=2, on=1)
                self.assertNotEqual(code, 0, errors)
                self.assert_tells(errors, expected, "process ", processes=2)


if __name__ == "__main__":
    PROGRAM, LIBRARY = (str(Path(sys.argv.pop(1)).resolve()) for _ in range(2))
    os.environ.pop("LD_PRELOAD", None)
    unittest.main()
