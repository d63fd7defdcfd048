"""Items of other papers in `endoflow reproduce`: what is read off branches of stationary shapes, and the branches themselves."""

import io
import math
import unittest
from contextlib import redirect_stdout
from unittest import mock

import locations  # noqa: F401
import numpy as np
from comparisons.commands import reproduce
from comparisons.commands.options import parsed
from comparisons.errors import StudyError
from comparisons.paper import OTHER_NAMES, akamatsu2020, collar, derenyi2002, hassinger2017, item, item_module, juelicher1996
from scratch import scratch_directory


class ReadOff(unittest.TestCase):
    """Numbers on the page, from branches that are known."""

    def test_names_are_those_of_the_command(self):
        for module in map(item_module, OTHER_NAMES):
            self.assertTrue(module.TITLE and module.SOURCE)
            self.assertEqual(bool(module.wanted(False)), module.__name__.endswith("mund2023"), "others are branches")

    def test_folds_in_coat_area(self):
        columns = {
            "patch_radius_nm": np.array([30.0, 80.0, 70.0, 90.0]),
            "bud_height_nm": np.array([10.0, 50.0, 80.0, 100.0]),
            "neck_radius_nm": np.array([np.nan, np.nan, 20.0, 10.0]),
        }
        with mock.patch.object(hassinger2017, "followed", return_value=item.Branch(columns, [80.0, 70.0], "here")):
            result = hassinger2017.result({}, False)
        self.assertIn("folds at 20106.2, 15393.8 nm²", result.printed[0].ours[""])  # π 80², π 70²
        self.assertIn("20106.2", result.printed[-1].ours[""])
        self.assertEqual(len(result.rows), 4 * len(hassinger2017.TENSIONS))
        self.assertEqual(result.rows[0]["neck_radius_nm"], "")

    def test_buds_by_line_tension(self):
        """An instability that C lowers by C^(2/3), and necks whose closing is known."""
        radius = juelicher1996.domain_radius()
        self.assertAlmostEqual(radius**2 + np.sqrt(2) * juelicher1996.WIDTH / 12 * juelicher1996.RIM**2 / radius, 1e4)
        per_line_energy = juelicher1996.line_tension(1)
        neck = np.geomspace(60, 1, 200)
        part = neck / radius
        tension = 4 * (1 + 0.8 * part * np.log(part) - 0.2 * part)  # least, 3.2, at a neck of half of L
        columns = {
            "neck_radius_nm": np.concatenate([[np.nan, np.nan], neck]),
            "followed_value": np.concatenate([[2.0, 6.0], tension]) / per_line_energy,
        }
        for name in ("bud_height_nm", "bending_energy_pN_nm", "line_energy_pN_nm"):
            columns[name] = np.linspace(0, 1000, 202)
        folds = ([6.0 - 0.01, 3.0], [6.0 - 0.04, 3.0])
        found = [item.Branch(columns, [fold / per_line_energy for fold in of], "here") for of in folds]
        with mock.patch.object(juelicher1996, "followed", side_effect=found):
            result = juelicher1996.result({}, False)
        self.assertEqual(result.printed[0].ours[""], "6")
        self.assertTrue(result.printed[1].ours[""].startswith("4 ± "))
        self.assertEqual(result.rows[0]["neck_radius_nm"], "")

    def test_the_flat_disc_s_limit(self):
        """j₀₁² in a membrane without end."""
        with mock.patch.object(juelicher1996, "RIM", 1e5), mock.patch.object(juelicher1996, "WIDTH", 1e-9):
            self.assertAlmostEqual(juelicher1996.stability_limit(), 2.404825557695773**2, places=4)

    def test_plateau_and_radius_of_a_tube(self):
        length = np.array([0.0, 100.0, 200.0])
        columns = {
            "pole_force_pN": derenyi2002.plateau_force() * np.array([0.0, 1.2, 1.0]),
            "bud_height_nm": length,
            "membrane_area_nm2": 2 * math.pi * 22.0 * length,
        }
        branch = item.Branch(columns, [], "here")
        with mock.patch.object(derenyi2002, "followed", return_value=branch):
            ours = [one.ours[""] for one in derenyi2002.result({}, False).printed]
        self.assertEqual(ours[:3], ["28.0992589 pN", "22 nm", "20.0 % above"])
        output = scratch_directory(self) / "papers"
        with mock.patch.object(derenyi2002, "followed", return_value=branch), redirect_stdout(io.StringIO()):
            self.assertEqual(reproduce.run(parsed("reproduce", ["derenyi2002", "-o", str(output)])), 0)
        self.assertIn("derenyi2002/report.html", (output / "index.html").read_text(), "an index of no runs")
        self.assertFalse((output / "runs.csv").exists())

    def test_force_on_a_coat(self):
        """The largest force on the way in, and where the branch ends."""
        columns = {
            "coat_force_pN": np.array([0.0, 20.0, 15.0]),
            "coat_extension_nm": np.array([5.0, 40.0, 120.0]),
            "bud_height_nm": np.array([6.0, 45.0, 99.0]),
            "neck_radius_nm": np.array([np.nan, np.nan, 8.0]),
        }
        with mock.patch.object(akamatsu2020, "followed", return_value=item.Branch(columns, [20.0], "the neck closes")):
            result = akamatsu2020.result({}, True)
        self.assertEqual(len(result.rows), 3 * len(akamatsu2020.QUICK_TENSIONS))
        self.assertEqual(result.rows[0]["neck_radius_nm"], "")
        # 2π √(2 · 160 · 0.01) = 11.24
        words = "20 pN to 100 nm, first fold at 20 pN; the neck closes at 120 nm; a tube takes 11.24 pN"
        self.assertEqual(result.printed[0].ours[""], words)
        branch = item.Branch(columns, [], "here")
        self.assertAlmostEqual(akamatsu2020.force_to(branch, 22.5), 10)
        self.assertIsNone(akamatsu2020.force_to(branch, 130))
        self.assertEqual(akamatsu2020.force_to(branch, 5), 0)
        self.assertEqual(result.printed[1].paper, "over 100 pN")

    def test_barriers_of_the_collar(self):
        """A barrier in k_BT, a neck that closes by itself, and a case without a neck beside them."""
        columns = {
            "followed_value": np.array([15.0, 10.0, 3.0]),
            "neck_force_pN": np.array([40.0, -50.0, -100.0]),
            "neck_work_pN_nm": np.array([0.0, 42.8, 428.0]),
            "potential_pN_nm": np.array([10.0, 52.8, 438.0]),
        }
        work = {"barrier_kT": 100.0, "strongest_constriction_pN": 100.0, "barrier_from_nm": 13.0, "barrier_to_nm": 3.0}
        folded = {**columns, "followed_value": np.array([15.0, 6.0, 8.0])}  # beyond a fold necks are wider again
        closing = {**work, "barrier_kT": 0.0, "strongest_constriction_pN": -60.0}
        found = [item.Branch(columns, [], "reached the target", work), item.Branch(folded, [], "here", closing)]
        with mock.patch.object(collar, "held", side_effect=found):
            result = collar.result({}, True)
        self.assertEqual(result.printed[0].ours[""], "15 to 3 nm: 100 k_BT from 13 to 3 nm, 100 pN at most")
        self.assertIn("15 to 6 nm, here: none, the neck closes by itself and pulls with 60 pN", result.printed[1].ours[""])
        np.testing.assert_allclose([row["work_kT"] for row in result.rows[:3]], [0, 10, 100], rtol=1e-14)
        with mock.patch.object(collar, "held", side_effect=[StudyError("no-held-neck: none", 3), found[0]]):
            self.assertEqual(collar.result({}, True).printed[0].ours[""], "no-held-neck: none")


class Followed(unittest.TestCase):
    """The program's own branches."""

    def test_a_short_branch(self):
        branch = item.followed("tube", "membrane.pole_force", 10, {"domain.height": "700"})
        self.assertAlmostEqual(branch.columns["pole_force_pN"][-1], 10, places=6)
        self.assertEqual(branch.folds, [])
        self.assertIn("target", branch.ended)

    def test_a_held_neck(self):
        branch = item.held("standard", "12", "11", {"molecules.patch_radius": "22", "molecules.transport": "advection"})
        self.assertAlmostEqual(branch.columns["followed_value"][-1], 11, places=9)
        # The rise of the potential, to which the work's fourth order in the steps adds less than this.
        rise = branch.columns["potential_pN_nm"][-1] - branch.columns["potential_pN_nm"][0]
        self.assertAlmostEqual(branch.work["barrier_pN_nm"], rise, delta=1e-4)
        self.assertLess(branch.columns["neck_force_pN"][-1], -20)

    def test_what_is_refused(self):
        with self.assertRaises(StudyError):
            item.held("standard", "nonsense", "3", {})
        with self.assertRaises(StudyError):
            item.followed("tube", "membrane.pole_forse", 10, {})


if __name__ == "__main__":
    unittest.main()
