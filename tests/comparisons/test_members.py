"""Members of a study: names, what is left to do, command lines, shares of the cores; the Slurm script in bash."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import locations  # noqa: F401
import synthetic
from comparisons.studies.member_runner import shares
from comparisons.studies.members import CONTINUE, FINISHED, FRESH, Member, directory_name, run_command, work_left
from comparisons.studies.progress import duration, expected_seconds, remaining_seconds, steps
from comparisons.studies.sweep_table import row
from scratch import scratch_directory
from studies import StudyTest


class Names(unittest.TestCase):
    def test_directories(self):
        self.assertEqual(directory_name({"a.x": "36", "b.y": "1e-05"}), "x=36/y=1e-05")
        self.assertEqual(directory_name({"a.x": "1", "b.x": "2"}), "a.x=1/b.x=2")
        self.assertEqual(directory_name({"a.x": "../b c"}), "x=..%2Fb%20c")

    def test_different_values_have_different_directories(self):
        values = ("a b", "a_b", "a%20b", "a/b", "ä", "a\nb", "'", '"', "+", "=")
        names = {directory_name({"case.name": value}) for value in values}
        self.assertEqual(len(names), len(values))
        for name in names:
            self.assertRegex(name, r"\A[\w.%=+~-]+\Z")


class Work(unittest.TestCase):
    def setUp(self):
        self.directory = scratch_directory(self)

    def left(self, state="finished", reason="done", checkpoint=True, engine="phase-field", time=1.0, **changes):
        record = {"engine": "phase-field", "state": state, "exit_reason": reason, "time_us": time}
        record["parameters"] = synthetic.parameters()
        (self.directory / "run.json").write_text(json.dumps(record))
        (self.directory / "checkpoint").mkdir(exist_ok=True)
        (self.directory / "checkpoint" / "state.h5").unlink(missing_ok=True)
        if checkpoint:
            (self.directory / "checkpoint" / "state.h5").write_text("")
        return work_left(Member("m", "c", self.directory, engine, (), {}, synthetic.parameters(**changes)))

    def test_states(self):
        self.assertEqual(self.left(), FINISHED)
        self.assertEqual(self.left("interrupted"), CONTINUE)
        self.assertEqual(self.left("interrupted", checkpoint=False), FRESH)
        self.assertEqual(self.left("running", None), CONTINUE)  # its process was killed
        self.assertEqual(self.left("failed", "step-underflow"), FRESH)

    def test_parameters(self):
        self.assertEqual(self.left(phase_field__epsilon=2.0), FRESH)
        self.assertEqual(self.left(boundary_integral__elements=99), FINISHED)
        self.assertEqual(self.left("interrupted", molecules__patch_radius=20.0), FRESH)
        self.assertEqual(self.left(engine="boundary-integral"), FRESH)

    def test_another_end(self):
        self.assertEqual(self.left(time__end=2.0), CONTINUE)
        self.assertEqual(self.left(time__end=2.0, checkpoint=False), FRESH)
        self.assertEqual(self.left(reason="neck-closed", time__end=2.0), FRESH)

    def test_an_earlier_end(self):
        """The synthetic run's end is 1 µs; it is enough where it came as far as asked for."""
        self.assertEqual(self.left(time__end=0.5), FINISHED)
        self.assertEqual(self.left("interrupted", time=0.7, time__end=0.5), FINISHED)
        self.assertEqual(self.left("interrupted", None, time=0.4, time__end=0.5), CONTINUE)
        self.assertEqual(self.left(time__end=0.5, engine="boundary-integral"), FRESH)

    def test_damaged_record(self):
        """It counts as none: the run is made anew, and what is there is kept by the program."""
        for damage in ({"time_us": "x"}, {"events": []}, {"alarms": 1}, {"parameters": {}}):
            with self.subTest(damage):
                self.left()
                record = json.loads((self.directory / "run.json").read_text())
                (self.directory / "run.json").write_text(json.dumps({**record, **damage}))
                member = Member("m", "c", self.directory, "phase-field", (), {}, synthetic.parameters())
                self.assertEqual((work_left(member), row(member)["state"]), (FRESH, "not run"))

    def test_no_run(self):
        self.assertEqual(work_left(Member("m", "c", self.directory / "no", "phase-field", (), {}, {})), FRESH)
        (self.directory / "run.json").write_text("half a rec")
        self.assertEqual(work_left(Member("m", "c", self.directory, "phase-field", (), {}, {})), FRESH)

    def test_command_line(self):
        diffuse = Member("m", "c", Path("d"), "phase-field", ("a.b=1",), {}, {})
        sharp = Member("m", "c", Path("d"), "boundary-integral", (), {}, {})
        run = ["e", "run", "phase-field", "c", "--set", "a.b=1", "-o", "d"]
        self.assertEqual(run_command("e", diffuse, FRESH), run)
        self.assertEqual(run_command("e", diffuse, CONTINUE, 4), ["mpirun", "-n", "4", *run, "--restart"])
        self.assertEqual(run_command("e", sharp, FRESH, 4)[0], "e")


class Cost(unittest.TestCase):
    """Expected costs: what makes them up."""

    def test_steps_of_the_ramp(self):
        times, paper = {"initial_step": 1.0}, {"max_step": 4.0, "ramp_steps": 3}
        # 3 steps of 1, 3 of 2, then steps of 4 µs.
        self.assertEqual([steps(times, paper, end) for end in (2, 3, 9, 17)], [2, 3, 6, 8])
        self.assertEqual(steps(times, {"max_step": 0.5, "ramp_steps": 3}, 5), 10)

    def test_a_thinner_layer_costs_more_and_a_longer_run_too(self):
        def member(engine, **phase_field):
            return Member("m", "c", Path("d"), engine, (), {}, {"phase_field": phase_field})

        thick, thin = (member("phase-field", scheme="paper", epsilon=e, cell_size=0.7 * e) for e in (2.4, 1.2))
        self.assertGreater(expected_seconds(thin, 0.5), 2 * expected_seconds(thick, 0.5))
        for one in (thin, member("boundary-integral"), member("phase-field", scheme="production")):
            self.assertGreater(expected_seconds(one, 20), expected_seconds(one, 0.5))


