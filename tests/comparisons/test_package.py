"""The Python package as users get it: `pip install ./python` without network, its types, and where it finds the program.

    python3 tests/comparisons/test_package.py
"""

import importlib.util
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import locations
from scratch import scratch_directory

PACKAGE = locations.ROOT / "python"
SAY = "import endoflow\ntry: print(endoflow.__file__, endoflow.program())\nexcept endoflow.FileError as error: print(error)"


@unittest.skipUnless(shutil.which("mypy"), "mypy is not installed (Debian package mypy)")
class Types(unittest.TestCase):
    def test_every_function_is_typed(self):
        """mypy --strict, as pyproject.toml says."""
        with tempfile.TemporaryDirectory() as cache:
            process = subprocess.run(
                ["mypy", "--cache-dir", cache, "endoflow"], cwd=PACKAGE, capture_output=True, text=True, timeout=600
            )
        self.assertEqual(process.returncode, 0, process.stdout)


@unittest.skipUnless(importlib.util.find_spec("ensurepip"), "venv needs the Debian package python3-venv")
@unittest.skipUnless(importlib.util.find_spec("flit_core"), "the package is built with flit_core (Debian package flit)")
class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = scratch_directory(cls)
        # A copy with a name that a URL must encode, and with what may be a program beside it.
        cls.source = cls.root / "source tree"
        shutil.copytree(PACKAGE, cls.source / "python", ignore=shutil.ignore_patterns("__pycache__"))
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", cls.root / "venv"], check=True)

    def pip(self, *arguments, venv="venv", code=0):
        """A command of pip that must end with this exit code; without an index, as on a machine without network."""
        command = [self.root / venv / "bin" / "pip", "--isolated", *arguments]
        process = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=600, cwd=self.root)
        self.assertEqual(process.returncode, code, process.stderr)
        return process.stdout

    def install(self, *arguments):
        """What docs/python.md says for a machine without network: Debian has what is needed, and pip does not know its h5py."""
        self.pip("install", "--no-index", "--quiet", "--no-build-isolation", "--no-deps", *arguments)

    def say(self, **environment):
        """What a Python in another place finds."""
        variables = {"PATH": "/nonexistent", **environment}
        command = [str(self.root / "venv" / "bin" / "python"), "-c", SAY]
        process = subprocess.run(command, cwd="/", env=variables, capture_output=True, text=True, timeout=600)
        self.assertEqual(process.stderr, "")
        return process.stdout.strip()

    def program(self, *parts):
        """An executable file."""
        path = self.root.joinpath(*parts)
        path.parent.mkdir(exist_ok=True)
        path.write_text("#!/bin/sh\n")
        path.chmod(0o755)
        return path

    def test_from_the_source_tree(self):
        """The program is the one in PATH, else the tree's own, else there is a line that says how to get it."""
        self.install(self.source / "python")
        installed = str(next((self.root / "venv" / "lib").glob("python3*/site-packages/endoflow")) / "__init__.py")
        self.assertRegex(self.say(), "^the program endoflow was not found: install its Debian package, or build it")
        built = self.program("source tree", "build", "endoflow")
        self.assertEqual(self.say(), f"{installed} {built}")
        elsewhere = self.program("bin", "endoflow")
        self.assertEqual(self.say(PATH=str(elsewhere.parent)), f"{installed} {elsewhere}")
        self.assertTrue((Path(installed).parent / "py.typed").is_file())
        left = [path.name for path in (self.source / "python").iterdir()]
        self.assertEqual(sorted(left), ["endoflow", "notebooks", "pyproject.toml"], "building writes into the source tree")

    def test_dependencies(self):
        """A bare environment is told what it lacks; extras are asked for by name alone."""
        wheel = self.root / "endoflow-wheel"
        self.pip("wheel", "--no-index", "--no-build-isolation", "--no-deps", "--wheel-dir", wheel, self.source / "python")
        subprocess.run([sys.executable, "-m", "venv", self.root / "bare"], check=True)
        self.pip("install", "--no-index", "--no-deps", *wheel.glob("*.whl"), venv="bare")
        lacks = [line.split(" requires ")[1] for line in self.pip("check", venv="bare", code=1).splitlines()]
        self.assertEqual(lacks, [f"{name}, which is not installed." for name in ("h5py", "numpy")])
        about = next((self.root / "bare" / "lib").glob("python3*/site-packages/endoflow-*.dist-info")) / "METADATA"
        self.assertIn("Requires-Dist: xarray ; extra == \"xarray\"\n", about.read_text(encoding="utf-8"))

    def test_editable(self):
        self.install("--editable", self.source / "python")
        command = [str(self.root / "venv" / "bin" / "python"), "-c", "import endoflow; print(endoflow.__file__)"]
        where = subprocess.run(command, cwd="/", capture_output=True, text=True, timeout=600).stdout.strip()
        self.assertEqual(where, str(self.source / "python" / "endoflow" / "__init__.py"))


if __name__ == "__main__":
    unittest.main()
