"""`endoflow.run` and its companions, with the program itself.

    ENDOFLOW_PROGRAM=build/endoflow python3 tests/comparisons/test_api.py
"""

import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path
from unittest import mock

import locations
from scratch import scratch_directory

import numpy as np

import endoflow
from endoflow.cases import literal, settings, toml_of

PROGRAM = os.environ.get("ENDOFLOW_PROGRAM", "")
SMALL = {
    "molecules": {"patch_radius": 24},
    "boundary_integral": {"elements": 32},
    "output": {"field_interval": 0, "shape_interval": 0.005},
}
ENGINE = "boundary-integral"


@unittest.skipUnless(os.access(PROGRAM, os.X_OK), "ENDOFLOW_PROGRAM names no program")
class Commands(unittest.TestCase):
    def setUp(self):
        self.scratch = scratch_directory(self)
        before = os.getcwd()
        os.chdir(self.scratch)
        self.addCleanup(os.chdir, before)
        environment = mock.patch.dict(os.environ, {"ENDOFLOW": os.path.abspath(os.path.join(before, PROGRAM))})
        environment.start()
        self.addCleanup(environment.stop)

    def test_a_run_is_what_load_returns(self):
        run = endoflow.run(ENGINE, SMALL, set={"molecules.transport": "fickian"}, until=0.01, output="a")
        self.assertEqual((run.engine, run.record["state"]), (ENGINE, "finished"))
        self.assertEqual(run.parameters["molecules"]["patch_radius"], 24)
        self.assertEqual(run.parameters["molecules"]["transport"], "fickian")
        self.assertAlmostEqual(run.history["time_us"][-1], 0.01, delta=1e-12)
        longer = endoflow.run(
            ENGINE, SMALL, set={"molecules.transport": "fickian"}, until=0.02, output="a", restart=True
        )
        self.assertAlmostEqual(longer.history["time_us"][-1], 0.02, delta=1e-12)

    def test_cases_as_text_path_and_name(self):
        text = "[molecules]\npatch_radius = 30\n"
        Path("mine.toml").write_text(text)
        for case in (text, "mine.toml", Path("mine.toml")):
            run = endoflow.run(ENGINE, case, until=1e-4, output="b")
            self.assertEqual(run.parameters["molecules"]["patch_radius"], 30)
        run = endoflow.run(ENGINE, "fickian", until=1e-4)
        self.assertEqual((run.parameters["case"]["name"], str(run.directory)), ("fickian", f"out/fickian/{ENGINE}"))

    def test_errors_have_the_programs_words(self):
        with self.assertRaisesRegex(endoflow.InputError, "^the case:2:1: .*molecules.patch_radus.*patch_radius"):
            endoflow.run(ENGINE, {"molecules": {"patch_radus": 24}}, output="c")
        with self.assertRaisesRegex(endoflow.InputError, "did you mean 'fickian'"):
            endoflow.run(ENGINE, "fickain", output="c")
        with self.assertRaises(endoflow.FileError):
            endoflow.run(ENGINE, SMALL, until=1e-4, output="/proc/none")
        with self.assertRaisesRegex(endoflow.EndoflowError, "unknown engine"):
            endoflow.run("boundary-integrals", SMALL, output="c")
        self.assertFalse(Path("c").exists())

    def test_cancelling_leaves_a_checkpoint(self):
        """What Ctrl-C and Jupyter's stop button do: a SIGINT that becomes a KeyboardInterrupt."""

        def interrupt_once_it_runs():
            history = Path("d/history.csv")
            for _ in range(1200):
                if history.exists() and history.read_text().count("\n") > 3:
                    break
                time.sleep(0.05)
            os.kill(os.getpid(), signal.SIGINT)

        waiting = threading.Thread(target=interrupt_once_it_runs)
        waiting.start()
        with self.assertRaises(KeyboardInterrupt):
            endoflow.run(ENGINE, "standard", output="d")
        waiting.join()
        stopped = endoflow.load("d")
        self.assertEqual(stopped.record["state"], "interrupted")
        until = 1.05 * stopped.record["time_us"]
        self.assertEqual(
            endoflow.run(ENGINE, "standard", until=until, output="d", restart=True).record["state"], "finished"
        )

    def test_sweep_compare_and_statics(self):
        rows = endoflow.sweep(SMALL, {"molecules.patch_radius": [20, 24]}, until=0.01, output="s")
        self.assertEqual([row["molecules.patch_radius"] for row in rows], [20.0, 24.0])
        self.assertEqual(([row["state"] for row in rows], rows[0]["budding_time_us"]), (["finished"] * 2, None))
        first, second = (endoflow.load(row["directory"]) for row in rows)
        metrics = endoflow.compare(first, second, output="cmp")
        self.assertGreater(metrics["summary"]["max_hausdorff_distance_nm"], 0)
        self.assertTrue(Path("cmp/report.html").exists())
        shape = endoflow.statics({"molecules": {"patch_radius": 20}}, output="st")
        self.assertEqual((shape.engine, len(shape.shapes)), ("statics", 1))

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "xarray is not installed")
    def test_xarray(self):
        run = endoflow.run(ENGINE, SMALL, until=0.01, output="x")
        data = run.to_xarray(points=50)
        self.assertEqual(data["neck_radius_nm"].attrs["units"], "nm")
        self.assertEqual(data["shape_r"].shape, (len(run.shapes), 50))
        np.testing.assert_array_equal(data["membrane_area_nm2"], run.history["membrane_area_nm2"])
        np.testing.assert_allclose(data["shape_r"][:, -1], [shape.r[-1] for shape in run.shapes])


