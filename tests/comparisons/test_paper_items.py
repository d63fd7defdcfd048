"""The paper's questions: what runs they ask for, and what they make of areas."""

import unittest
from pathlib import Path

import locations  # noqa: F401
import numpy as np
import endoflow
from comparisons.paper.wanted_runs import LONGEST_NAME, short_enough
from comparisons.paper import attribution, fig5, mobility, printed, table2, timescale
from comparisons import PHASE_FIELD  # noqa: E402
from comparisons.paper.item import NotRun, filled, state_of, value_at
from comparisons.measures.metrics import flattened


def run_with(area, time=(0.0, 0.5)):
    """A run whose history has only times and areas."""
    history = {"time_us": np.array(time), "membrane_area_nm2": np.array(area, dtype=float)}
    return endoflow.Run(Path("."), {"events": {}, "exit_reason": "done"}, {}, history, [])


class Rows(unittest.TestCase):
    def test_state(self):
        run = run_with([1, 1])
        self.assertEqual(state_of(run), "done")
        run.record.update(exit_reason=None, state="running")
        self.assertEqual(state_of(run), "running")
        self.assertEqual(state_of(NotRun("no time")), "not run: no time")
        self.assertEqual(state_of(None), "not asked for")

    def test_what_is_not_run_has_no_value_and_says_so_in_its_panel(self):
        for missing in (None, NotRun("no time")):
            self.assertIsNone(value_at(missing, "membrane_area_nm2", 0.5))
        self.assertIn("not run: no time", fig5.panel(28, NotRun("no time")))

    def test_columns_are_those_of_the_longest_row(self):
        self.assertEqual(filled([{"a": 1}, {"a": 2, "b": 3}]), [{"a": 1, "b": None}, {"a": 2, "b": 3}])


class NamesOfRuns(unittest.TestCase):
    def test_a_name_that_no_file_system_takes_is_shortened_and_stays_one_of_its_own(self):
        long = [",".join(f"setting_{i}={value}" for i in range(30)) for value in (1, 2)]
        short = [short_enough(name) for name in long]
        self.assertEqual(short_enough("standard,epsilon=0.85"), "standard,epsilon=0.85")
        self.assertEqual([len(name.encode()) for name in short], [LONGEST_NAME] * 2)
        self.assertNotEqual(*short)


class PrintedSettings(unittest.TestCase):
    def test_the_standard_values_are_those_of_the_case_file(self):
        self.assertEqual(printed.settings({}, False), {})
        for symbol, value in printed.STANDARD.items():
            self.assertEqual(printed.settings({symbol: value}, False), {}, symbol)

    def test_one_epsilon_for_layer_and_coat_and_the_grid_goes_with_it(self):
        thick = printed.settings({"ε": 2.4}, False)
        wanted = {
            "phase_field.epsilon": "2.4",
            "molecules.interface_width": "2.4",
            "phase_field.cell_size": "1.77",  # a square of the diameter 2.5 nm
        }
        self.assertEqual(thick, wanted)

    def test_units_of_the_print(self):
        self.assertEqual(printed.settings({"γ": 12.8}, False), {"phase_field.paper.mobility": "1.28e-05"})
        self.assertEqual(printed.settings({"τ": 0.25}, False), {"phase_field.paper.max_step": "0.00025"})

    def test_the_column_of_h_has_the_print_s_short_steps(self):
        runs = {one.name: one.settings for one in table2.wanted(False)}
        self.assertEqual(runs["h=0.63"], {"phase_field.cell_size": "0.45", "phase_field.paper.max_step": "0.0001"})
        self.assertEqual(runs["h, τ = 2 ns=0.63"], {"phase_field.cell_size": "0.45"})
        self.assertEqual(len({tuple(sorted(own.items())) for own in runs.values()}), 16, "four are one run")