class Parallel(unittest.TestCase):
    def test_no_more_threads_than_cores(self):
        self.assertEqual(shares(8, None, 1), (8, 1))
        self.assertEqual(shares(8, 3, 1), (3, 2))
        self.assertEqual(shares(8, 100, 2), (4, 1))
        self.assertEqual(shares(2, 1, 4), (1, 1))
        for cores in range(1, 20):
            for jobs in range(1, 20):
                for processes in range(1, cores + 1):
                    parallel, threads = shares(cores, jobs, processes)
                    self.assertLessEqual(parallel * threads * processes, cores)

    def test_time_left(self):
        self.assertIsNone(remaining_seconds([(5.0, 0.0, 10.0)], [10.0] * 3, []))
        # A quarter of what was expected to take 10 s took 5: half as fast as expected.
        self.assertAlmostEqual(remaining_seconds([(5.0, 2.5, 7.5)], [10.0, 10.0], []), 2 * (7.5 + 20))
        # A cheap run that ended says how fast the machine is for a dear one that waits.
        self.assertAlmostEqual(remaining_seconds([(1.0, 0.0, 3.0)], [30.0], [(6.0, 3.0)]), 2 * 33)
        self.assertEqual([duration(s) for s in (5, 200, 7200)], ["5 s", "3 min", "2.0 h"])


class Slurm(StudyTest):
    SWEEP = ("case.toml", "--vary", "molecules.patch_radius=20,30", "--engine", "phase-field", "-o", "a dir")

    def task(self, number):
        """Run one task of the array as Slurm would; mpirun is a stand-in that drops its own options."""
        tools = self.scratch / "tools"
        tools.mkdir(exist_ok=True)
        (tools / "mpirun").write_text('#!/bin/sh\necho "mpirun $1 $2"\nshift 2\nexec "$@"\n')
        (tools / "mpirun").chmod(0o755)
        path = f"{tools}:{os.environ['PATH']}"
        return subprocess.run(
            ["bash", str(self.scratch / "a dir" / "sweep.sbatch")],
            cwd=self.scratch,
            env={**self.environment(), "SLURM_ARRAY_TASK_ID": str(number), "PATH": path},
            capture_output=True,
            text=True,
            timeout=1200,
        )

    def test_script(self):
        process = self.call("sweep", *self.SWEEP, "--slurm", "--processes", "3", "--jobs", "5")
        self.assertEqual((process.returncode, process.stderr, self.runs()), (0, "", []))
        script = self.scratch / "a dir" / "sweep.sbatch"
        subprocess.run(["bash", "-n", str(script)], check=True)
        text = script.read_text()
        self.assertIn("#SBATCH --array=0-1%5\n", text)
        self.assertIn("#SBATCH --ntasks=3\n", text)
        self.assertIn(
            "1) run fresh 'a dir/patch_radius=30/phase-field' mpirun -n 3 \"$endoflow\" run phase-field case.toml"
            " --set molecules.patch_radius=30 -o 'a dir/patch_radius=30/phase-field' ;;",
            text,
        )

    def test_nothing_in_a_name_becomes_a_line_of_the_script(self):
        sweep = self.SWEEP[:-1]
        for name in ("a\n#SBATCH --account=other\nrm -rf x", 'a"b', "a\\b"):
            process = self.call("sweep", *sweep, name, "--slurm")
            self.assert_one_line(process, 2, "-o: .* cannot stand in a batch script; choose a name without line breaks")
            self.assertEqual(list(self.scratch.rglob("*.sbatch")), [])
        self.assertEqual(self.call("sweep", *sweep, "it's $(touch x) 5%A", "--slurm").returncode, 0)
        text = (self.scratch / "it's $(touch x) 5%A" / "sweep.sbatch").read_text()
        self.assertIn('#SBATCH --output="it\'s $(touch x) 5%%A/slurm-%A_%a.txt"\n', text)
        self.assertIn(f'#SBATCH --chdir="{self.scratch}"\n', text)

    def test_tasks_run_are_left_out_when_finished_and_are_collected(self):
        self.call("sweep", *self.SWEEP, "--slurm", "--processes", "2")
        for number in (0, 1):
            task = self.task(number)
            self.assertEqual((task.returncode, task.stdout, task.stderr), (0, "mpirun -n 2\n", ""))
        self.assertEqual(self.runs(), [f"a dir/patch_radius={p}/phase-field fresh" for p in (20, 30)])
        self.assertIn("finished already", self.task(0).stdout)
        record = self.scratch / "a dir/patch_radius=30/phase-field/run.json"
        record.write_text(record.read_text().replace('"state": "finished"', '"state": "interrupted"'))
        self.task(1)
        self.assertEqual(self.runs(), ["a dir/patch_radius=30/phase-field restart"])
        self.assertEqual(self.task(7).returncode, 2)
        self.assertEqual(self.call("sweep", *self.SWEEP, "--collect").returncode, 0)
        self.assertEqual((self.scratch / "a dir/sweep.csv").read_text().count("finished"), 2)
        self.assertIn("nothing to submit", self.call("sweep", *self.SWEEP, "--slurm").stdout)


if __name__ == "__main__":
    sys.exit(unittest.main())
