"""What `endoflow compare` writes."""

import json
import unittest

import locations  # noqa: F401
from command import CompareTest, call, compare, unnamed_basis

import synthetic

PLOTS = ("membranes", "outlines", "concentration", "histories", "distances")


class Output(CompareTest):
    def test_writes_everything(self):
        output = self.scratch / "deep" / "out"
        process = compare(self.a, self.b, "-o", output)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertIn(str(output / "report.html"), process.stdout)
        self.assertEqual(json.loads((output / "metrics.json").read_text())["schema_version"], 1)
        for name in PLOTS:
            self.assertEqual((output / f"{name}.png").read_bytes()[:4], b"\x89PNG")
            self.assertIn("<svg", (output / f"{name}.svg").read_text())
        self.assertLess((output / "report.html").stat().st_size, 5e6)
        self.assertEqual(unnamed_basis((output / "report.html").read_text()), [])

    def test_run_against_itself(self):
        output = self.scratch / "itself"
        process = compare(self.a, self.a, "-o", output)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        metrics = json.loads((output / "metrics.json").read_text())
        self.assertEqual(metrics["summary"]["max_hausdorff_distance_nm"], 0)
        self.assertNotEqual(metrics["runs"]["a"]["label"], metrics["runs"]["b"]["label"])

    def flat(self, name, times):
        """A run whose membrane hardly leaves the plane."""
        return synthetic.write_run(
            self.scratch / name, "phase-field", lambda t: synthetic.budding_membrane(0.05 * t, 1.0), times
        )

    def test_runs_without_a_bud(self):
        process = compare(self.flat("flat", [0.0, 0.25]), self.a, "-o", self.scratch / "without")
        self.assertEqual((process.returncode, process.stderr), (0, ""))

    def test_one_common_moment_is_nothing_to_compare(self):
        """Both start from the same membrane: a report of the start alone would say 0 nm everywhere."""
        process = compare(self.flat("start", [0.0]), self.a, "-o", self.scratch / "moment")
        self.assert_one_line(process, 2, "nothing to compare: .* share only t = 0 µs; run them longer, or write shapes")
        self.assertFalse((self.scratch / "moment").exists())

    def test_alarms_are_shown(self):
        alarmed = self.flat("alarmed", [0.0, 0.25])
        record = json.loads((alarmed / "run.json").read_text())
        record["alarms"] = [synthetic.ALARM]
        (alarmed / "run.json").write_text(json.dumps(record))
        process = compare(self.a, alarmed, "-o", self.scratch / "with_alarm")
        sentence = "energy-balance at t = 0.125 µs: rate against power: 0.0041, allowed 0.001; raise elements"
        self.assertIn(f"warning: run B ({alarmed}): {sentence}", process.stderr)
        self.assertIn(sentence, (self.scratch / "with_alarm" / "report.html").read_text())
        metrics = json.loads((self.scratch / "with_alarm" / "metrics.json").read_text())
        self.assertEqual([alarm["name"] for alarm in metrics["runs"]["b"]["alarms"]], ["energy-balance"])

    def test_a_page_of_one_run(self):
        """It says what the numbers rest on; a run that looked at its balances has no alarms or names them."""
        alone = self.flat("alone", [0.0, 0.25])
        for alarms, words in ((None, "not recorded"), ([], "none"), ([synthetic.ALARM], "energy-balance")):
            record = json.loads((alone / "run.json").read_text())
            record["alarms"] = alarms
            if alarms is None:
                del record["alarms"]
            (alone / "run.json").write_text(json.dumps(record))
            process = call("report", alone)
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            page = (alone / "report" / "report.html").read_text()
            self.assertRegex(page, rf"<th scope=\"row\">alarms</th><td>{words}")
            self.assertIn("<td>as-printed</td>", page)
            self.assertIn("32 elements, time tolerance", page)
            self.assertRegex(page, r"membrane_<wbr>area_<wbr>nm2</code></th><td>[\d\u2009]+</td><td>nm²</td><td>what the family has")
            self.assertNotRegex(page, r"(?:src|href)=\"(?!data:)")
            self.assertEqual(unnamed_basis(page), [])

    def test_a_full_disk_names_the_file(self):
        for name in ("metrics.json", "histories.png", "report.html"):
            output = self.scratch / f"full {name}"
            output.mkdir()
            (output / name).symlink_to("/dev/full")
            process = compare(self.a, self.b, "-o", output)
            self.assert_one_line(process, 4, f"{name}: No space left on device; free some space")

    def test_a_full_disk_behind_standard_output(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            process = compare(self.a, self.b, "-o", self.scratch / "full output", stdout=full)
        self.assert_one_line(process, 4, "standard output: No space left on device")

    def test_one_run_ends_before_the_other_buds(self):
        """The common times end at 0.5 µs, budding is at 0.73 µs, and the longer run's history at 5 µs."""
        long = synthetic.write_run(
            self.scratch / "long",
            "boundary-integral",
            lambda t: synthetic.budding_membrane(min(t, 1.0), 1.0),
            [0.25 * i for i in range(21)],
            100,
        )
        short = synthetic.write_run(
            self.scratch / "short", "phase-field", lambda t: synthetic.budding_membrane(t, 1.0), [0.0, 0.25, 0.5], 100
        )
        process = compare(long, short, "-o", self.scratch / "unequal")
        self.assertEqual((process.returncode, process.stderr), (0, ""))

    def test_differing_cases_warn(self):
        case = synthetic.parameters(molecules__patch_radius=40.0)
        other = synthetic.write_run(
            self.scratch / "other", "phase-field", lambda t: synthetic.budding_membrane(t, 1.0), [0.0, 1.0], 100, case
        )
        process = compare(self.a, other, "-o", self.scratch / "warned")
        self.assertEqual(process.returncode, 0)
        self.assertIn("warning: the cases differ in molecules.patch_radius: 36.0 (A), 40.0 (B)", process.stderr)


if __name__ == "__main__":
    unittest.main()
