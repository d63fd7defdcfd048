"""The layout keeps its promises, and the checks find what they are for.

    python3 tests/architecture/test_architecture.py
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "architecture"))

import check  # noqa: E402
import folders  # noqa: E402
import picture  # noqa: E402
import sources  # noqa: E402


class Tree(unittest.TestCase):
    """A small project in a scratch directory."""

    def tree(self, texts):
        """Write files {name: text}; returns the root."""
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        root = Path(scratch.name)
        for name, text in texts.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        return root


class Project(unittest.TestCase):
    def test_promises(self):
        self.assertEqual(check.problems(), [])


class Picture(unittest.TestCase):
    def test_is_up_to_date(self):
        drawn = (ROOT / "docs" / "images" / "architecture.svg").read_text("utf-8")
        self.assertTrue(drawn == picture.picture(), "draw it again: python3 tools/architecture/picture.py")

    def test_command_line(self):
        """A word that is no file's name is answered, not taken as one."""
        program = ROOT / "tools" / "architecture" / "picture.py"
        with tempfile.TemporaryDirectory() as scratch:
            for word, exit_code in (("--help", 0), ("--no-such-option", 2), ("x.svg", 0)):
                done = subprocess.run([sys.executable, program, word], cwd=scratch, capture_output=True, text=True)
                self.assertEqual(done.returncode, exit_code, done.stderr)
            self.assertEqual([file.name for file in Path(scratch).iterdir()], ["x.svg"])

    def test_rows(self):
        graph = {"a": {"b", "c"}, "b": {"d"}, "c": {"d"}}
        self.assertEqual(picture.rows_of(["a", "b", "c", "d", "e"], graph), [["a"], ["b", "c"], ["d", "e"]])

    def test_what_is_used_directly(self):
        graph = {"a": {"b", "c"}, "b": {"c"}}
        self.assertEqual(picture.direct(["a", "b", "c"], graph), [("a", "b"), ("b", "c")])


class Circles(Tree):
    def broken(self, texts):
        root = self.tree(texts)
        graphs = (sources.includes(texts, root), "includes"), (sources.imports(texts, root), "imports")
        return [line for graph, verb in graphs for line in check.circles(graph, verb)]

    def test_a_line_is_none(self):
        self.assertEqual(self.broken({"a/x.h": '#include "b/y.h"\n', "b/y.h": '#include "c/z.h"\n', "c/z.h": ""}), [])

    def test_three_folders(self):
        includes = {"a/x.h": "b/y.h", "b/y.h": "c/z.h", "c/z.h": "a/w.h"}
        found = self.broken({name: f'#include "{target}"\n' for name, target in includes.items()} | {"a/w.h": ""})
        uses = "\n    ".join(f"{name} includes {target}" for name, target in includes.items())
        self.assertEqual(found, [f"a/, b/, c/ use each other:\n    {uses}"])

    def test_of_folders_around_folders(self):
        """No two of the four inner folders use each other, but the two around them do."""
        texts = {"a/p/x.h": '#include "b/p/y.h"\n', "b/p/y.h": "", "b/q/z.h": '#include "a/q/w.h"\n', "a/q/w.h": ""}
        self.assertEqual([line.splitlines()[0] for line in self.broken(texts)], ["a/, b/ use each other:"])

    def test_inside_of_a_folder(self):
        texts = {"a/p/x.h": '#include "a/q/y.h"\n', "a/q/y.h": '#include "a/p/z.h"\n', "a/p/z.h": ""}
        self.assertEqual([line.splitlines()[0] for line in self.broken(texts)], ["a/p/, a/q/ use each other:"])

    def test_of_a_folder_and_one_inside(self):
        texts = {"a/x.cpp": '#include "a/p/y.h"\n', "a/p/y.h": '#include "../x.h"\n', "a/x.h": ""}
        self.assertEqual([line.splitlines()[0] for line in self.broken(texts)], ["a/p/, a/x use each other:"])

    def test_what_a_folder_begins_and_ends_with(self):
        """Its program above the folders inside, what they all use below them: no circle."""
        texts = {"a/main.cpp": '#include "a/p/y.h"\n', "a/p/y.h": '#include "a/error.h"\n', "a/error.h": ""}
        self.assertEqual(self.broken(texts), [])

    def test_python(self):
        x, y, z = (f"comparisons/{name}.py" for name in ("a/x", "b/y", "a/z"))
        found = self.broken({x: "from b.y import f\n", y: "def later():\n    import a.z\n", z: ""})
        head = "comparisons/a/, comparisons/b/ use each other:"
        self.assertEqual(found, [f"{head}\n    {x} imports {y}\n    {y} imports {z}"])


class FileCircles(Tree):
    def test_headers_of_one_folder(self):
        texts = {"a/x.h": '#include "a/y.h"\n', "a/y.h": '#include "a/x.h"\n', "a/x.cpp": '#include "a/x.h"\n'}
        graph = sources.includes(texts, self.tree(texts))
        self.assertEqual(check.file_circles(graph), ["a/x.h, a/y.h include each other"])

    def test_a_header_and_its_source_are_none(self):
        texts = {"a/x.h": "", "a/y.h": '#include "a/x.h"\n', "a/x.cpp": '#include "a/x.h"\n#include "a/y.h"\n'}
        self.assertEqual(check.file_circles(sources.includes(texts, self.tree(texts))), [])


class Graphs(Tree):
    def test_files_without_git(self):
        root = self.tree({"a/x.h": "", "build/y.h": "", "tools/__pycache__/z.py": ""})
        self.assertEqual(sources.tracked(root), ["a/x.h"])

    def test_python_modules(self):
        texts = {
            "comparisons/paper/__init__.py": "",
            "comparisons/paper/item.py": "",
            "comparisons/paper/fig3.py": "from . import item\nfrom .item import text\nimport numpy\nfrom style import RED\n",
            "comparisons/style.py": "from paper import fig3\n",
        }
        graph = sources.imports(texts, self.tree(texts))
        self.assertEqual(graph["comparisons/paper/fig3.py"], {"comparisons/paper/item.py", "comparisons/style.py"})
        self.assertEqual(graph["comparisons/style.py"], {"comparisons/paper/fig3.py"})

    def test_missing_file(self):
        texts = {"a/x.h": '#include "b/y.h"\n'}
        with self.assertRaisesRegex(sources.MissingFileError, 'a/x.h includes "b/y.h"'):
            sources.includes(texts, self.tree(texts))

    def test_levels(self):
        graph = {"a/p/x.h": {"a/q/y.h", "b/z.h"}, "a/x.h": {"a/p/x.h"}}
        self.assertEqual(folders.levels(graph), {"": {"a/": {"b/"}}, "a": {"a/p/": {"a/q/"}, "a/x": {"a/p/"}}})


class Files(Tree):
    def test_long_files(self):
        texts = {"a/x.h": "\n" * 401, "a/y.h": "\n" * 400, "docs/z.md": "\n" * 500}
        self.assertEqual(check.long_files(texts, self.tree(texts)), ["a/x.h has 401 lines, more than 400"])

    def test_pages(self):
        texts = {"docs/x.md": "# X\n\nAfter this page you know all.\n", "docs/p/y.md": "# Y\n\nIt is so.\n"}
        found = check.unopened_pages(texts, self.tree(texts))
        self.assertEqual(found, ['docs/p/y.md does not open with "After this page you know …"'])


if __name__ == "__main__":
    unittest.main()
