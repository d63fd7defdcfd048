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

    def endoflow(self, *arguments):
        words = [self.root / "moved" / "bin" / "endoflow", *arguments]
        result = subprocess.run([str(word) for word in words], cwd=self.root, capture_output=True, text=True, timeout=1200,
                                env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
        self.assertEqual((result.returncode, result.stderr), (0, ""), arguments)
        return result.stdout

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
