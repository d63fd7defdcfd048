"""Exit codes and messages of `endoflow compare`."""

import signal
import subprocess
import time
import unittest

import locations  # noqa: F401
from command import CompareTest, compare, words

import synthetic


class Command(CompareTest):
    def assert_one_line(self, process, code, pattern):
        super().assert_one_line(process, code, pattern)
        self.assertEqual(process.stdout, "")

    def test_bad_command_line(self):
        for arguments in ((), (self.a,), (self.a, self.b, "--nonsense"), (self.a, self.b, "-o")):
            process = compare(*arguments)
            self.assertEqual(process.returncode, 2)
            self.assertIn("usage: endoflow compare", process.stderr)

    def test_missing_library(self):
        (self.scratch / "matplotlib.py").write_text("raise ModuleNotFoundError('No module named matplotlib', name='matplotlib')")
        process = compare(self.a, self.b, "-o", self.scratch / "never", PYTHONPATH=str(self.scratch))
        self.assert_one_line(process, 4, "lacks matplotlib .* install Debian's python3-matplotlib, or .* -m pip install matplotlib")

    def test_missing_run(self):
        self.assert_one_line(
            compare(self.a, self.scratch / "absent"),
            4,
            "endoflow compare: .*absent: no such directory; give the directory",
        )

    def test_damaged_run(self):
        broken = self.scratch / "broken"
        broken.mkdir()
        for name in ("run.json", "history.csv"):
            (broken / name).write_bytes((self.b / name).read_bytes())
        self.assert_one_line(compare(self.a, broken), 4, "shapes.h5: the file is missing; repeat the run")

    def test_no_common_time(self):
        late = synthetic.write_run(
            self.scratch / "late", "phase-field", lambda t: synthetic.budding_membrane(1.0, 1.0), [2.0, 3.0]
        )
        self.assert_one_line(compare(self.a, late), 2, "no common time")

    def test_output_cannot_be_written(self):
        (self.scratch / "file").write_text("")
        process = compare(self.a, self.b, "-o", self.scratch / "file" / "out")
        self.assert_one_line(process, 4, "file: is not a writable directory; choose another directory with -o")

    def test_interrupted(self):
        output = self.scratch / "interrupted"
        process = subprocess.Popen(
            words("compare", self.a, self.b, "-o", output), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        while not (output / "metrics.json").exists() and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=1200)
        self.assertEqual(process.returncode, 130)
        self.assertNotIn("Traceback", errors)


if __name__ == "__main__":
    unittest.main()
