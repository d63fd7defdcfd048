"""An added command is known to overview, dispatch, suggestions, manual page and completions: one file, a row in either language.

    python3 tests/cli/added_command/added_command_test.py build/tests_cli_added_command build
"""

import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tools" / "manual")]

import make_manual  # noqa: E402
from scratch import scratch_directory  # noqa: E402

#: The program with one row more, and the directory of the engines' programs.
PROGRAM = ENGINES = None

MODULE = '''
def run(options):
    print(f"called with {options.word}")
    return 0
'''

#: The row of comparisons/commands/options.py, and what it stands before.
ROW, BEFORE = (
    '    "hello": Command("Say a word.", lambda parser: parser.add_argument("word", help="what to say"), "hello.run"),\n',
    '    "certify": Command(',
)


class AddedCommand(unittest.TestCase):
    """The program with the row of cli/endoflow.cpp, as it would be installed, beside the scripts with the rest of the recipe."""

    @classmethod
    def setUpClass(cls):
        cls.root = scratch_directory(cls)
        cls.program, share = cls.root / "bin" / "endoflow", cls.root / "share" / "endoflow"
        cls.program.parent.mkdir()
        shutil.copy(PROGRAM, cls.program)
        for engine in ENGINES.glob("endoflow-*"):
            (cls.program.parent / engine.name).symlink_to(engine)
        for folder in ("comparisons", "python", "cases"):
            shutil.copytree(ROOT / folder, share / folder, ignore=shutil.ignore_patterns("__pycache__"))
        commands = share / "comparisons" / "commands"
        (commands / "hello.py").write_text(MODULE, encoding="utf-8")
        head, mark, tail = (commands / "options.py").read_text(encoding="utf-8").partition(BEFORE)
        (commands / "options.py").write_text(head + ROW + mark + tail, encoding="utf-8")

    def call(self, *words):
        return subprocess.run([self.program, *words], capture_output=True, text=True, cwd=self.root, timeout=600)

    def test_it_is_called(self):
        done = self.call("hello", "it")
        self.assertEqual((done.stdout, done.stderr, done.returncode), ("called with it\n", "", 0))

    def test_the_overview_has_its_line_and_words_are_compared_with_it(self):
        self.assertRegex(self.call("help").stdout, r"\n  endoflow hello WORD +say a word\n")
        self.assertIn("did you mean 'hello'?", self.call("helo").stderr)

    def test_manual_page_and_completions_have_it(self):
        make_manual.main(str(self.program), ROOT / "cases", self.root)
        self.assertIn(".SS endoflow hello\nSay a word.", (self.root / "endoflow.1").read_text(encoding="utf-8"))
        for name in ("endoflow.bash", "_endoflow", "endoflow.fish"):
            self.assertIn("hello", (self.root / name).read_text(encoding="utf-8"))


if __name__ == "__main__":
    PROGRAM, ENGINES = (Path(word).resolve() for word in (sys.argv.pop(1), sys.argv.pop(1)))
    unittest.main()
