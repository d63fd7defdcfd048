"""Standard streams that are closed, full, narrow or that nobody reads: a run is not harmed, and says so at its end.

    python3 streams_test.py PATH/TO/endoflow
"""

import fcntl
import json
import os
import pty
import re
import struct
import subprocess
import sys
import termios
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from engines import options  # noqa: E402
from scratch import scratch_directory  # noqa: E402

PROGRAM = None
COLUMNS = 40


def run_words(directory, *settings):
    words = [PROGRAM, "run", "boundary-integral", "/dev/null", "-o", str(directory)]
    return words + options(("boundary_integral.elements=24", "boundary_integral.threads=1", "output.field_interval=0",
                            "molecules.interface_width=5", "time.end=1e-4", *settings))


class Streams(unittest.TestCase):
    def setUp(self):
        self.directory = scratch_directory(self) / "run"

    def assert_run_is_whole(self):
        record = json.loads((self.directory / "run.json").read_text())
        self.assertEqual((record["state"], record["exit_reason"]), ("finished", "done"))
        header, *rows = (self.directory / "history.csv").read_text().splitlines()
        self.assertEqual({row.count(",") for row in rows}, {header.count(",")})
        self.assertEqual(len(rows), record["steps"]["accepted"])

    def test_closed_streams(self):
        """What is printed must not end up in the file that was opened in a closed stream's place."""
        for closed, code in (("<&-", 0), (">&-", 4), ("2>&-", 0), ("<&- >&- 2>&-", 4)):
            with self.subTest(closed):
                result = subprocess.run(["bash", "-c", f'"$@" {closed}', "bash", *run_words(self.directory)],
                                        stdin=subprocess.DEVNULL, capture_output=True, timeout=1200)
                self.assertEqual(result.returncode, code, result.stderr)
                self.assert_run_is_whole()

    def test_nobody_reads_what_is_printed(self):
        """As with `| head`: the run goes on, and its exit code tells that the output was lost."""
        reader, writer = os.pipe()
        os.close(reader)
        result = subprocess.run(run_words(self.directory), stdout=writer, stderr=subprocess.PIPE, text=True, timeout=1200)
        os.close(writer)
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertEqual(result.stderr, "endoflow: standard output cannot be written: Broken pipe\n")
        self.assert_run_is_whole()

    def test_errors_that_nobody_takes(self):
        """A full disk behind stderr changes neither the exit code nor the run."""
        with open("/dev/full", "w") as full:
            refused = subprocess.run([PROGRAM, "check", "/dev/null", "--set", "a=b"], stderr=full, timeout=60)
            self.assertEqual(refused.returncode, 2)
            alarming = run_words(self.directory, "molecules.interface_width=0.6", "time.end=1e-3")
            self.assertEqual(subprocess.run(alarming, stdout=subprocess.DEVNULL, stderr=full, timeout=1200).returncode, 0)
        self.assertTrue(json.loads((self.directory / "run.json").read_text())["alarms"])

    def test_narrow_terminal(self):
        """The live line is rewritten in its place, so it must not wrap."""
        ours, its = pty.openpty()
        fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 24, COLUMNS, 0, 0))
        process = subprocess.Popen(run_words(self.directory), stdin=subprocess.DEVNULL, stdout=its, stderr=its)
        os.close(its)
        told = b""
        while True:
            try:
                told += os.read(ours, 4096)
            except OSError:  # the other end is closed
                break
        os.close(ours)
        self.assertEqual(process.wait(), 0)
        lines = re.findall("\r\x1b\\[K([^\r\n]*)", told.decode())
        self.assertTrue(lines, told)
        self.assertLess(max(map(len, lines)), COLUMNS)

    def test_path_with_control_characters(self):
        directory = self.directory.with_name("a\n\x1b[31mb")
        result = subprocess.run(run_words(directory), capture_output=True, text=True, timeout=1200)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("\x1b", result.stdout)
        self.assertEqual(result.stdout.splitlines()[-1].count("finished at"), 1)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
