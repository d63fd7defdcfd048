"""Names that a file system takes, and a shell's user finds odd: commands work in such directories, and pages can be read."""

import os
import subprocess
import sys
import unittest
from pathlib import Path

import locations
import synthetic
from command import CommandTest
from scratch import scratch_directory

from endoflow.errors import RunDirectoryError, last_word

#: As bytes: no UTF-8, blanks and quotes, a line break and markup, what plots take for a formula, what ffmpeg takes for a protocol.
NAMES = (b"a\xffb", b"sp ace \"q\" 's", b"l\nine<b>&", b"$x$ $", b"a:b", "漢字".encode())


def call(command, *arguments):
    """A command's finished process, with bytes."""
    words = [sys.executable, locations.COMPARISONS, command, *arguments]
    return subprocess.run(words, capture_output=True, timeout=1200)


class OddNames(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.scratch = scratch_directory(cls)
        cls.a, cls.b = synthetic.write_pair(cls.scratch, count=3)

    def test_compare_and_report(self):
        for number, name in enumerate(NAMES):
            with self.subTest(name):
                run = self.scratch / os.fsdecode(name)
                self.a.rename(run)
                self.addCleanup(lambda run=run: run.exists() and run.rename(self.a))
                output = run / "out" if number < 2 else self.scratch / "out"
                for words in (("compare", run, self.b, "-o", output), ("report", run)):
                    done = call(*words)
                    self.assertEqual((done.returncode, done.stderr), (0, b""))
                    self.assertEqual(done.stdout.count(b"\n"), 7 if words[0] == "compare" else 1)
                page = (output / "report.html").read_text(encoding="utf-8")
                self.assertNotIn("ine<b>", page)
                run.rename(self.a)
        self.assertIn("a\\xffb", self.page_of(b"a\xffb"))

    def page_of(self, name):
        run = self.scratch / os.fsdecode(name)
        self.a.rename(run)
        call("compare", run, self.b, "-o", self.scratch / "page")
        run.rename(self.a)
        return (self.scratch / "page" / "report.html").read_text(encoding="utf-8")

    def test_errors_are_one_line(self):
        done = call("report", self.scratch / "no\nsuch")
        self.assertEqual((done.returncode, done.stderr.count(b"\n")), (4, 1))
        self.assertNotIn("\n", str(RunDirectoryError(Path("a\nb"), "is not", "look")))


class LastWords(unittest.TestCase):
    """What is said of a command that failed."""

    PAGE = (
        "-----------------------------------\nThere are not enough slots available in the system to satisfy the 4\n"
        "slots that were requested by the application:\n\n  ./endoflow\n\nEither request fewer slots.\n"
        "-----------------------------------\n"
    )

    def test_a_launcher_is_quoted_from_its_beginning(self):
        words = "There are not enough slots available in the system to satisfy the 4 slots that were requested by the application"
        self.assertEqual(last_word(self.PAGE), words)

    def test_the_program_comes_first(self):
        text = f"warning: slow\nendoflow: step-underflow: the step became too small\n{self.PAGE}"
        self.assertEqual(last_word(text), "step-underflow: the step became too small")

    def test_others(self):
        for text, word in (("", ""), ("\n--\n", ""), ("one\ntwo\n\n", "two"), ("Killed", "Killed")):
            self.assertEqual(last_word(text), word)


if __name__ == "__main__":
    unittest.main()
