"""What people give to `endoflow infer`: tables and studies that are read alike however they are written, or refused in one line."""

import re
import subprocess
import sys
import unittest
from pathlib import Path

import locations
import numpy as np
import stand_in
import synthetic
from scratch import scratch_directory

from comparisons.errors import BAD_INPUT, IO_FAILURE, StudyError
from comparisons.inference.study_file import read_study
from comparisons.inference.study_keys import documentation

HERE = Path(__file__).resolve().parent

HEAD = "[study]\nhorizon = 0.1\n"
UNKNOWN = '[[unknown]]\nkey = "membrane.bending_stiffness_coated"\nprior = "log-uniform"\nlow = 900\nhigh = 1600\n'
DATA = '[[data]]\nevent = "budding"\ntime_us = 0.05\nerror_us = 0.01\n'

#: A number of more digits than a float has room for.
HUGE = "1" + 400 * "0"


def wrong(name):
    """(line, parts of the message, columns (bytes), …) of a table of wrong inputs."""
    for number, line in enumerate((HERE / name).read_text(encoding="utf-8").splitlines(), start=1):
        if line and not line.startswith("#"):
            message, *columns = line.split("\t")
            yield number, message.split(" | "), [unescaped(column) for column in columns]


def unescaped(text):
    """Bytes of a column."""
    plain = {"n": b"\n", "r": b"\r", "t": b"\t", "\\": b"\\"}
    parts = re.split(r"\\(x[0-9a-f]{2}|.)", text)
    codes = [plain[code] if code in plain else bytes.fromhex(code[1:]) for code in parts[1::2]]
    return b"".join(part.encode() + code for part, code in zip(parts[::2], [*codes, b""]))


class Inputs(unittest.TestCase):
    """Gives each test self.scratch (Path)."""

    def setUp(self):
        self.scratch = scratch_directory(self)

    def problem(self, data, head=HEAD):
        return stand_in.problem_of(self.scratch, head + UNKNOWN + data)

    def assert_refused(self, parts, code, read):
        """read() raises a StudyError of one line with these parts and this exit code."""
        with self.assertRaises(StudyError) as caught:
            read()
        message = str(caught.exception)
        for part in parts:
            self.assertIn(part.replace("\\\\", "\\"), message)
        self.assertEqual(message.count("\n"), 0, message)
        self.assertEqual(caught.exception.exit_code, code)


class Refused(Inputs):
    def test_data(self):
        (self.scratch / "folder").mkdir()
        synthetic.write_run(self.scratch / "run", "boundary-integral", lambda t: synthetic.budding_membrane(t, 0.1), [0, 0.05, 0.1])
        for number, parts, (keys, content) in wrong("wrong_data.tsv"):
            with self.subTest(line=number, message=parts):
                (self.scratch / "d.csv").write_bytes(content)
                self.assert_refused(parts, BAD_INPUT, lambda: self.problem(f"[[data]]\n{keys.decode()}\n"))

    def test_studies(self):
        for number, parts, (text,) in wrong("wrong_studies.tsv"):
            with self.subTest(line=number, message=parts):
                text = text.decode().replace("UNKNOWN", UNKNOWN).replace("DATA", DATA).replace("HUGE", HUGE)
                self.assert_refused(parts, BAD_INPUT, lambda: stand_in.problem_of(self.scratch, text))

    def test_files_that_are_no_text(self):
        """The study itself: exit code 4, as of every file that cannot be read."""
        path = self.scratch / "study.toml"
        for content, message in (
            (b"PK\x03\x04", "is a workbook (.xlsx, .ods) or another zip archive; give the path of a study in TOML"),
            (b"# \xb5m", "study.toml:1: the byte 0xb5 is no text in UTF-8; save it in UTF-8"),
            (b"[study]\n\x00", "holds zero bytes"),
        ):
            path.write_bytes(content)
            self.assert_refused([message], IO_FAILURE, lambda: read_study(path))
        self.assert_refused(["is a directory; give the path"], IO_FAILURE, lambda: read_study(self.scratch))
        self.assert_refused(["lists in lists"], BAD_INPUT, lambda: self.problem("x = " + 5000 * "["))


class Studies(Inputs):
    def test_written_by_any_editor(self):
        """Byte-order marks and line ends change nothing."""
        text = f'{HEAD}seed = 7\n# {"µ"}\n{UNKNOWN}{DATA}'
        path = self.scratch / "study.toml"
        for content in (
            text.encode(),
            text.encode("utf-8-sig"),
            text.encode("utf-16"),
            text.replace("\n", "\r\n").encode(),
            text.replace("\n", "\r").encode(),
        ):
            path.write_bytes(content)
            study = read_study(path)
            self.assertEqual((study.seed, study.horizon, len(study.unknowns), len(study.data)), (7, 0.1, 1, 1))


