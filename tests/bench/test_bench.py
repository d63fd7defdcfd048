"""`make bench` without its measurements: the command line, what is read from run.json and what is written.

    python3 test_bench.py PATH/TO/endoflow
"""

import json
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

BENCH = Path(__file__).resolve().parents[2] / "bench"
sys.path.insert(0, str(BENCH))

import bench  # noqa: E402
import measurements  # noqa: E402

PROGRAM = None


def record(wall, cpu, operators):
    """run.json of a run that buds."""
    return {
        "engine": "boundary-integral",
        "state": "finished",
        "exit_reason": "budded",
        "time_us": 0.826,
        "wall_s": wall,
        "cpu_s": cpu,
        "steps": {"accepted": 93, "rejected": 1},
        "events": {"budding": {"time_us": 0.826}},
        "phases": {"operators": {"wall_s": operators, "cpu_s": 2 * operators}},
        "processes": 1,
        "threads": 2,
    }


class Summary(unittest.TestCase):
    def test_medians_of_repeated_runs(self):
        found = measurements.summary([record(3.0, 5.0, 1.0), record(9.0, 4.0, 2.0), record(4.0, 6.0, 1.5)])
        self.assertEqual((found["wall_s"], found["cpu_s"]), (4.0, 5.0))
        self.assertEqual(found["phases"], {"operators": {"wall_s": 1.5, "cpu_s": 3.0}})
        self.assertEqual(found["budding_time_us"], 0.826)


class Costs(unittest.TestCase):
    def test_up_to_a_time_or_the_end(self):
        with tempfile.TemporaryDirectory() as scratch:
            history = Path(scratch) / "history.csv"
            history.write_text("time_us,wall_s\n0,1\n0.4,3\n1,5\n2.5,8\n", encoding="utf-8")
            found = measurements.costs(history, 2.0, (1, 2, 20))
            self.assertEqual(measurements.late_step_cost(history, 2.0), 6.0)
        self.assertEqual(found, [(1.0, 10.0, 2), (2, 16.0, 3), (2.5, 16.0, 3)])


class CommandLine(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.output = Path(scratch.name) / "bench"
        self.build = PROGRAM.parent

    def main(self, *arguments, **replaced):
        """bench.main() with some measurements replaced."""
        with mock.patch.dict(measurements.ALL, replaced), mock.patch("builtins.print"):
            return bench.main([str(self.build), "-o", str(self.output), *arguments])

    def test_what_is_written(self):
        def run(_bench):
            """A run."""
            return measurements.summary([record(3.0, 5.0, 1.0)])

        def none(_bench):
            """Nothing."""
            return {"skipped": "there is nothing to measure"}

        self.assertEqual(self.main("--only", "to_budding,kernels", to_budding=run, kernels=none), 0)
        found = json.loads((self.output / "bench.json").read_text())
        self.assertEqual(list(found["figures"]), ["to_budding", "kernels"])
        for key in ("processor", "cores", "commit", "load_at_start", "load_at_end"):
            self.assertIn(key, found["machine"])
        page = (self.output / "bench.md").read_text()
        self.assertIn("3.00 s wall, 5.00 s CPU to 0.826 µs (budded); 93 steps, 1 rejected", page)
        self.assertIn("| operators | 1.00 | 2.00 | 40% |", page)
        self.assertIn("Skipped: there is nothing to measure.", page)

    def test_scaling_alone(self):
        walls = {1: [8.0, 6.0, 9.0], 2: [4.0, 4.0, 3.0], 4: [2.0, 3.0, 2.0]}

        def run(_bench, _engine, _name, *_settings, processes):
            """A run of some wall time."""
            solver = {"unknowns_between_processes": 600.0, "iterations": 30.0, "factorisations": 4.0}
            return {"wall_s": walls[processes].pop(0), "notes": {"solver": solver}}

        with mock.patch.object(measurements.Bench, "run", run), mock.patch("pathlib.Path.exists", return_value=True):
            self.assertEqual(self.main("--scaling", "1,2,4"), 0)
        page = (self.output / "bench.md").read_text()
        self.assertIn("| 4 | 2.0 | 4.00 | 600 | 30 | 4 |", page)
        self.assertIn("| 2 | 4.0 | 2.00 | 600 | 30 | 4 |", page)
        self.assertNotIn("ring kernel", page)

    def test_bad_command_lines(self):
        for arguments in (["--only", "nonsense"], ["--repeats", "many"], ["--scaling", "two"]):
            with mock.patch("sys.stderr"), self.assertRaises(SystemExit) as stopped:
                self.main(*arguments)
            self.assertEqual(stopped.exception.code, 2)
        with mock.patch("sys.stderr"), self.assertRaises(SystemExit) as stopped:
            bench.main([str(self.output)])  # no endoflow there
        self.assertEqual(stopped.exception.code, 2)

    def test_a_run_that_fails(self):
        def failing(at):
            """A run that the engine refuses."""
            return at.repeated("boundary-integral", "refused", "molecules.patch_radius=900")

        self.assertEqual(self.main("--only", "to_budding", to_budding=failing), 3)

    def test_the_phase_field_is_left_out_without_its_engine(self):
        found = measurements.phase_field_schemes(measurements.Bench(self.output, self.output, True, 1))
        self.assertIn("without the phase-field engine", found["skipped"])


if __name__ == "__main__":
    PROGRAM = Path(sys.argv.pop(1)).resolve()
    unittest.main()
