#!/usr/bin/env python3
"""tools/docs/check.py BUILD [--parse|--store]: runs the commands of README.md and docs/ and the notebooks; --parse only parses the
commands, --store runs the notebooks alone and stores what their cells show.

Blocks run in the order of the pages in one scratch directory that holds links to the project's build, cases and python.
docs/developer-guide.md says how a block is marked. Exit code 1 when something fails, with the command and what it said.
"""

import os
import re
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from pages import ROOT, blocks, pages

#: What the scratch directory shares with the project, and most seconds a block may take.
SHARED = ("bench", "cases", "python", "comparisons", "tests", "docs")
TIME_LIMIT = 1800

#: Directory below the scratch directory with the Python that the build found, which has numpy and h5py.
TOOLS = ".tools"


def readable(block):
    """Where a block is, for messages."""
    return f"{block.page.relative_to(ROOT)}: {block.text.strip().splitlines()[0]}"


def environment(build):
    """The environment of the commands: BUILD on the path, so that `endoflow` is found as when installed."""
    own = {"PATH": f"{build}:{os.environ['PATH']}", "PYTHONPATH": "python", "MPLBACKEND": "Agg"}
    if os.geteuid() == 0:  # OpenMPI refuses to run as root unless told twice that this is meant
        own |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return {**os.environ, **own}


def python_of(build):
    """The Python interpreter that CMake found for a build (Path)."""
    cache = build / "CMakeCache.txt"
    found = (
        re.search(r"^ENDOFLOW_PYTHON:\w+=(.*)$", cache.read_text(encoding="utf-8"), re.M) if cache.exists() else None
    )
    return found.group(1) if found else sys.executable


def run(block, scratch, build):
    """Run a block; returns what is wrong, or ""."""
    text = block.text if block.kind == "sh" else f"python3 -c {shlex.quote(block.text)}"
    command = ["bash", "-e", "-o", "pipefail", "-c", text]
    own = environment(build)
    own["PATH"] = f"{Path(scratch) / TOOLS}:{own['PATH']}"  # absolute: a virtual environment refers to the Python that made it
    started = time.monotonic()
    try:
        process = subprocess.run(
            command, cwd=scratch, env=own, capture_output=True, text=True, timeout=TIME_LIMIT
        )
    except subprocess.TimeoutExpired:
        return f"did not end within {TIME_LIMIT} s"
    wanted = re.match(r"fails with (\d+)", block.mark)
    code = int(wanted.group(1)) if wanted else 0
    print(f"{time.monotonic() - started:6.1f} s  {readable(block)}", flush=True)
    if process.returncode != code:
        return f"exit code {process.returncode} instead of {code}\n{process.stdout[-1500:]}{process.stderr[-1500:]}"
    return ""


def execute(notebook, scratch, build, store):
    """Execute a notebook (path) in a directory of its own below scratch; returns what is wrong, or ""."""
    own = scratch / "notebooks" / notebook.stem
    own.mkdir(parents=True)
    started = time.monotonic()
    command = [python_of(build), str(Path(__file__).with_name("notebooks.py")), str(notebook), str(own), *(["--store"] if store else [])]
    variables = {**environment(build), "PYTHONPATH": str(ROOT / "python")}
    del variables["MPLBACKEND"]  # a kernel draws into the notebook
    process = subprocess.run(command, env=variables, capture_output=True, text=True, check=False)
    print(f"{time.monotonic() - started:6.1f} s  {notebook.relative_to(ROOT)}", flush=True)
    return process.stderr[-3000:].strip() if process.returncode else ""


def parse(block, build):
    """Check a block without running it: shell syntax, and that `endoflow` knows its commands and options."""
    check = subprocess.run(["bash", "-n", "-c", block.text], capture_output=True, text=True, check=False)
    if check.returncode:
        return check.stderr
    for line in block.text.replace("\\\n", " ").splitlines():
        words = shlex.split(line, comments=True)
        starts = [i for i, word in enumerate(words) if Path(word).name == "endoflow"]
        if starts:
            wrong = unknown_options(words[starts[0] + 1 :], build)
            if wrong:
                return wrong
    return ""


def check_case(block, build):
    """What `endoflow check` says against a block in TOML, a case or a part of one; "" when nothing."""
    with tempfile.TemporaryDirectory() as scratch:
        case = Path(scratch) / "case.toml"
        case.write_text(block.text, encoding="utf-8")
        command = [str(build / "endoflow"), "check", str(case)]
        return subprocess.run(command, env=environment(build), capture_output=True, text=True, check=False).stderr


def unknown_options(words, build):
    """What `endoflow` would not understand in the words behind it; "" when nothing."""
    if not words or words[0].startswith("-"):
        return ""
    command = words[:2] if words[0] == "run" else words[:1]
    known = subprocess.run(
        [str(build / "endoflow"), *command, "--help"],
        env=environment(build),
        capture_output=True,
        text=True,
        check=False,
    )
    if known.returncode:
        return f"endoflow {' '.join(command)} --help: {known.stderr.strip()}"
    options = [word.split("=")[0] for word in words if re.match(r"--?[a-z]", word)]
    missing = [option for option in options if not re.search(rf"(?<![\w-]){option}(?![\w-])", known.stdout)]
    return f"endoflow {' '.join(command)} has no {', '.join(missing)}" if missing else ""


def main(arguments):
    """Check all pages; returns the exit code."""
    parse_only, store = ("--parse" in arguments), ("--store" in arguments)
    build = Path(next(one for one in arguments if not one.startswith("--"))).resolve()
    failures, counts = [], {"run": 0, "parsed": 0}
    with tempfile.TemporaryDirectory() as scratch:
        for name in SHARED:
            (Path(scratch) / name).symlink_to(ROOT / name)
        (Path(scratch) / "build").symlink_to(build)
        (Path(scratch) / TOOLS).mkdir()
        (Path(scratch) / TOOLS / "python3").symlink_to(python_of(build))
        for page in [] if store else [ROOT / "README.md", *pages()]:
            for block in blocks(page):
                if block.mark.startswith("file: "):
                    (Path(scratch) / block.mark.removeprefix("file: ")).write_text(block.text, encoding="utf-8")
                if block.kind not in ("sh", "python", "toml"):
                    continue
                only_parsed = parse_only or block.kind == "toml" or block.mark.startswith("parse only")
                problem = {"sh": parse, "toml": check_case}[block.kind](block, build) if block.kind != "python" else ""
                problem = problem or ("" if only_parsed else run(block, scratch, build))
                counts["parsed" if only_parsed else "run"] += 1
                if problem:
                    failures.append(f"{readable(block)}\n    {problem.strip()}")
        for notebook in [] if parse_only else sorted((ROOT / "python" / "notebooks").glob("*.ipynb")):
            problem = execute(notebook, Path(scratch), build, store)
            counts["run"] += 1
            if problem:
                failures.append(f"{notebook.relative_to(ROOT)}\n    {problem}")
    print(f"{counts['run']} blocks run, {counts['parsed']} parsed, {len(failures)} failed")
    print("\n".join(failures), file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: tools/docs/check.py BUILD [--parse|--store]")
    sys.exit(main(sys.argv[1:]))