class Tables(Inputs):
    """One outline and one history, written as many programs write them, give the numbers of the plain file."""

    OUTLINE = ((0.5, 21.25), (10.125, 20.5), (29.25, -1.5), (79.5, 0.25))
    HISTORY = ((0.02, 5.5, 0.25), (0.03, 7.125, 0.5), (0.1, 21.5, 0.25))

    def outline(self, content, keys=""):
        (self.scratch / "o.csv").write_bytes(content if isinstance(content, bytes) else content.encode())
        problem = self.problem(f'[[data]]\ncontour = "o.csv"\nerror_nm = 0.2\ntime_us = 0.1\n{keys}\n')
        return np.column_stack((problem.contours[0].r, problem.contours[0].z))

    def history(self, content, keys=""):
        (self.scratch / "h.csv").write_bytes(content if isinstance(content, bytes) else content.encode())
        problem = self.problem(f'[[data]]\nfile = "h.csv"\n{keys}\n')
        return np.array([(datum.time, datum.value, datum.error) for datum in problem.data])

    def text(self, heads=("r_nm", "z_nm"), separator=",", end="\n", cell=str):
        rows = [heads, *([cell(value) for value in row] for row in self.OUTLINE)]
        return end.join(separator.join(row) for row in rows) + end

    def test_outlines(self):
        plain, comma = self.text(), lambda value: str(value).replace(".", ",")
        for what, content, keys in (
            ("plain", plain, ""),
            ("byte-order mark", b"\xef\xbb\xbf" + plain.encode(), ""),
            ("Excel's Unicode text", self.text(separator="\t", end="\r\n").encode("utf-16"), 'separator = "tab"'),
            ("lines ended by CR LF", self.text(end="\r\n"), ""),
            ("lines ended by CR", self.text(end="\r"), ""),
            ("no end of the last line", plain.rstrip("\n"), ""),
            ("empty rows", plain.replace("\n", "\n\n,,\n  \n"), ""),
            ("empty cells behind", plain.replace("\n", ",,\n"), ""),
            ("comments", "# a, \"b\n  # c\n" + plain.replace("\n", "\n# c\n", 2), ""),
            ("cells in quotes", self.text(cell=lambda value: f'"{value}"'), ""),
            ("blanks around cells", self.text(cell=lambda value: f"  {value} "), ""),
            ("exponents", self.text(cell=lambda value: f"{value:+.5E}"), ""),
            ("typographic minus", plain.replace("-", "\N{MINUS SIGN}"), ""),
            ("a spreadsheet's note of its separator", "sep=;\n" + self.text(separator=";"), 'separator = ";"'),
            ("a column without a head", ",r_nm,z_nm\n" + "".join(f"7,{r},{z}\n" for r, z in self.OUTLINE), 'ignore = [""]'),
            ("semicolons", self.text(separator=";"), 'separator = ";"'),
            ("tabs", self.text(separator="\t"), 'separator = "tab"'),
            ("tabs by their letter", self.text(separator="\t"), r'separator = "\t"'),
            ("blanks", self.text(separator="   ", end=" \n"), 'separator = "space"'),
            ("decimal commas", self.text(separator=";", cell=comma), 'separator = ";"\ndecimal = ","'),
            ("decimal commas in quotes", self.text(cell=lambda value: f'"{comma(value)}"'), 'decimal = ","'),
            ("units in parentheses", self.text(("r (nm)", "z (nm)")), 'heads = { r_nm = "r (nm)", z_nm = "z (nm)" }'),
            ("no heads", plain.split("\n", 1)[1], 'heads = ["r_nm", "z_nm"]'),
            ("other columns", plain.replace("\n", ",good\n").replace("z_nm,good", "z_nm,note"), 'ignore = ["note"]'),
            ("other columns, no heads", plain.replace("\n", ",good\n").split("\n", 1)[1], 'heads = ["r_nm", "z_nm", ""]'),
            ("Latin-1", self.text(("r", "Höhe")).encode("latin-1"), 'encoding = "latin-1"\nheads = { r_nm = "r", z_nm = "Höhe" }'),
            ("ångström", self.text(cell=lambda value: str(10 * value)), 'length_unit = "Å"'),
            ("ångström by name", self.text(cell=lambda value: str(10 * value)), 'length_unit = "angstrom"'),
            (
                "ångström in heads",
                self.text(("r (\u212b)", "z (\u212b)"), cell=lambda value: str(10 * value)),
                'length_unit = "A"\nheads = { r_nm = "r (\u212b)", z_nm = "z (\u212b)" }',
            ),
            ("micrometres", self.text(cell=lambda value: repr(value / 1000)), 'length_unit = "µm"'),
            ("pixels", self.text(cell=lambda value: str(4 * value)), 'length_unit = "pixel"\npixel_nm = 0.25'),
        ):
            with self.subTest(what):
                np.testing.assert_allclose(self.outline(content, keys), self.OUTLINE, rtol=1e-15)

    def test_both_half_planes_and_the_floor(self):
        left = "".join(f"{-r},{z}\n" for r, z in reversed(self.OUTLINE))
        found = self.outline("r_nm,z_nm\n" + left + self.text().split("\n", 1)[1], 'half_planes = "both"')
        np.testing.assert_array_equal(found, [*reversed(self.OUTLINE), *self.OUTLINE])
        floor = "".join(f"{r},{z + 80}\n" for r, z in self.OUTLINE)
        np.testing.assert_array_equal(self.outline("r_nm,z_nm\n" + floor, 'z_from = "floor"'), self.OUTLINE)

    def test_outlines_of_many_points(self):
        """More than 500 points are refused with the key that thins them out, which keeps the first of every n."""
        r = np.linspace(0, 79, 1701)
        content = "r_nm,z_nm\n" + "".join(f"{x},{79 - x}\n" for x in r)
        said = "o.csv: has 1701 points, more than 500; say every = 4 in [[data]] 1"
        self.assert_refused([said], BAD_INPUT, lambda: self.outline(content))
        np.testing.assert_array_equal(self.outline(content, "every = 4")[:, 0], r[::4])

    def test_histories(self):
        heads = "time_us,bud_height_nm,bud_height_error_nm\n"
        plain = heads + "".join(f"{t},{y},{d}\n" for t, y, d in self.HISTORY)
        for what, content, keys in (
            ("plain", plain, ""),
            ("nanoseconds", heads + "".join(f"{1000 * t},{y},{d}\n" for t, y, d in self.HISTORY), 'time_unit = "ns"'),
            ("milliseconds", heads + "".join(f"{t / 1000!r},{y},{d}\n" for t, y, d in self.HISTORY), 'time_unit = "ms"'),
            ("micrometres", heads + "".join(f"{t},{y / 1000!r},{d / 1000!r}\n" for t, y, d in self.HISTORY), 'length_unit = "um"'),
            ("cells without data", plain.replace("\n", "\n0.01,,\n", 1).replace("\n", "\n0.01,nan,\n", 1) + ",,0.1\n,NA,\n", ""),
            (
                "heads exchanged",
                heads + "".join(f"{d},{y},{t}\n" for t, y, d in self.HISTORY),
                'heads = { time_us = "bud_height_error_nm", bud_height_error_nm = "time_us" }',
            ),
        ):
            with self.subTest(what):
                np.testing.assert_allclose(self.history(content, keys), self.HISTORY, rtol=1e-15)

    def test_areas_and_volumes_have_powers_of_the_length(self):
        (self.scratch / "h.csv").write_text("time_us,membrane_area_nm2,volume_extracellular_nm3\n0.1,2,3\n")
        problem = self.problem('[[data]]\nfile = "h.csv"\nerror = 7\nlength_unit = "Å"\n')
        np.testing.assert_allclose([(d.value, d.error) for d in problem.data], [(0.02, 7), (0.003, 7)], rtol=1e-15)

    def test_repeated_measurements(self):
        """Rows with one time are measurements of their own, thousands of rows are read, and their order does not matter."""
        rows = [(0.1 * (i % 100) / 100, 5 + i % 7, 0.5) for i in range(5000)]
        found = self.history("time_us,bud_height_nm,bud_height_error_nm\n" + "".join(f"{t!r},{y},{d}\n" for t, y, d in rows))
        np.testing.assert_array_equal(found, rows)

    def test_times_of_another_clock(self):
        """A shift of time and a slowing down widen what the data's clock may show, by what their priors allow."""
        (self.scratch / "h.csv").write_text("time_us,bud_height_nm\n-0.4,5\n0.85,6\n")
        offset = '[[unknown]]\ntime_offset = true\nprior = "uniform"\nlow = -0.5\nhigh = 0.25\n'
        slowness = (
            '[[unknown]]\nname = "slowness"\nprior = "log-uniform"\nlow = 0.5\nhigh = 6\ndivides = ["molecules.mobility"]\n'
            'scales = ["fluid.viscosity_extracellular", "fluid.viscosity_intracellular"]\n'
        )
        data = '[[data]]\nfile = "h.csv"\nerror = 1\n'
        self.assertEqual([datum.time for datum in self.problem(offset + slowness + data).data], [-0.4, 0.85])
        late = "h.csv:3: time_us = 0.85 µs is after the end of the runs, 0.35 µs"
        self.assert_refused([late], BAD_INPUT, lambda: self.problem(offset + data))
        early = "h.csv:2: time_us = -0.4 µs is before the start of the runs, 0 µs"
        self.assert_refused([early], BAD_INPUT, lambda: self.problem(slowness + data))

    def test_the_cases_end_is_the_horizon(self):
        (self.scratch / "h.csv").write_text("time_us,bud_height_nm\n15,5\n25,6\n")
        late = "h.csv:3: time_us = 25 µs is after the end of the runs, 20 µs"
        self.assert_refused([late], BAD_INPUT, lambda: self.problem('[[data]]\nfile = "h.csv"\nerror = 1\n', ""))


class Documented(unittest.TestCase):
    def test_the_page_has_the_table_of_keys(self):
        """docs/inference.md holds what `endoflow infer --keys` prints."""
        page = (locations.ROOT / "docs" / "inference.md").read_text(encoding="utf-8")
        self.assertIn(documentation(), page)
        printed = subprocess.run([sys.executable, locations.COMPARISONS, "infer", "--keys"], capture_output=True, text=True)
        self.assertEqual((printed.returncode, printed.stderr, printed.stdout), (0, "", documentation()))


if __name__ == "__main__":
    unittest.main()
