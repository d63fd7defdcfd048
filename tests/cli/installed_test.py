"""What `make install` installs works in any place: it finds its engines and scripts beside itself, not in the source tree.

    python3 tests/cli/installed_test.py cmake build
"""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from engines import COARSE, options, texts  # noqa: E402
from scratch import scratch_directory  # noqa: E402

INSTALL = None


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = scratch_directory(cls)
        subprocess.run([*INSTALL, "--prefix", "/usr"], env={**os.environ, "DESTDIR": str(cls.root / "staged")},
                       stdout=subprocess.DEVNULL, check=True)
        (cls.root / "staged" / "usr").rename(cls.root / "moved")

    def call(self, *arguments, **environment):
        words = [self.root / "moved" / "bin" / "endoflow", *arguments]
        return subprocess.run([str(word) for word in words], cwd=self.root, capture_output=True, text=True, timeout=1200,
                              env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1", **environment})

    def endoflow(self, *arguments, **environment):
        result = self.call(*arguments, **environment)
        self.assertEqual((result.returncode, result.stderr), (0, ""), arguments)
        return result.stdout

    def python(self, folder, script):
        """A program called python3 in a folder of its own; returns the folder."""
        path = self.root / folder / "python3"
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"#!/bin/sh\n{script}\n")
        path.chmod(0o755)
        return path.parent

    def test_python_is_found_when_it_is_needed(self):
        """The one of configure time, else a python3 in PATH that has what that one lacks, else the one that lacks least."""
        here = os.environ["PATH"]
        self.endoflow("report", "--help", PATH=f"{self.python('broken', 'exit 9')}:{here}")
        requirements = self.root / "moved" / "share" / "endoflow" / "comparisons" / "requirements.txt"
        before = requirements.read_text()
        self.addCleanup(requirements.write_text, before)
        requirements.write_text(before + "only_elsewhere  # not in Debian\n")
        packages = self.root / "packages"
        packages.mkdir()
        (packages / "only_elsewhere.py").write_text("")
        served = f'echo served >> {self.root}/served\nexport PYTHONPATH={packages}:$PYTHONPATH\nexec {sys.executable} "$@"'
        old = self.python("old", "exit 100")
        self.endoflow("report", "--help", PATH=f"{old}:{self.python('elsewhere', served)}:{here}")
        self.assertEqual((self.root / "served").read_text().count("served"), 2, "asked what it has, then started")
        self.endoflow("report", "--help", PATH=f"{old}:{self.python('poorer', 'exit 3')}:/usr/bin:/bin")

    def test_python_of_the_environment(self):
        """ENDOFLOW_PYTHON alone counts, by path or by name; one that cannot serve is named with what to do."""
        self.endoflow("report", "--help", ENDOFLOW_PYTHON=sys.executable)
        old = self.python("old", "exit 100")
        for chosen, reason in ((str(old / "python3"), "is too old"), ("/nowhere/python3", "cannot be started"), ("no-such-python", "cannot be started")):
            result = self.call("report", "--help", ENDOFLOW_PYTHON=chosen)
            self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (4, "", 1))
            self.assertIn(f"ENDOFLOW_PYTHON: {chosen} {reason}; unset it, or name a Python 3.11 or later", result.stderr)

    def test_a_package_that_is_missing(self):
        """One line that names it and how to get it."""
        lacking = self.root / "lacking"
        lacking.mkdir()
        (lacking / "matplotlib.py").write_text("raise ModuleNotFoundError(\"No module named 'matplotlib'\", name='matplotlib')")
        result = self.call("compare", "a", "b", ENDOFLOW_PYTHON=sys.executable, PYTHONPATH=str(lacking))
        self.assertEqual((result.returncode, result.stderr.count("\n")), (4, 1), result.stderr)
        self.assertIn("lacks matplotlib (No module named 'matplotlib'); install Debian's python3-matplotlib, or `", result.stderr)

    def test_version(self):
        self.assertRegex(self.endoflow("--version"), r"^endoflow \d+\.\d+\.\d+ \(.+\)\n$")

    def test_engine_and_scripts(self):
        case = self.root / "empty.toml"
        case.write_text("")
        settings = [*options(texts(COARSE["boundary-integral"])), "--until", "0.0002"]
        self.endoflow("run", "boundary-integral", case, "-o", self.root / "run", *settings)
        self.endoflow("revolve", self.root / "run")
        self.assertTrue((self.root / "run" / "membrane.pvd").is_file())

    def test_one_version(self):
        """Where a version's number stands besides the program."""
        source = Path(__file__).resolve().parents[2]
        number = self.endoflow("--version").split()[1]
        self.assertEqual(json.loads((source / "codemeta.json").read_text(encoding="utf-8"))["version"], number)
        self.assertIn(f"\nversion: {number}\n", (source / "CITATION.cff").read_text(encoding="utf-8"))
        self.assertIn(f'version = "{number}"', (source / "python" / "pyproject.toml").read_text(encoding="utf-8"))

    def test_data(self):
        share = self.root / "moved" / "share"
        for name in ("endoflow/cases/standard.toml", "endoflow/python/endoflow/__init__.py", "doc/endoflow/copyright",
                     "man/man1/endoflow.1", "bash-completion/completions/endoflow", "zsh/vendor-completions/_endoflow",
                     "fish/vendor_completions.d/endoflow.fish"):
            self.assertTrue((share / name).is_file(), name)
        self.assertEqual(list(share.rglob("__pycache__")), [])


if __name__ == "__main__":
    INSTALL = [sys.argv.pop(1), "--install", str(Path(sys.argv.pop(1)).resolve())]
    unittest.main()
