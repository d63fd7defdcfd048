"""The command line as a script sees it: exit codes, one line on stderr, nothing written when the input is bad.

    python3 command_line_test.py PATH/TO/endoflow
"""

import json
import os
import re
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from command_lines import CommandLineTest  # noqa: E402
from scratch import scratch_directory  # noqa: E402

PROGRAM = None


def endoflow(*arguments, cwd=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, timeout=1200)


class CommandLine(CommandLineTest):
    def setUp(self):
        self.root = scratch_directory(self)

    def case(self, text):
        file = self.root / "case.toml"
        file.write_text(text)
        return file

    def test_help_and_version(self):
        for arguments in (["--help"], ["--version"], ["run", "--help"], ["run", "boundary-integral", "--help"],
                          ["params", "--help"], ["check", "--help"], ["summary", "--help"], ["laws", "--help"],
                          ["reproduce", "--help"], ["movie", "--help"], ["revolve", "--help"]):
            with self.subTest(arguments):
                result = endoflow(*arguments)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertTrue(result.stdout)

    def test_blas_knows_the_processor(self):
        """OpenBLAS takes processors newer than itself for one with SSE3 alone, and says which kernels it has loaded."""
        flags = Path("/proc/cpuinfo").read_text(encoding="utf-8").split()
        if not {"avx2", "fma"} <= set(flags):
            self.skipTest("a processor without AVX2")
        environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_CORETYPE"}
        environment["OPENBLAS_VERBOSE"] = "2"
        for words in (["run", "boundary-integral", "--help"], ["modes", "--help"]):
            with self.subTest(words):
                result = subprocess.run([PROGRAM, *words], env=environment, capture_output=True, text=True, timeout=60)
                loaded = re.findall(r"^Core: (\S+)", result.stdout + result.stderr, re.MULTILINE)
                self.assertNotIn("Prescott", loaded[-1:], result.stderr)

    def test_bad_command_lines(self):
        self.assert_refused(endoflow("rnu"), 2, "did you mean 'run'")
        self.assert_refused(endoflow("run", "phase-feild"), 2, "did you mean 'phase-field'")
        self.assert_refused(endoflow("run", "boundary-integral"), 2, "CASE")
        self.assert_refused(endoflow("run", "boundary-integral", self.case(""), "--nonsense"), 2, "nonsense")
        self.assert_refused(endoflow("params", "--toml", "--markdown"), 2)
        self.assert_refused(endoflow("check"), 2, "CASE")

    def test_case_that_cannot_be_read_to_its_end(self):
        """A read error is not the end of the file: the keys behind it would silently have their defaults."""
        self.assert_refused(endoflow("check", "/proc/self/mem"), 4, "/proc/self/mem", "cannot be read")

    def test_directory_without_a_name(self):
        """As of a variable of a script that is not set."""
        self.assert_refused(endoflow("run", "boundary-integral", self.case(""), "-o", ""), 2, "-o", "no directory")

    def test_bad_case_writes_nothing(self):
        output = self.root / "run"
        for text, words in (("[time]\nned = 1\n", ("case.toml:2:1", "time.end")),
                            ("[time]\nend = 'x'\n", ("case.toml:2:7", "a number")),
                            ("[domain]\nradius = -3\n", ("domain.radius", "> 0")),
                            ("[time\n", ("case.toml:1", "TOML"))):
            with self.subTest(text):
                result = endoflow("run", "boundary-integral", self.case(text), "-o", output)
                self.assert_refused(result, 2, *words)
                self.assertFalse(output.exists())
        self.assert_refused(endoflow("run", "boundary-integral", self.root / "none.toml", "-o", output), 2, "none.toml")
        self.assert_refused(endoflow("check", self.case("[fluid]\ninertia = 3\n")), 2, "true or false")
        self.assertFalse(output.exists())

    def test_what_an_engine_does_not_have_is_named(self):
        """Loads, coupling and exchange that a case may ask for, but not of every engine."""
        coupling = '[molecules]\ncoupling = "energetic"\nline_energy = 20\n'
        growth = '[molecules]\nexchange = "edge"\nedge_speed = 1e-3\n'
        paper = ("--set", "phase_field.scheme=paper")
        for engine, text, options, words in (
            (("run", "phase-field"), coupling, paper, ("molecules.coupling must be none", "scheme paper")),
            (("run", "phase-field"), "[membrane]\nrim_tension = 0.1\n", paper, ("membrane.rim_tension", "scheme paper")),
            (("run", "phase-field"), growth, paper, ("molecules.exchange", "scheme paper")),
            (("statics",), growth, (), ("molecules.exchange", "statics engine")),
        ):
            with self.subTest(engine=engine, options=options):
                output = self.root / "out"
                self.assert_refused(endoflow(*engine, self.case(text), "-o", output, *options), 2, *words)
                self.assertFalse(output.exists())

    def test_bad_case_leaves_an_earlier_run_alone(self):
        output = self.root / "run"
        output.mkdir()
        (output / "run.json").write_text("precious")
        self.assert_refused(endoflow("run", "boundary-integral", self.case("[x]\n"), "-o", output), 2)
        self.assertEqual((output / "run.json").read_text(), "precious")

    def test_output_that_cannot_be_written(self):
        blocked = self.root / "file"
        blocked.write_text("x")
        self.assert_refused(endoflow("run", "boundary-integral", self.case(""), "-o", blocked / "run"), 4, "file")
        self.assert_refused(endoflow("run", "boundary-integral", self.case(""), "-o", "/proc/none"), 4)
        self.assertEqual(blocked.read_text(), "x")

    def test_restart_without_a_run(self):
        result = endoflow("run", "boundary-integral", self.case(""), "-o", self.root / "none", "--restart")
        self.assert_refused(result, 4, "run without --restart")

    def test_check_and_params(self):
        self.assertEqual(endoflow("check", self.case("")).returncode, 0)
        toml = endoflow("params", "--toml")
        self.assertEqual(toml.returncode, 0)
        self.assertEqual(endoflow("check", self.case(toml.stdout)).returncode, 0)
        markdown = endoflow("params", "--markdown").stdout
        self.assertIn("| `patch_radius` |", markdown)
        rows = [re.split(r"(?<!\\)\|", line) for line in markdown.splitlines() if line.startswith("|")]
        self.assertEqual({len(row) for row in rows}, {9})  # seven cells between outer bars, also where a meaning has a |
        self.assertIn("molecules.patch_radius", endoflow("params").stdout)

    def test_some_of_the_parameters(self):
        lines = endoflow("params", "fluid").stdout.splitlines()
        self.assertGreater(len(lines), 3)
        self.assertTrue(all(line.startswith("fluid.") for line in lines), lines)
        toml = endoflow("params", "time", "--toml").stdout
        self.assertEqual(re.findall(r"^\[.*", toml, re.M), ["[time]"])
        self.assertEqual(endoflow("check", self.case(toml)).returncode, 0)
        (only,) = json.loads(endoflow("params", "time.end", "--json").stdout)
        self.assertEqual((only["name"], only["default"], only["unit"]), ("time.end", 20.0, "µs"))
        self.assert_refused(endoflow("params", "molecule"), 2, "did you mean 'molecules'")
        self.assert_refused(endoflow("params", "time.ned"), 2, "did you mean 'time.end'")

    def test_cases_by_name(self):
        self.assertIn("valid (case 'fickian')", endoflow("check", "fickian", cwd=self.root).stdout)
        self.assert_refused(endoflow("check", "fickain", cwd=self.root), 2, "did you mean 'fickian'")
        self.assert_refused(endoflow("run", "boundary-integral", "x" * 20, cwd=self.root), 2, "known: ", "standard")
        self.assertEqual(list(self.root.iterdir()), [])
        (self.root / "fickian").write_text("[case]\nname = 'mine'\n")  # a file of that name comes first
        self.assertIn("(case 'mine')", endoflow("check", "fickian", cwd=self.root).stdout)

    def test_commands_describe_their_options(self):
        for command in (["run", "boundary-integral"], ["statics"], ["check"], ["params"], ["laws"], ["summary"],
                        ["sweep"], ["infer"], ["crate"], ["movie"]):
            with self.subTest(command):
                found = json.loads(endoflow(*command, "--describe").stdout)
                self.assertEqual(found["command"], " ".join(["endoflow", *command]))
                shown = endoflow(*command, "--help").stdout
                for option in found["options"]:
                    for name in option["names"] or [option["value"]]:
                        self.assertIn(name, shown)

    def test_constitutive_laws(self):
        rows = [row.split(",") for row in endoflow("laws").stdout.splitlines()]
        table = {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}
        self.assertEqual((table["c"][0], table["c"][50], table["c"][100]), (0, 0.5, 1))
        # With b_m = 100, b_c = 1100 pN nm at c = 1/2: Table 1, (A.7), (A.8).
        h = 0.0709219858
        for name, value in (("linear_b_pN_nm", 650), ("coarse-grained_b_pN_nm", 1200 * 100 / (1200 - 550)),
                            ("lumped_b_pN_nm", 650), ("linear_H0_per_nm", h / 2),
                            ("coarse-grained_H0_per_nm", h / 2 * 11 / 12), ("lumped_H0_per_nm", h * 550 / 650)):
            self.assertAlmostEqual(table[name][50] / value, 1, delta=1e-12, msg=name)
        softer = endoflow("laws", self.case(""), "--set", "membrane.bending_stiffness=50")
        self.assertEqual(softer.stdout.splitlines()[1].split(",")[1], "50")
        self.assert_refused(endoflow("laws", self.root / "none.toml"), 2, "none.toml")

    def test_help_of_commands(self):
        for words in (["help", "run"], ["run", "--help"]):
            for option in ("--restart", "--until", "--set", "--output"):
                self.assertIn(option, endoflow(*words).stdout)
        self.assertEqual(endoflow("help").stdout, endoflow("--help").stdout)
        self.assertIn("--json", endoflow("help", "check").stdout)
        self.assert_refused(endoflow("help", "rnu"), 2, "did you mean 'run'")

    def test_numbers_on_the_command_line(self):
        for text, value in ((".5", 0.5), ("+.5e1", 5.0), ("2.", 2.0)):
            result = endoflow("check", self.case(""), "--set", f"time.end={text}", "--set", "time.max_step=0.1", "--json")
            self.assertEqual(json.loads(result.stdout)["time"]["end"], value)

    def test_numbers_that_are_none(self):
        """Too large for a double: a number out of range, not a text."""
        for text in ("1e400", "-1e400"):
            with self.subTest(text):
                result = endoflow("check", self.case(""), "--set", f"domain.radius={text}")
                self.assert_refused(result, 2, f"{text} is out of the range of numbers", "domain.radius must be a number > 0")

    def test_help_names_what_an_option_takes(self):
        for words in (["run", "boundary-integral"], ["statics"], ["check"], ["laws"]):
            self.assertRegex(endoflow(*words, "--help").stdout, "--set section.key=value")

    def test_check_foresees_what_is_too_coarse(self):
        """What was measured to be off by 0.4 % and more, against the sharp engine's converged results."""
        for setting, words in (("boundary_integral.elements=20", ("needs about 54 elements, not 20", "elements = 0")),
                               ("domain.radius=2000", ("needs about 1014 elements, more than 320", "domain.radius")),
                               ("molecules.patch_radius=70", ("domain.radius above 87.5",)),
                               ("phase_field.cell_size=3", ("phase-field", "cell_size = 0"))):
            with self.subTest(setting):
                result = endoflow("check", self.case(""), "--set", setting)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertTrue(result.stderr.startswith("warning: "))
                for word in words:
                    self.assertIn(word, result.stderr)
        for setting in ("molecules.interface_width=0.6", "domain.radius=200", "time.tolerance=1e-4"):
            self.assertEqual(endoflow("check", self.case(""), "--set", setting).stderr, "")

    def test_edge_that_the_elements_do_not_resolve(self):
        """The mesh is to blame, not the constitutive law."""
        result = endoflow("run", "boundary-integral", self.case(""), "--set", "molecules.interface_width=0.05", "--set", "boundary_integral.elements=20",
                          "--set", "membrane.bending_stiffness_coated=10000", "--set", "output.field_interval=0", "-o", self.root / "run", "--until", "0.01")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("unresolved-coat-edge", result.stderr)
        self.assertIn("molecules.interface_width = 0.05", result.stderr)
        self.assertNotIn("constitutive_law", result.stderr)

    def test_output_that_nobody_takes(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "params"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assert_refused(result, 4, "No space left on device")

    def test_summary_of_nothing(self):
        self.assert_refused(endoflow("summary", self.root), 4, "run.json")
        (self.root / "run.json").write_text("{")
        self.assert_refused(endoflow("summary", self.root), 4, "damaged")

    def test_a_short_run_is_complete(self):
        output = self.root / "run"
        result = endoflow("run", "boundary-integral", self.case(""), "-o", output, "--until", "0.0002")
        self.assertEqual(result.returncode, 0, result.stderr)
        record = json.loads((output / "run.json").read_text())
        self.assertEqual((record["state"], record["exit_reason"]), ("finished", "done"))
        self.assertAlmostEqual(record["time_us"], 0.0002, delta=1e-12)
        for name in ("history.csv", "shapes.h5", "log.txt", "checkpoint/state.h5"):
            self.assertTrue((output / name).exists(), name)
        self.assertIn(f"finished at t = 0.0002 µs; results in {output}; continue with --restart", result.stdout)
        summary = endoflow("summary", output)
        self.assertEqual(summary.returncode, 0, summary.stderr)
        self.assertRegex(summary.stdout, r"\n  membrane area +2010\d nm²\n")
        self.assertRegex(summary.stdout, r"\n  curvature convention as-printed: β\(0\) = 50, β\(1\) = 600 pN nm, C\(1\) = 0.14184 1/nm; 54 elements, time tolerance 0.0001; "
                         r"relative accuracy 0.001 asked for, 2.0e-04 reached\n")
        self.assertRegex(summary.stdout, r"\n  neck radius +-\n")
        self.assertNotRegex(summary.stdout, r"e\+\d")

    def test_summary_of_stationary_shapes(self):
        """They have no time: a branch counts its shapes."""
        case = self.case("[molecules]\npatch_radius = 20\n")
        for name, arguments, words in (("one", [], "one stationary shape"),
                                       ("branch", ["--continue-in", "molecules.patch_radius=20.5"],
                                        r"\d+ stationary shapes, molecules.patch_radius from 20 to 20.5")):
            self.assertEqual(endoflow("statics", case, "-o", self.root / name, *arguments).returncode, 0)
            summary = endoflow("summary", self.root / name).stdout
            self.assertRegex(summary, words)
            self.assertNotRegex(summary, "µs")

    def test_summary_shows_alarms(self):
        output = self.root / "run"
        endoflow("run", "boundary-integral", self.case(""), "-o", output, "--until", "0.0002")
        record = json.loads((output / "run.json").read_text())
        alarm = {"name": "energy-balance", "time_us": 1e-4, "value": 0.0041, "bound": 0.001, "meaning": "rate of energy",
                 "remedy": "raise boundary_integral.elements"}
        for alarms, line in (([], "no alarms: every balance stayed within its bound"),
                             ([alarm], "alarm: energy-balance at t = 0.0001 µs: rate of energy: 0.0041, allowed 0.001; raise")):
            (output / "run.json").write_text(json.dumps({**record, "alarms": alarms, "accuracy": {"energy-balance": {"largest": 0.0041}}}))
            self.assertIn(line, endoflow("summary", output).stdout)

    def test_interruption_leaves_a_checkpoint_to_restart_from(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)):
            with self.subTest(code):
                output = self.root / str(code)
                case = self.case("[time]\nend = 5\n")
                run = subprocess.Popen([PROGRAM, "run", "boundary-integral", case, "-o", output],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                history = output / "history.csv"
                for _ in range(600):
                    if history.exists() and history.read_text().count("\n") > 3:
                        break
                    time.sleep(0.1)
                run.send_signal(number)
                told, _ = run.communicate(timeout=1200)
                self.assertIn("interrupted, checkpoint written, at t = ", told)
                self.assertEqual(run.returncode, code)
                reached = json.loads((output / "run.json").read_text())["time_us"]
                result = endoflow("run", "boundary-integral", case, "-o", output, "--restart", "--until",
                                  f"{reached * 1.05:.17g}")
                self.assertEqual(result.returncode, 0, result.stderr)
                times = [float(row.split(",")[0]) for row in history.read_text().splitlines()[1:]]
                self.assertEqual(times, sorted(set(times)))


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
