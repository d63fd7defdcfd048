"""Configuring says what is wrong with a library, asks for nothing that only tests need, and versions are told apart in one place.

    python3 tests/architecture/test_configuration.py
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

#: {what tells a library's versions apart: the files that may do so}
VERSION_SWITCHES = {
    r"#.*if.*SUNDIALS_VERSION": {"boundary_integral/integration/sundials_handles.h"},
    r"#include <catch2/(?!catch\.hpp)": {"tests/catch2-3/catch2/catch.hpp"},
    r"#.*if.*(CATCH|DEAL_II|H5|HDF5|PETSC|BOOST)_VERS": set(),
}


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = Path(scratch.name)

    def write(self, name, text, mode=0o644):
        file = self.directory / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        file.chmod(mode)


@unittest.skipUnless(shutil.which("cmake") and shutil.which("ninja"), "cmake or ninja is not installed")
class Configuration(Scratch):
    def configured(self, *options):
        """CMake's output and exit code for the sharp engine alone, with these options."""
        build = self.directory / "build"
        words = ["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DENDOFLOW_PHASEFIELD=OFF", *options]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        return " ".join((done.stdout + done.stderr).split()), done.returncode

    def test_sundials_of_another_version_is_refused(self):
        for version in ("5.8.0", "8.0.0"):
            self.write("stub/SUNDIALSConfig.cmake", "set(SUNDIALS_FOUND TRUE)\n")
            self.write("stub/SUNDIALSConfigVersion.cmake",
                       f'set(PACKAGE_VERSION "{version}")\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n')
            output, code = self.configured(f"-DSUNDIALS_DIR={self.directory}/stub")
            self.assertIn(f"SUNDIALS {version} in {self.directory}/stub: the boundary-integral engine needs version 6 or 7", output)
            self.assertNotEqual(code, 0)

    def test_only_tests_need_catch2(self):
        without = "-DCMAKE_DISABLE_FIND_PACKAGE_Catch2=ON"
        output, code = self.configured(without)
        self.assertEqual(code, 0, output)
        output, code = self.configured(without, "-DENDOFLOW_TESTS=ON")
        self.assertNotEqual(code, 0)
        self.assertIn("Catch2", output)


class Versions(unittest.TestCase):
    def test_are_told_apart_in_one_file_each(self):
        listed = subprocess.run(["git", "ls-files", "*.h", "*.cpp", "*.hpp"], cwd=ROOT, capture_output=True, text=True, check=True)
        texts = {name: (ROOT / name).read_text("utf-8") for name in listed.stdout.split()}
        for switch, places in VERSION_SWITCHES.items():
            self.assertEqual({name for name, text in texts.items() if re.search(switch, text)}, places, switch)


class Tools(Scratch):
    def run_tool(self, *words, **stubs):
        """The tool's standard output and error, with stand-ins {command: what it prints} before all other commands."""
        for command, text in stubs.items():
            self.write(f"bin/{command.replace('_', '-')}", f"#!/bin/sh\ncat << 'END'\n{text}\nEND\n", 0o755)
        path = f"{self.directory / 'bin'}:{os.environ['PATH']}"
        done = subprocess.run([ROOT / "tools" / words[0], *words[1:]], cwd=ROOT, capture_output=True, text=True, check=True,
                              env=os.environ | {"PATH": path})
        return done.stdout.strip(), done.stderr.strip()

    def test_formatter_of_another_version_is_left_out_in_words(self):
        versions = {"clang_format": "Debian clang-format version 19.1.7 (3+b1)", "clang_format_14": ""}
        self.assertEqual(self.run_tool("llvm_tool", "clang-format", **versions),
                         ("", "Left out: clang-format of version 14 is not installed (Debian 12 has it)."))
        versions["clang_format_14"] = "Debian clang-format version 14.0.6"
        self.assertEqual(self.run_tool("llvm_tool", "clang-format", **versions), ("clang-format-14", ""))

    def test_one_process_for_each_core(self):
        """Two cores with two hardware threads each are two; of a large machine what this process may use counts."""
        threads = "# Core,Socket\n0,0\n1,0\n0,0\n1,0"
        self.assertEqual(self.run_tool("cores", nproc="4", lscpu=threads)[0], "2")
        self.assertEqual(self.run_tool("cores", nproc="1", lscpu=threads)[0], "1")
        self.assertEqual(self.run_tool("cores", nproc="3", lscpu="# Core,Socket")[0], "3")


if __name__ == "__main__":
    unittest.main()
