"""The project's source files, and which of them uses which: C++ by #include "…", Python by import.

A graph is {name: {names it uses}}. Files are named by their path from the project's root, "shared/model/bending_model.h".
"""

import ast
import re
import subprocess
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[2]

#: What counts as source: everything a person writes and a machine runs.
SUFFIXES = (".h", ".cpp", ".in", ".py", ".js", ".css", ".html", ".lua", ".cmake", ".sh")
NAMES = ("CMakeLists.txt", "Makefile", "Snakefile")

#: Folders from which Python modules are imported by their bare name, beside the importing file's own and those above it.
PYTHON_ROOTS = ("python", "comparisons", "bench", "tools/docs", "tools/architecture", "tools/manual")

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)


class MissingFileError(Exception):
    """A file includes one that the project does not have."""


def tracked(root=ROOT):
    """All files of the project, as paths from the root in order: those that git does not ignore; without git all but builds."""
    command = ["git", "-C", str(root), "ls-files", "--cached", "--others", "--exclude-standard"]
    if (root / ".git").exists():
        listed = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    else:
        inside = (path.relative_to(root) for path in root.rglob("*"))
        listed = [path.as_posix() for path in inside if not path.parts[0].startswith(("build", "out", "."))]
    return sorted({name for name in listed if (root / name).is_file() and "__pycache__" not in name})


def source_files(files):
    """Those of the files that are source."""
    return [name for name in files if name.endswith(SUFFIXES) or PurePosixPath(name).name in NAMES]


def includes(files, root=ROOT):
    """Which C++ file includes which (graph of files)."""
    sources = [name for name in files if name.endswith((".h", ".cpp"))]
    known, graph = set(sources), {}
    for name in sources:
        graph[name] = set()
        for target in INCLUDE.findall((root / name).read_text("utf-8")):
            beside = relative(name, target)
            if target not in known and beside not in known:
                raise MissingFileError(f'{name} includes "{target}", which is not there')
            graph[name].add(target if target in known else beside)
    return graph


def relative(name, target):
    """The path from the root of a target that is given from the file name's folder."""
    parts = list(PurePosixPath(name).parent.parts)
    for part in PurePosixPath(target).parts:
        if part == "..":
            parts = parts[:-1]
        else:
            parts.append(part)
    return "/".join(parts)


def imports(files, root=ROOT):
    """Which Python file imports which (graph of files); modules from elsewhere are left out."""
    sources = [name for name in files if name.endswith(".py")]
    known = set(sources)
    return {name: set(imported(name, root, known)) - {name} for name in sources}


def imported(name, root, known):
    """The project's files that the Python file name imports."""
    folder = PurePosixPath(name).parent
    above = [str(folder), *(str(parent) for parent in folder.parents)]
    for node in ast.walk(ast.parse((root / name).read_text("utf-8"), name)):
        if isinstance(node, ast.Import):
            modules = [alias.name for alias in node.names]
            yield from found(modules, [*above, *PYTHON_ROOTS], known)
        elif isinstance(node, ast.ImportFrom):
            places = [above[node.level - 1]] if node.level else [*above, *PYTHON_ROOTS]
            stem = f"{node.module}." if node.module else ""
            inner = [stem + alias.name for alias in node.names]
            yield from list(found(inner, places, known)) or found([node.module or ""], places, known)


def found(modules, places, known):
    """Files of modules ("paper.item"), each in the first of the places that has it."""
    for module in modules:
        path = module.replace(".", "/")
        candidates = [f"{place}/{path}".removeprefix("./").rstrip("/") for place in places]
        files = [file for stem in candidates for file in (f"{stem}.py", f"{stem}/__init__.py") if file in known]
        yield from files[:1]
