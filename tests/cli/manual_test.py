"""Manual page and completions say what the program knows, and shells take them.

    python3 tests/cli/manual_test.py build/endoflow
"""

import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tools" / "manual")]

import described  # noqa: E402
import make_manual  # noqa: E402
from scratch import scratch_directory  # noqa: E402

PROGRAM = None


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = scratch_directory(cls)
        make_manual.main(PROGRAM, ROOT / "cases", cls.root)
        cls.commands, cls.parameters = described.commands(PROGRAM), described.parameters(PROGRAM)

    def text(self, name):
        return (self.root / name).read_text(encoding="utf-8")

    def test_every_command_is_described(self):
        """Those that the overview lists."""
        overview = subprocess.run([PROGRAM, "help"], capture_output=True, text=True, check=True).stdout
        listed = {line.split()[1] for line in overview.splitlines() if line.startswith("  endoflow ")}
        known = {words[0] for words in self.commands}
        self.assertEqual(listed - {"help", "--version"}, known)

    def test_every_option_and_parameter_is_there(self):
        page = self.text("endoflow.1").replace("\\-", "-")
        for words, command in self.commands.items():
            self.assertIn(f".SS endoflow {' '.join(words)}\n", page)
            for option in command["options"]:
                for name in option["names"]:
                    with self.subTest(command=words, option=name):
                        self.assertIn(f"\\fB{name}\\fR", page)
                        self.assertIn(name, self.text("endoflow.bash"))
                        self.assertIn(f"*{name}[", self.text("_endoflow"))
                        fish = f"-l {name[2:]} " if name.startswith("--") else f"-s {name[1:]}"
                        self.assertIn(fish, self.text("endoflow.fish"))
        for row in self.parameters:
            self.assertIn(f"\\fB{row['name']}\\fR", page)

    def test_bash_completes(self):
        for line, wanted in (
            (("endoflow", "sta"), ["statics"]),
            (("endoflow", "run", "b"), ["boundary-integral"]),
            (("endoflow", "check", "clo"), ["closed_vesicle"]),
            (("endoflow", "check", "standard", "--set", "molecules.patch_r"), ["molecules.patch_radius="]),
            (("endoflow", "infer", "--sens"), ["--sensitivity"]),
        ):
            with self.subTest(line):
                script = (
                    f"source {self.root}/endoflow.bash; compopt() {{ :; }}; COMP_WORDS=({' '.join(line)}); "
                    f"COMP_CWORD={len(line) - 1}; _endoflow; printf '%s\\n' \"${{COMPREPLY[@]}}\""
                )
                done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, cwd=self.root)
                self.assertEqual((done.stdout.split(), done.stderr), (wanted, ""))

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_completes(self):
        for line, wanted in (
            ("endoflow sta", ["statics"]),
            ("endoflow run ", ["boundary-integral", "phase-field"]),
            ("endoflow run phase-field clo", ["closed_vesicle"]),
            ("endoflow check standard --set molecules.patch_r", ["molecules.patch_radius="]),
        ):
            with self.subTest(line):
                script = f"source {self.root}/endoflow.fish; complete -C '{line}'"
                done = subprocess.run(
                    ["fish", "--no-config", "-c", script], capture_output=True, text=True, cwd=self.root, env={**os.environ, "HOME": str(self.root)}
                )
                # Files of the working directory are offered beside what the line wants.
                words = [text.split("\t")[0] for text in done.stdout.splitlines()]
                self.assertEqual(sorted(word for word in words if not (self.root / word).exists()), wanted, done.stderr)

    def test_shells_and_man_take_them(self):
        """As far as these programs are installed."""
        for command in (
            ["bash", "-n", "endoflow.bash"],
            ["zsh", "-n", "_endoflow"],
            ["fish", "-n", "endoflow.fish"],
            ["man", "--warnings", "--encoding=UTF-8", "-l", "endoflow.1"],
        ):
            if shutil.which(command[0]):
                with self.subTest(command):
                    done = subprocess.run(command, cwd=self.root, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                    self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
