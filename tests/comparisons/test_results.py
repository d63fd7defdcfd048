"""Numbers of results come from docs/results/data alone: pages and figures say what the tables say, and these are of today's numerics.

    python3 tests/comparisons/test_results.py
"""

import math
import re
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import locations

sys.path.insert(0, str(locations.ROOT / "tools"))

from results import command, figures, ink, measures, other_studies, pages, places, studies, study, tables, writing  # noqa: E402

REFRESH = "run `make results` (or `python3 tools/results build --pages` when no run is to be made anew)"


class Stored(unittest.TestCase):
    """What lies in docs/results/data, in the pages and in the pictures."""

    def test_tables_are_of_today_s_numerics(self):
        """Numbers taken from the pages of an older commit say so; they are no table of `make results`."""
        stale = []
        for path in sorted(places.DATA.glob("*.csv")):
            stored = tables.read(path.stem)
            if not stored.recorded and stored.revision != places.numerics_revision():
                stale.append(f"{path.name}: of numerics revision {stored.revision}, the program's is {places.numerics_revision()}")
        self.assertEqual(stale, [], "run `make results`")

    def test_every_table_belongs_to_a_study(self):
        self.assertEqual(sorted({path.stem for path in places.DATA.glob("*.csv")} - set(studies.COLUMNS)), [])

    def test_tables_have_the_columns_that_pages_show(self):
        for name, columns in studies.COLUMNS.items():
            stored = tables.read(name)
            if stored:
                with self.subTest(name):
                    self.assertEqual([column.name for column in columns if column.name not in stored.rows[0]], [])

    def test_pages_say_what_the_tables_say(self):
        stale = []
        for page in places.all_pages():
            text = page.read_text("utf-8")
            now = pages.filled(text, studies.COLUMNS)
            for before, after in zip(text.splitlines(), now.splitlines()):
                stale += [f"{page.name}: {before[:150]}"] if before != after else []
            stale += [f"{page.name}: a table's rows"] if len(text.splitlines()) != len(now.splitlines()) else []
        self.assertEqual(stale, [], REFRESH)

    def test_no_number_is_typed_by_hand(self):
        """A number of four digits that stands between markers stands nowhere without them."""
        found = [f"{page.name}: {number}" for page, number in pages.typed_by_hand()]
        self.assertEqual(found, [], "put it between <!-- value TABLE/ROW/COLUMN --> and <!-- end -->, or refer to the page that has it")

    def test_markers_are_whole(self):
        """One for each end; none at the start of a line, where Markdown takes the whole line for HTML."""
        wrong = []
        for page in places.all_pages():
            text = re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.S | re.M)
            text = re.sub(r"`[^`]*`", "", text)
            pairs = len(pages.VALUE.findall(text)) + len(pages.ORIGIN.findall(text))
            wrong += [page.name] if pairs != text.count("<!-- end -->") else []
            wrong += [page.name] if len(pages.TABLE.findall(text)) != text.count("<!-- end of table -->") else []
            wrong += [page.name] if re.search(r"^\s*([*-] |\d+\. )?<!-- (value|origin)", text, re.M) else []
        self.assertEqual(wrong, [])

    def test_pictures_show_the_tables(self):
        stale = []
        for name, (_, _, shown) in figures.FIGURES.items():
            picture = places.IMAGES / f"{name}.svg"
            if all(tables.read(table) for table in shown):
                if not picture.exists() or ink.drawn_from(shown) not in picture.read_text("utf-8"):
                    stale.append(picture.name)
        self.assertEqual(stale, [], REFRESH)

    def test_pictures_can_be_drawn(self):
        """All of them, with rules for a dark screen."""
        with tempfile.TemporaryDirectory() as scratch, mock.patch.object(ink, "IMAGES", Path(scratch)):
            figures.draw_all()
            drawn = sorted(Path(scratch).glob("*.svg"))
            for picture in drawn:
                self.assertIn("prefers-color-scheme: dark", picture.read_text("utf-8"), picture.name)
        self.assertGreater(len(drawn), 10)


