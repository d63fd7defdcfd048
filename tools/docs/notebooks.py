#!/usr/bin/env python3
"""tools/docs/notebooks.py NOTEBOOK DIRECTORY [--store]: executes a notebook in DIRECTORY as Jupyter would, with the Python that runs this.

Exit code 1 when a cell raises, with its traceback, and when a cell prints other words than the stored notebook says; with --store
the notebook is written anew instead, with what its cells show.
"""

import copy
import json
import os
import re
import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError

#: Most seconds a cell may take.
TIME_LIMIT = 1800


def printed(cell):
    """The words that a cell prints: numbers may differ in their last digits from machine to machine."""
    text = "".join(output["text"] for output in cell.get("outputs", []) if output["output_type"] == "stream")
    return re.sub(r"-?\d[\d.e+-]*", "#", text)


def main(notebook, directory, store=False):
    """Execute it; returns the exit code."""
    stored = nbformat.read(notebook, 4)
    book = copy.deepcopy(stored)
    with tempfile.TemporaryDirectory() as kernels:
        # A kernel of this Python, whichever kernels the machine has.
        own = Path(kernels) / "here"
        own.mkdir()
        argv = [sys.executable, "-Xfrozen_modules=off", "-m", "ipykernel_launcher", "-f", "{connection_file}"]
        (own / "kernel.json").write_text(json.dumps({"argv": argv, "display_name": "here", "language": "python"}))
        client = NotebookClient(book, timeout=TIME_LIMIT, kernel_name="here", record_timing=False)
        client.create_kernel_manager()
        client.km.kernel_spec_manager.kernel_dirs.insert(0, kernels)
        try:
            client.execute(cwd=directory, env=os.environ.copy())
        except (CellExecutionError, CellTimeoutError) as error:
            print(error, file=sys.stderr)
            return 1
    if store:
        book.metadata = stored.metadata  # the kernel is whichever the reader has
        nbformat.write(book, notebook)
        return 0
    other = [cell.id for cell, before in zip(book.cells, stored.cells) if printed(cell) != printed(before)]
    if other:
        print(f"other words than stored: {', '.join(other)}; `make notebooks` stores them anew", file=sys.stderr)
    return 1 if other else 0


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4) or sys.argv[3:] not in ([], ["--store"]):
        sys.exit(__doc__.splitlines()[0])
    sys.exit(main(*sys.argv[1:3], store=len(sys.argv) == 4))
