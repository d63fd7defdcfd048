#!/usr/bin/env python3
"""tools/docs/notebooks.py NOTEBOOK DIRECTORY: executes a notebook in DIRECTORY as Jupyter would, with the Python that runs this.

Exit code 1 when a cell raises, with its traceback.
"""

import json
import os
import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError

#: Most seconds a cell may take.
TIME_LIMIT = 1800


def main(notebook, directory):
    """Execute it; returns the exit code."""
    with tempfile.TemporaryDirectory() as kernels:
        # A kernel of this Python, whichever kernels the machine has.
        own = Path(kernels) / "here"
        own.mkdir()
        argv = [sys.executable, "-Xfrozen_modules=off", "-m", "ipykernel_launcher", "-f", "{connection_file}"]
        (own / "kernel.json").write_text(json.dumps({"argv": argv, "display_name": "here", "language": "python"}))
        client = NotebookClient(nbformat.read(notebook, 4), timeout=TIME_LIMIT, kernel_name="here")
        client.create_kernel_manager()
        client.km.kernel_spec_manager.kernel_dirs.insert(0, kernels)
        try:
            client.execute(cwd=directory, env=os.environ.copy())
        except (CellExecutionError, CellTimeoutError) as error:
            print(error, file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__.splitlines()[0])
    sys.exit(main(*sys.argv[1:]))