class Writing(unittest.TestCase):
    def test_numbers(self):
        for value, form, wanted in (
            (0.00395, "+.2%", "+0.40 %"),
            (-0.0142, ".2%", "−1.42 %"),
            (-0.0142, "|.2%", "1.42 %"),
            (24836.36, ",.0f", "24 836"),
            (1.48e-4, ".1e", "1.5·10⁻⁴"),
            (1e-6, ".0e", "10⁻⁶"),
            (2e8, ".0e", "2·10⁸"),
            (None, ".1f", "–"),
            ("mushroom", "", "mushroom"),
        ):
            with self.subTest(value=value, form=form):
                self.assertEqual(writing.written(value, form), wanted)


class Tables(unittest.TestCase):
    """A table of a scratch directory, and a page that shows it."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        patch = mock.patch.object(tables, "DATA", Path(scratch.name))
        patch.start()
        self.addCleanup(patch.stop)
        about = {tables.STUDY: "one", tables.REVISION: 3, tables.COMMIT: "abc"}
        tables.write("one", about, ["endoflow run x"], [{"run": "long name", "budding_us": 0.8259188163}, {"run": "b", "budding_us": None}])

    def test_written_and_read(self):
        stored = tables.read("one")
        self.assertEqual((stored.revision, stored.commands, stored.recorded), (3, ["endoflow run x"], None))
        self.assertEqual(stored.row("long_name")["budding_us"], 0.8259188163)
        self.assertIsNone(stored.row("b")["budding_us"])

    def test_pages_are_filled(self):
        text = "at <!-- value one/long_name/budding_us .3f -->1<!-- end --> µs. <!-- origin one --><!-- end -->\n\n<!-- table one -->\n\n<!-- end of table -->\n"
        columns = {"one": (tables.Column("run", "run"), tables.Column("budding_us", "budding", ".4f"))}
        found = pages.filled(text, columns)
        self.assertIn("-->0.826<!-- end --> µs. <!-- origin one -->Numerics revision 3, commit abc.<!-- end -->", found)
        self.assertIn("| run | budding |\n| --- | --- |\n| long name | 0.8259 |\n| b | – |\n\n<!-- end of table -->", found)
        self.assertEqual(pages.filled(found, columns), found)
        with self.assertRaisesRegex(pages.UnknownValue, "one/c/budding_us"):
            pages.filled("<!-- value one/c/budding_us -->1<!-- end -->", columns)

    def test_studies_that_have_to_run(self):
        one = study.Study("one", 1, {"a": "endoflow run x"}, (study.Table("one", (), None),))
        with mock.patch.object(command, "numerics_revision", return_value=3):
            self.assertEqual(command.state(one), "")
            other = study.Study("one", 1, {"a": "endoflow run y"}, one.tables)
            self.assertEqual(command.state(other), "made by other commands")
        with mock.patch.object(command, "numerics_revision", return_value=4):
            self.assertEqual(command.state(one), "numerics revision 3, today's is 4")


class Runs(unittest.TestCase):
    """Runs are made once, and again when their command or the numerics changed."""

    def test_resuming(self):
        with tempfile.TemporaryDirectory() as scratch, mock.patch.object(command, "RUNS", Path(scratch)):
            program = Path(scratch) / "endoflow"
            program.write_text(
                '#!/bin/sh\necho "$@" >> "$(dirname "$0")/calls"\nwhile [ "$1" != -o ]; do shift; done\n'
                'echo "{\\"provenance\\": {\\"git\\": \\"abc\\"}}" > "$2/run.json"\n[ ! -e "$(dirname "$0")/fails" ]\n'
            )
            program.chmod(0o755)
            one = study.Study("one", 1, {"a": "endoflow run x"}, ())
            (Path(scratch) / "fails").touch()
            with self.assertRaisesRegex(command.Failed, "exit code 1"):
                command.make_run(one, "a", Path(scratch))
            (Path(scratch) / "fails").unlink()
            for _ in range(2):
                command.make_run(one, "a", Path(scratch))
            command.make_run(study.Study("one", 1, {"a": "endoflow run y"}, ()), "a", Path(scratch))
            calls = (Path(scratch) / "calls").read_text().splitlines()
        self.assertEqual([line.split(" -o")[0] for line in calls], ["run x", "run x", "run y"])
        self.assertEqual([line.endswith("--restart") for line in calls], [False, True, False])


class Measures(unittest.TestCase):
    """Rows from runs whose differences are known."""

    def test_pair(self):
        import synthetic

        import endoflow

        with tempfile.TemporaryDirectory() as scratch:
            sharp, diffuse = map(endoflow.load, synthetic.write_pair(Path(scratch), count=9))
        rows = measures.differences(sharp, diffuse, (0.2, 99))
        self.assertEqual(list(rows[0]), ["time_us", "area", "volume", "energy", "height", "neck_nm", "neck_sharp_nm", "neck"])
        for name, value in measures.COMPARED.items():
            self.assertAlmostEqual(rows[0][name], value(diffuse, 0.2) / value(sharp, 0.2) - 1)
            self.assertEqual(writing.written(rows[1][name], ".2%"), "–")
        off = measures.largest_differences(sharp, diffuse)
        self.assertGreaterEqual(off["area"], abs(diffuse.history_at("membrane_area_nm2", 0.2) / sharp.history_at("membrane_area_nm2", 0.2) - 1) - 1e-3)

    def test_slower(self):
        """A membrane whose area grows a quarter as fast as the sharp one's."""

        def area(time):
            return 20000 + 4000 * time**0.5

        sharp = [{"time_us": 0.01 * i, "area_nm2": area(0.01 * i), "volume_nm3": i} for i in range(1, 61)]
        rest = {"volume_extracellular_nm3": -5, "area_strain_max": 0.1, "net_vertical_force_pN": 7}
        printed = [{"time_us": 0.02 * i, "membrane_area_nm2": area(0.005 * i)} | rest for i in range(30)]
        rows = other_studies.slower(printed, sharp)
        self.assertEqual([row["time_us"] for row in rows], ["0.1", "0.2", "0.3", "0.4", "0.5"])
        for row in rows:
            self.assertAlmostEqual(row["slower"], 4, delta=0.01)
            self.assertAlmostEqual(row["area_sharp_nm2"], area(float(row["time_us"])), delta=1e-6)
            self.assertEqual((round(row["volume_nm3"]), round(row["force_pN"])), (-5, 7))

    def test_extremes_of_radii(self):
        """The least of a parabola's exponential lies between the coats; diameters on a line."""
        rows = [
            {"radius_nm": r, "budding_us": math.exp((r - 37.5) ** 2 / 50), "neck_1_nm": None if r < 24 else math.exp((r - 41) ** 2 / 90), "diameter_nm": 2 * r - 5}
            for r in (20, 24, 28, 32, 36, 40, 44, 48)
        ]
        (found,) = measures.extremes_of_radii(rows)
        wanted = {"fastest_nm": 37.5, "narrowest_nm": 41, "slope": 2, "first_nm": -5, "r_squared": 1}
        for name, value in wanted.items():
            self.assertAlmostEqual(found[name], value, places=9, msg=name)

    def test_limits(self):
        rows = [{"epsilon_nm": e, "late": 0.001 + 0.02 * e**2} for e in (1.2, 0.85, 0.6, 0.42)]
        for fit in measures.limits(rows):
            self.assertAlmostEqual(fit["limit"], 0.001, places=9)
            self.assertAlmostEqual(fit["order"], 2, places=6)


if __name__ == "__main__":
    unittest.main()
