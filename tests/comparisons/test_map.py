"""`endoflow map`: boundaries between outcomes, traced by halving cells, and the command with runs in closed form."""

import csv
import unittest
from pathlib import Path
from unittest import mock

import locations  # noqa: F401
from command import unnamed_basis
from studies import SweepTest

import endoflow
from comparisons.commands.map import static_points
from comparisons.studies.outcome_map import Cell, boundaries, outcome_of, traced

#: The membranes of the fake program have a neck from this fraction of their duration on, and one of 5 nm from that. They are
#: domes from 0.0702 on, before any end of the map below.
NECK, BUD = 0.2375, 0.7346


class Tracing(unittest.TestCase):
    def traced(self, inside, cells, levels):
        """(known, boundary's points, calls) for a region of the plane."""
        calls = []

        def outcomes(points):
            calls.append(points)
            return {point: "bud" if inside(*point) else "neck" for point in points}

        known, last = traced(cells, levels, outcomes)
        return known, boundaries(last, known), calls

    def test_a_circle(self):
        """Every point of the boundary is within half an edge of the circle, and all of the circle is there, for a fifth of the grid's runs."""
        known, found, calls = self.traced(lambda x, y: (x - 60) ** 2 + (y - 70) ** 2 < 41.3**2, 8, 4)
        self.assertEqual([*found], [("neck", "bud")])
        radii = [((x - 60) ** 2 + (y - 70) ** 2) ** 0.5 for x, y in found["neck", "bud"]]
        self.assertLess(max(abs(radius - 41.3) for radius in radii), 0.5 + 1e-9)
        # A circle crosses 8 r lines of the grid, each once.
        self.assertEqual(len(radii), 4 * (2 * 41 + 1))
        self.assertLess(len(known), 0.2 * 129**2)
        self.assertEqual(len(calls), 5)
        asked = [point for points in calls for point in points]
        self.assertEqual(len(asked), len(set(asked)))

    def test_one_outcome(self):
        known, found, _ = self.traced(lambda x, y: False, 4, 3)
        self.assertEqual((len(known), found), (25, {}))

    def test_cells(self):
        self.assertEqual(Cell(0, 0, 2).halves(), [Cell(0, 0, 1), Cell(1, 0, 1), Cell(0, 1, 1), Cell(1, 1, 1)])

    def test_outcomes(self):
        parameters = {"molecules": {"patch_radius": 30.0}}
        finished = {"state": "finished", "events": {}, "parameters": parameters}
        for record, neck, height, wanted in (
            (None, None, None, "failed"),
            (finished, None, None, "flat"),
            (finished, None, 11.4, "flat"),  # 30 nm sin 22.5° = 11.48 nm
            (finished, None, 11.5, "dome"),
            (finished, None, -11.5, "dome"),  # out of the cell
            (finished, 12.0, 40.0, "neck"),
            ({**finished, "events": {"budding": {}}}, 5.0, 40.0, "bud"),
            ({**finished, "events": {"budding": {}, "neck_closed": {}}}, 0.5, 40.0, "closed"),
        ):
            self.assertEqual(outcome_of(record, neck, height), wanted)

    def test_what_stationary_shapes_say(self):
        """Folds and closing necks of branches, whichever of the two parameters they go along."""
        record = {"parameter": "molecules.patch_radius", "end": 29.5, "folds": [{"value": 30.0}, {"value": 28.0}]}
        parameters = {"molecules": {"patch_radius": 10.0}, "membrane": {"rim_tension": 0.2}}
        run = endoflow.Run(Path("."), {"notes": {"branch": record}, "exit_reason": "neck-closed"}, parameters, {}, [])
        keys = ["molecules.patch_radius", "membrane.rim_tension"]
        with mock.patch.object(endoflow, "load", return_value=run):
            found = static_points([Path("branch")], keys)
            turned = static_points([Path("branch")], keys[::-1])
        self.assertEqual(found, {"stationary fold": [(30.0, 0.2), (28.0, 0.2)], "stationary neck closes": [(29.5, 0.2)]})
        self.assertEqual(turned["stationary neck closes"], [(0.2, 29.5)])


class Map(SweepTest):
    RANGES = ("--vary", "fluid.viscosity_intracellular=0.01:0.03", "--vary", "time.end=0.3:1.5")

    def test_boundaries_of_a_motion_known_in_closed_form(self):
        """A neck, and a bud, once the end is beyond a fraction of the duration: straight lines through the plane."""
        self.defaults("output", field_interval=1.0)
        arguments = ("map", "case.toml", *self.RANGES, "--cells", "2", "--levels", "1", "-o", "m")
        process = self.call(*arguments)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        with open(self.scratch / "m/boundaries.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        fractions = {"dome | neck": NECK, "neck | bud": BUD}
        self.assertEqual({row["between"] for row in rows}, set(fractions))
        for row in rows:
            viscosity, end = float(row["fluid.viscosity_intracellular"]), float(row["time.end"])
            # Half an edge is 0.0025 along the viscosity, which moves the line by a quarter of its fraction, and 0.15 µs.
            self.assertLessEqual(abs(end - 100 * viscosity * fractions[row["between"]]), 0.25 * BUD + 0.15)
        self.assertIn("instead of the 25 of the full grid", process.stdout)
        page = (self.scratch / "m/report.html").read_text()
        self.assertIn("fluid.viscosity_intracellular", page)
        self.assertEqual(unnamed_basis(page), [])
        self.assertTrue((self.scratch / "m/map.png").exists())
        self.assertGreater(len(self.runs()), 9)
        again = self.call(*arguments)
        self.assertEqual((again.returncode, again.stderr, self.runs()), (0, "", []))

    def test_refused(self):
        for vary, message in (
            (("--vary", "time.end=1:2"), "needs --vary for two parameters"),
            (("--vary", "time.end=1:2", "--vary", "time.end=1:3"), "needs --vary for two parameters"),
            (("--vary", "time.end=2:1", "--vary", "phase_field.epsilon=1:2"), "low below high"),
        ):
            with self.subTest(message):
                self.assert_one_line(self.call("map", "case.toml", *vary), 2, message)
        self.assert_one_line(
            self.call("map", "case.toml", *self.RANGES, "--folds", "nowhere"), 4, "no such directory"
        )


if __name__ == "__main__":
    unittest.main()
