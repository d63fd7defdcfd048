"""Values of `--vary`."""

import unittest

import locations  # noqa: F401

from comparisons.studies.ranges import RangeError, combinations, parsed_values, parsed_variation


class Ranges(unittest.TestCase):
    def values(self, text):
        return parsed_values(text, "--vary k")

    def test_stop_is_included(self):
        self.assertEqual(self.values("20:60:20"), ["20", "40", "60"])
        self.assertEqual(self.values("20:59:20"), ["20", "40"])
        self.assertEqual(self.values("0.1:0.3:0.1"), ["0.1", "0.2", "0.3"])
        self.assertEqual(self.values("1e-3:3e-3:1e-3"), ["0.001", "0.002", "0.003"])
        self.assertEqual(self.values("2:1:-0.5"), ["2", "1.5", "1"])
        self.assertEqual(self.values("5:5:1"), ["5"])

    def test_lists(self):
        self.assertEqual(self.values("64e3, 1.50,2"), ["64000", "1.5", "2"])
        self.assertEqual(self.values("fickian,advection"), ["fickian", "advection"])

    def test_refused(self):
        for text in ("1:2", "1:2:0", "1:2:-1", "2:1:1", "a:b:c", "0:1:1e-9", "1,,2", "", "1,1.0", "0:1:1e-999999", "nan:1:1", "1:inf:1"):
            with self.subTest(text), self.assertRaises(RangeError):
                self.values(text)

    def test_keys(self):
        self.assertEqual(parsed_variation("a.b=1,2"), ("a.b", ["1", "2"]))
        for text in ("a.b", "ab=1", ".b=1", "a.=1", "a.b.c=1"):
            with self.subTest(text), self.assertRaises(RangeError):
                parsed_variation(text)

    def test_combinations(self):
        found = combinations([("a.x", ["1", "2"]), ("a.y", ["p", "q"])])
        self.assertEqual([tuple(entry.values()) for entry in found], [("1", "p"), ("1", "q"), ("2", "p"), ("2", "q")])
        with self.assertRaisesRegex(RangeError, "100000000 combinations"):
            combinations([(f"a.{key}", ["1"] * 100) for key in "wxyz"])
        with self.assertRaisesRegex(RangeError, "a.x: a parameter can be varied once"):
            combinations([("a.x", ["1"]), ("a.x", ["2"])])


if __name__ == "__main__":
    unittest.main()
