"""In a Jupyter kernel: the progress bar, a cancelled cell, errors; and that the notebooks are stored with what their cells show.

    ENDOFLOW_PROGRAM=build/endoflow python3 tests/comparisons/test_notebook.py

`make docs-check` executes the notebooks themselves.
"""

import ast
import importlib.util
import json
import os
import re
import sys
import threading
import time
import unittest

import locations
from scratch import scratch_directory

PROGRAM = os.environ.get("ENDOFLOW_PROGRAM", "")
NOTEBOOKS = sorted((locations.ROOT / "python" / "notebooks").glob("*.ipynb"))
NEEDED = ("nbclient", "nbformat", "ipykernel")
MISSING = [name for name in NEEDED if importlib.util.find_spec(name) is None]
SMALL = '{"molecules": {"patch_radius": 24}, "boundary_integral": {"elements": 32}}, set={"output.field_interval": 0}'


class Stored(unittest.TestCase):
    def test_executed(self):
        """Every cell's result is stored, in order and without an error; nothing says on which machine."""
        self.assertGreaterEqual(len(NOTEBOOKS), 3)
        for path in NOTEBOOKS:
            with self.subTest(notebook=path.name):
                text = path.read_text(encoding="utf-8")
                self.assertLess(len(text), 400_000)
                notebook = json.loads(text)
                self.assertTrue(notebook["cells"][1]["source"][0].startswith(("import", "from")))
                cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
                self.assertEqual([cell["execution_count"] for cell in cells], list(range(1, len(cells) + 1)))
                outputs = [output for cell in cells for output in cell["outputs"]]
                self.assertNotIn("error", {output["output_type"] for output in outputs})
                self.assertTrue(any("image/png" in output.get("data", {}) for output in outputs))
                self.assertIsNone(re.search(r"/(tmp|home|root|work)/", json.dumps(outputs)))
                for cell in cells:
                    ast.parse("".join(cell["source"]))

    def test_five_lines_to_a_plotted_neck(self):
        cells = json.loads((locations.ROOT / "python" / "notebooks" / "first_run.ipynb").read_text(encoding="utf-8"))["cells"]
        lines = "".join(next(cell for cell in cells if cell["cell_type"] == "code")["source"]).splitlines()
        self.assertEqual(len(lines), 5)
        self.assertIn("neck_radius_nm", lines[3])


@unittest.skipIf(MISSING, f"{', '.join(MISSING)} is not installed (Debian packages python3-nbclient, python3-nbformat, python3-ipykernel)")
@unittest.skipUnless(os.access(PROGRAM, os.X_OK), "ENDOFLOW_PROGRAM names no program")
class InAKernel(unittest.TestCase):
    def setUp(self):
        self.scratch = scratch_directory(self)

    def execute(self, *sources, meanwhile=None):
        """The cells of these sources after execution, exceptions and all; meanwhile(client) runs beside them in a thread."""
        import nbformat
        from nbclient import NotebookClient

        # The kernel of this Python, wherever the machine's kernels are.
        kernel = self.scratch / "kernels" / "here"
        kernel.mkdir(parents=True)
        argv = [sys.executable, "-Xfrozen_modules=off", "-m", "ipykernel_launcher", "-f", "{connection_file}"]
        (kernel / "kernel.json").write_text(json.dumps({"argv": argv, "display_name": "here", "language": "python"}))
        book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in ("import endoflow", *sources)])
        client = NotebookClient(book, timeout=1200, kernel_name="here", allow_errors=True, interrupt_on_timeout=False)
        client.create_kernel_manager()
        client.km.kernel_spec_manager.kernel_dirs.insert(0, str(kernel.parent))
        environment = {**os.environ, "ENDOFLOW": os.path.abspath(PROGRAM), "PYTHONPATH": str(locations.ROOT / "python")}
        if meanwhile is not None:
            beside = threading.Thread(target=meanwhile, args=(client,))
            beside.start()
            self.addCleanup(beside.join)
        client.execute(cwd=str(self.scratch), env=environment)
        return book.cells[1:]

    def error(self, cell):
        """(name, message) of the exception that ended a cell."""
        found = [output for output in cell["outputs"] if output["output_type"] == "error"]
        self.assertEqual(len(found), 1, cell["outputs"])
        return found[0]["ename"], found[0]["evalue"]

    def test_progress_bar(self):
        shown, quiet = self.execute(
            f'run = endoflow.run("boundary-integral", {SMALL}, until=0.02, output="a")',
            f'run = endoflow.run("boundary-integral", {SMALL}, until=0.02, output="b", progress=False)',
        )
        # One display that is updated, not a new one at every look.
        (bar,) = shown["outputs"]
        text = "".join(bar["data"]["text/html"])
        self.assertEqual(float(re.search(r'<progress max="1" value="([\d.]+)"', text).group(1)), 1.0)
        self.assertIn("0.02 of 0.02 µs", text)
        self.assertEqual(quiet["outputs"], [])

    def test_a_cancelled_cell_leaves_a_checkpoint(self):
        def cancel(client):
            history = self.scratch / "c" / "history.csv"
            for _ in range(2400):
                if history.exists() and history.read_text().count("\n") > 3:
                    break
                time.sleep(0.05)
            interrupt = client.km.interrupt_kernel()
            if hasattr(interrupt, "send"):  # a coroutine, from managers that are asynchronous
                import asyncio

                asyncio.run(interrupt)

        cancelled, after = self.execute(
            'endoflow.run("boundary-integral", "standard", output="c")',
            'from pathlib import Path\nagain = endoflow.load("c")\n'
            'print(again.record["state"], any(Path("c/checkpoint").iterdir()))\n'
            'again = endoflow.run("boundary-integral", "standard", until=1.02 * again.record["time_us"], output="c", restart=True)\n'
            'print(again.record["state"])',
            meanwhile=cancel,
        )
        self.assertEqual(self.error(cancelled)[0], "KeyboardInterrupt")
        texts = "".join(output.get("text", "") for output in after["outputs"] if output["output_type"] == "stream")
        self.assertEqual(texts.split(), ["interrupted", "True", "finished"], after["outputs"])

    def test_errors_have_the_programs_words(self):
        (cell,) = self.execute('endoflow.run("boundary-integral", {"molecules": {"patch_radus": 24}})')
        name, message = self.error(cell)
        self.assertEqual(name, "InputError")
        self.assertIn('did you mean "molecules.patch_radius"', message)


if __name__ == "__main__":
    unittest.main()