class Table2(unittest.TestCase):
    def test_where_the_printed_column_of_epsilon_goes(self):
        # By hand: areas 20 764, 21 867 and 22 700 nm² at 2.4, 1.7 and 1.2 nm.
        limits = table2.printed_limits()
        self.assertAlmostEqual(limits["two thinnest"], 22700 + 1.2 * 833.09 / 0.5, delta=1)
        self.assertAlmostEqual(limits["line"], 24618, delta=10)
        self.assertAlmostEqual(limits["parabola"], 24850, delta=20)

    def test_changes_have_signs(self):
        area = {(symbol, value): 100.0 for symbol, (_, entries) in table2.COLUMNS.items() for value, _ in entries}
        area["ε", 2.4] = 90.0
        time = dict.fromkeys(table2.COLUMNS, 0.5)
        row = next(r for r in table2.rows_of(area, time) if (r["parameter"], r["printed_value"]) == ("ε", 2.4))
        self.assertEqual((row["signed_change_percent"], row["change_percent"]), (-10, 10))

    def test_a_column_is_compared_where_all_its_runs_are_sound(self):
        runs = {one.name: {PHASE_FIELD: run_with((20106, 22700))} for one in table2.wanted(False)}
        runs["h=1.77"] = {PHASE_FIELD: run_with((20106, 20500), (0.0, 0.0629))}
        time = table2.times(runs, 0.5)
        self.assertEqual((time["h"], time["ε"]), (0.9 * 0.0629, 0.5))
        self.assertAlmostEqual(table2.areas(runs, time)["h", 1.77], 20106 + 0.9 * (20500 - 20106))
        self.assertIn("h=1.77 ends at 0.0629 µs", table2.early_ends(runs, 0.5)[0])


class Attribution(unittest.TestCase):
    def rows(self, areas):
        """Rows of a ladder with these areas at 0.5 µs; None: not run."""
        names = [rung.name for rung in (*attribution.RUNGS, attribution.PRODUCTION, attribution.LIMIT)]
        self.assertEqual(len(areas), len(names))
        runs = {
            name: {"": NotRun("no time") if area is None else run_with((20106, area))}
            for name, area in zip(names, areas)
        }
        return attribution.rows_of(runs, 0.5)

    def test_changes_add_up_over_a_missing_rung(self):
        areas = [22000, None, 23000, 23050, 23100, 23050, 24000, 24100, 24200, 24250, 24800, 24836]
        rows = self.rows(areas)
        self.assertEqual(rows[2]["change_nm2"], 1000, "the missing rung's change is in the next one's")
        self.assertIn("no time", rows[1]["state"])
        self.assertAlmostEqual(sum(row["change_nm2"] or 0 for row in rows), 2836)
        self.assertIn("+2836.0", attribution.closure(rows)[0])
        self.assertTrue(attribution.draw(rows).axes)

    def test_it_says_when_it_does_not_close(self):
        self.assertIn("does not close", attribution.closure(self.rows([None] + 11 * [24000]))[0])

    def test_every_rung_changes_the_case_and_the_last_one_is_the_default_scheme(self):
        runs = {one.name: one for one in attribution.wanted(False)}
        self.assertEqual(runs["printed"].settings, {})
        sizes = [len(runs[rung.name].settings) for rung in attribution.RUNGS]
        self.assertEqual(sizes, sorted(set(sizes)), "each has all of those before it")
        own = flattened({"phase_field": {"paper": {"step_rule": "guarded"}}})
        self.assertLessEqual(own.items(), runs[attribution.RUNGS[-1].name].settings.items())


class Mobility(unittest.TestCase):
    def test_the_column_about_a_mobility(self):
        # Area 1000 (1 + 0.01 log2(γ/γ0)): doubling γ adds one per cent of 1000 nm².
        column = mobility.column_of(lambda x: 1000 * (1 + 0.01 * x / np.log10(2)), 6.4)
        base = 1 + 0.01 * np.log2(1.6)
        np.testing.assert_allclose(column, [100 * 0.01 * k / base for k in (3, 2, 1)], rtol=1e-12)


class TimeScale(unittest.TestCase):
    def test_the_time_of_an_area(self):
        run = run_with((20000, 22000, 24000), (0.0, 0.1, 0.5))
        self.assertAlmostEqual(timescale.time_of_area(run, 23000), 0.3)
        self.assertEqual(timescale.time_of_area(run, 20000), 0.0)
        self.assertIsNone(timescale.time_of_area(run, 25000))


if __name__ == "__main__":
    unittest.main()