class Pieces(unittest.TestCase):
    def test_toml(self):
        case = {"a": {"x": 1, "y": 2.5e-9, "t": 'say "a\\b"', "on": True, "b": {"z": np.float64(0.1)}}}
        text = toml_of(case)
        if sys.version_info >= (3, 11):
            import tomllib

            self.assertEqual(tomllib.loads(text), case)
        self.assertEqual(settings({"a.x": "word"}), ["--set", 'a.x="word"'])
        self.assertEqual(literal([40, np.float64(60.5)]), "[40, 60.5]")
        for wrong in (None, [None], {}):
            with self.assertRaises(TypeError):
                literal(wrong)
        with self.assertRaisesRegex(TypeError, "a case is a dict of sections"):
            toml_of({"patch_radius": 3})

    def test_the_program_is_found_or_how_to_get_it_is_said(self):
        with tempfile.TemporaryDirectory() as scratch:
            lonely = shutil.copytree(locations.ROOT / "python" / "endoflow", Path(scratch) / "a" / "b" / "endoflow")
            code = f"import sys; sys.path.insert(0, {str(lonely.parent)!r}); import endoflow\n"
            code += "try: print(endoflow.program())\nexcept endoflow.EndoflowError as error: print(error)"

            def found(**environment):
                variables = {"PATH": "/nonexistent", "PYTHONDONTWRITEBYTECODE": "1", **environment}
                return subprocess.run(
                    [sys.executable, "-c", code], env=variables, capture_output=True, text=True
                ).stdout

            self.assertRegex(found(), "was not found: install its Debian package, or build it")
            self.assertRegex(found(ENDOFLOW="/nowhere"), "ENDOFLOW=/nowhere: no such program")
            tool = Path(scratch) / "bin" / "endoflow"
            tool.parent.mkdir()
            tool.write_text("#!/bin/sh\n")
            tool.chmod(0o755)
            self.assertEqual(found(PATH=str(tool.parent)).strip(), str(tool))
            self.assertEqual(found(ENDOFLOW=str(tool)).strip(), str(tool))


if __name__ == "__main__":
    unittest.main()
