"""The groups of comparisons/ know only those before them, and not one module lies outside a group by accident."""

import ast
import unittest

import locations


GROUPS = ("measures", "studies", "drawing", "page", "inference", "paper", "commands")
SOURCES = locations.ROOT / "comparisons"


def imported(file):
    """Groups of comparisons/ that a module imports, anywhere in it."""
    found = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        if isinstance(node, ast.ImportFrom) and node.level == 0:
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        found |= {name.split(".")[1] for name in names if name.startswith("comparisons.")}
    return found & set(GROUPS)


class LayoutTest(unittest.TestCase):
    def test_groups_import_only_those_before_them(self):
        for place, group in enumerate(GROUPS):
            for file in (SOURCES / group).glob("*.py"):
                with self.subTest(file=file.name):
                    self.assertLessEqual(imported(file), set(GROUPS[: place + 1]))

    def test_every_module_has_a_group(self):
        folders = {path.parent.name for path in SOURCES.rglob("*.py")}
        self.assertEqual(folders, {*GROUPS, "comparisons"})
        self.assertEqual({p.stem for p in SOURCES.glob("*.py")}, {"__init__", "__main__", "errors", "files"})

    def test_a_module_is_an_idea_and_not_one_function(self):
        """No module has fewer than 30 lines; a package's own, and what starts it, may."""
        lines = {file.relative_to(SOURCES).as_posix(): len(file.read_text(encoding="utf-8").splitlines()) for file in SOURCES.rglob("*.py")}
        self.assertEqual([name for name, count in lines.items() if count < 30 and not name.endswith(("__init__.py", "__main__.py"))], [])

    def test_imports_stand_at_the_top(self):
        """What takes long is imported with the command's module, after its options have been read."""
        inside = [
            f"{file.relative_to(SOURCES)}:{node.lineno}"
            for file in SOURCES.rglob("*.py")
            for function in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
            if isinstance(function, ast.FunctionDef)
            for node in ast.walk(function)
            if isinstance(node, (ast.Import, ast.ImportFrom))
        ]
        self.assertEqual(inside, [])

    def test_only_commands_and_the_running_of_members_print(self):
        printing = {
            file.relative_to(SOURCES).as_posix()
            for file in SOURCES.rglob("*.py")
            for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "print"
        }
        outside = {name for name in printing if not name.startswith("commands/")}
        self.assertEqual(outside, {"studies/study.py"})


if __name__ == "__main__":
    unittest.main()
