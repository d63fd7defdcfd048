"""Items of other papers in `endoflow reproduce`: what is read off branches of stationary shapes, and the branches themselves."""

import math
import unittest
from unittest import mock

import locations  # noqa: F401
import numpy as np
from comparisons.commands import reproduce
from comparisons.errors import StudyError
from comparisons.paper import OTHERS, branches, derenyi2002, hassinger2017


class ReadOff(unittest.TestCase):
    """Numbers on the page, from branches that are known."""

    def test_names_are_those_of_the_command(self):
        self.assertEqual(tuple(OTHERS), reproduce.OTHER_NAMES)
        for module in OTHERS.values():
            self.assertEqual(module.wanted(False), [])
            self.assertTrue(module.TITLE and module.SOURCE)

    def test_folds_in_coat_area(self):
        columns = {
            "patch_radius_nm": np.array([30.0, 80.0, 70.0, 90.0]),
            "bud_height_nm": np.array([10.0, 50.0, 80.0, 100.0]),
            "neck_radius_nm": np.array([np.nan, np.nan, 20.0, 10.0]),
        }
        with mock.patch.object(hassinger2017, "followed", return_value=branches.Branch(columns, [80.0, 70.0], "here")):
            result = hassinger2017.result({}, False)
        self.assertIn("folds at 20106.2, 15393.8 nm²", result.printed[0].ours[""])  # π 80², π 70²
        self.assertEqual(len(result.rows), 4 * len(hassinger2017.TENSIONS))
        self.assertEqual(result.rows[0]["neck_radius_nm"], "")

    def test_plateau_and_radius_of_a_tube(self):
        length = np.array([0.0, 100.0, 200.0])
        columns = {
            "pole_force_pN": derenyi2002.plateau_force() * np.array([0.0, 1.2, 1.0]),
            "bud_height_nm": length,
            "membrane_area_nm2": 2 * math.pi * 22.0 * length,
        }
        with mock.patch.object(derenyi2002, "followed", return_value=branches.Branch(columns, [], "here")):
            ours = [one.ours[""] for one in derenyi2002.result({}, False).printed]
        self.assertEqual(ours[:3], ["28.0992589 pN", "22 nm", "20.0 % above"])


class Followed(unittest.TestCase):
    """The program's own branches."""

    def test_a_short_branch(self):
        branch = branches.followed("tube", "membrane.pole_force", 10, {"domain.height": "700"})
        self.assertAlmostEqual(branch.columns["pole_force_pN"][-1], 10, places=6)
        self.assertEqual(branch.folds, [])
        self.assertIn("target", branch.ended)

    def test_what_is_refused(self):
        with self.assertRaises(StudyError):
            branches.followed("tube", "membrane.pole_forse", 10, {})


if __name__ == "__main__":
    unittest.main()
