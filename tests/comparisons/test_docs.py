"""The documentation: links lead somewhere, every command parses and its options exist, pages build with formulas.

    ENDOFLOW_PROGRAM=build/endoflow python3 tests/comparisons/test_docs.py

`make docs-check` runs the commands.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import locations
from scratch import scratch_directory

TOOLS = locations.ROOT / "tools" / "docs"
sys.path.insert(0, str(TOOLS))

import build  # noqa: E402
import check  # noqa: E402
import prose  # noqa: E402
from pages import FENCE, Block, blocks, pages  # noqa: E402

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
PROGRAM = os.environ.get("ENDOFLOW_PROGRAM")


class Pages(unittest.TestCase):
    def test_links_lead_somewhere(self):
        broken = []
        for page in (locations.ROOT / "README.md", *pages()):
            for target in LINK.findall(page.read_text(encoding="utf-8")):
                if not re.match(r"\w+:|#", target) and not (page.parent / target.split("#")[0]).exists():
                    broken.append(f"{page.name}: {target}")
        self.assertEqual(broken, [])

    def test_links_within_pages_lead_somewhere(self):
        """The part behind # is a heading of the page that it is in, as pandoc and GitHub name it."""

        def headings(page):
            heads = re.findall(r"^#+ (.*)$", FENCE.sub("", page.read_text(encoding="utf-8")), re.M)
            return {re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in heads}

        broken = []
        for page in (locations.ROOT / "README.md", *pages()):
            for target in LINK.findall(page.read_text(encoding="utf-8")):
                name, _, heading = target.partition("#")
                other = page.parent / name if name else page
                if heading and ":" not in target and other.suffix == ".md" and heading not in headings(other):
                    broken.append(f"{page.name}: {target}")
        self.assertEqual(broken, [])

    def test_tables_are_whole(self):
        """A row behind an empty line starts a table, so a line of dashes follows."""
        broken = []
        for page in (locations.ROOT / "README.md", *pages()):
            lines = page.read_text(encoding="utf-8").splitlines()
            for number, (before, line, after) in enumerate(zip(lines, lines[1:], [*lines[2:], ""]), start=2):
                if line.startswith("|") and not before.strip() and not re.match(r"\|[\s:|-]+\|$", after):
                    broken.append(f"{page.name}:{number}: {line[:40]}")
        self.assertEqual(broken, [])

    def test_named_source_files_exist(self):
        """In the pages that say which files to touch."""
        missing = []
        for name in ("architecture", "extending", "developer-guide", "case-files"):
            text = (locations.ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
            for path in re.findall(r"`((?:\w+/)+[\w*.-]*)`", text):
                if not any(locations.ROOT.glob(path.rstrip("/"))) and not path.startswith(("build/", "out/")):
                    missing.append(f"{name}.md: {path}")
        self.assertEqual(missing, [])

    def test_named_files_exist(self):
        """A source file or a test that any page names without its folder is somewhere in the project."""
        folders = ("boundary_integral", "phasefield", "shared", "statics", "cli", "comparisons", "python", "tests", "tools", "bench")
        known = {path.name for folder in folders for path in (locations.ROOT / folder).rglob("*.*")}
        missing = []
        for page in (locations.ROOT / "README.md", *pages()):
            text = page.read_text(encoding="utf-8")
            missing += [f"{page.name}: {name}" for name in re.findall(r"`(\w+\.(?:h|cpp|py))`", text) if name not in known]
            tests = re.findall(r"`(\w+_test)`", text)
            missing += [f"{page.name}: {name}" for name in tests if not known & {f"{name}.cpp", f"{name}.py"}]
        self.assertEqual(missing, [])

    def test_every_page_is_listed(self):
        index = (locations.ROOT / "docs" / "index.md").read_text(encoding="utf-8")
        linked = {target.split("#")[0] for target in LINK.findall(index)}
        names = {str(page.relative_to(locations.ROOT / "docs")) for page in pages()}
        self.assertEqual(sorted(names - linked - {"index.md"}), [])

    def test_every_case_is_listed(self):
        text = (locations.ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
        cases = sorted(path.stem for path in (locations.ROOT / "cases").iterdir() if path.is_file())
        self.assertEqual([name for name in cases if f"`{name}`" not in text], [])

    @unittest.skipUnless(PROGRAM and Path(PROGRAM).exists(), "ENDOFLOW_PROGRAM names no program")
    def test_named_keys_exist(self):
        """A parameter that a page names is one; what is planned stands on a page of its own."""
        text = subprocess.run([PROGRAM, "params", "--toml"], check=True, capture_output=True, text=True).stdout
        known, section = set(), ""
        for line in text.splitlines():
            if head := re.match(r"\[([\w.]+)\]", line):
                section = head[1]
            elif key := re.match(r"#? ?(\w+) = ", line):
                known.add(f"{section}.{key[1]}")
        sections = "|".join(sorted({name.rsplit(".", 1)[0] for name in known}, key=len, reverse=True))
        missing = []
        for page in (locations.ROOT / "README.md", *pages()):
            if page.name != "roadmap.md":
                for name in re.findall(rf"`((?:{sections})\.[a-z_.]+)\b", page.read_text(encoding="utf-8")):
                    missing += [f"{page.name}: {name}"] if name not in known else []
        self.assertGreater(len(known), 60)
        self.assertEqual(missing, [])

    @unittest.skipUnless(PROGRAM and Path(PROGRAM).exists(), "ENDOFLOW_PROGRAM names no program")
    def test_every_command_parses(self):
        process = subprocess.run(
            [sys.executable, str(TOOLS / "check.py"), str(Path(PROGRAM).parent), "--parse"],
            capture_output=True,
            text=True,
        )
        self.assertEqual((process.returncode, process.stderr.strip()), (0, ""))
        self.assertRegex(process.stdout, r"0 blocks run, \d\d+ parsed, 0 failed")

    @unittest.skipUnless(PROGRAM and Path(PROGRAM).exists(), "ENDOFLOW_PROGRAM names no program")
    @unittest.skipUnless(shutil.which("pandoc"), "pandoc is not installed (Debian package pandoc)")
    def test_html(self):
        with tempfile.TemporaryDirectory() as scratch:
            output = Path(scratch) / "html"
            subprocess.run(
                [sys.executable, str(TOOLS / "build.py"), PROGRAM, str(output)], check=True, capture_output=True
            )
            model, parameters = (
                (output / f"{name}.html").read_text(encoding="utf-8") for name in ("model", "parameters/molecules")
            )
            self.assertIn("<math", model)
            self.assertIn("∇<sub>Γ</sub>·u", model)
            self.assertIn("<code>patch_radius</code>", parameters)
            self.assertIn("<td>&gt; 0 and ≤\N{NO-BREAK SPACE}10<sup>5</sup></td>", parameters)
            self.assertNotIn("<col ", parameters)  # widths that would squeeze the keys
            self.assertIn('href="parameters/molecules.html"', (output / "parameters.html").read_text(encoding="utf-8"))
            index = (output / build.INDEX_FILE).read_text(encoding="utf-8")
            entries = json.loads(index.removeprefix("const pages = ").removesuffix(";\n"))
            self.assertGreater(len([entry for entry in entries if "bending_stiffness_coated" in entry[-1]]), 1)
            for name, heading, *_ in entries:
                self.assertIn(f'id="{heading}"', (output / f"{name}.html").read_text(encoding="utf-8"))
            for page in output.rglob("*.html"):
                text = page.read_text(encoding="utf-8")
                # A formula's line that begins like a list, with + or -, ends the formula.
                self.assertNotIn("$$", re.sub(r"<code[^>]*>.*?</code>", "", text, flags=re.S), page.name)
                self.assertNotRegex(text, r'(src|href)="https?://(?!orcid|doi)[^"]*\.(js|css|png)"', page.name)
                for target, heading in re.findall(r'(?:src|href)="([^":#]*)#?([^":]*)"', text):
                    if target and not target.startswith("../.."):
                        self.assertTrue((page.parent / target).exists(), f"{page.name}: {target}")
                    other = page.parent / target if target else page
                    if heading and other.suffix == ".html" and other.exists():
                        self.assertIn(f'id="{heading}"', other.read_text(encoding="utf-8"), f"{page.name}: {target}#{heading}")


class Prose(unittest.TestCase):
    """The pages are short, and so are their sentences."""

    def test_pages(self):
        ours, users = prose.counted()
        self.assertLessEqual(sum(map(prose.count, ours)), prose.MOST_OF_ALL)
        long = [f"{page.name}: {one}" for page in users for one in prose.long_sentences(page)]
        self.assertEqual(long, [])

    def test_sentences(self):
        with tempfile.TemporaryDirectory() as scratch:
            page = Path(scratch) / "page.md"
            text = "# Words\n\nThree [more words](x.md#y). As (J. Doe, Phys. Rev. 1) has it:\n\n$$ a\n= b $$\n\nand `so on`.\n\n| a | b |\n| --- | --- |\n\n"
            page.write_text(text + "```sh\nmake docs\n```\n\n" + "long " * 41 + ".\n", encoding="utf-8")
            self.assertEqual(prose.count(page), 1 + 3 + 7 + 1 + 2 + 2 + 41)
            self.assertEqual(len(prose.long_sentences(page)), 1)
            done = subprocess.run([TOOLS.parent / "prose", page], capture_output=True, text=True)
        found = prose.sentences("As (J. Doe, Phys. Rev. 1) has it: V is one. It was (D. Roe et al. 2016) two.")
        self.assertEqual(found, ["As (J. Doe, Phys. Rev. 1) has it: V is one.", "It was (D. Roe et al. 2016) two."])
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Laboratory(unittest.TestCase):
    """The page about the laboratory in the browser holds the laboratory itself, above its first section."""

    def test_frame(self):
        text = build.with_laboratory((locations.ROOT / "docs" / "web.md").read_text(encoding="utf-8"))
        head, section = text.split("\n## ", 1)
        self.assertIn(f'src="{build.LABORATORY_FILE}"', head)
        self.assertTrue(section.startswith("How to use it"))


@unittest.skipUnless(shutil.which("pandoc"), "pandoc is not installed (Debian package pandoc)")
class Typography(unittest.TestCase):
    """Plain-text notation, and names that only look like it."""

    def test_scripts(self):
        for text, wanted in (
            ("r_c²; P_θθ ∂_zψ", "r<sub>c</sub>²; P<sub>θθ</sub> ∂<sub>z</sub>ψ"),
            ("W'(c)/ε_c, b_c/(b_c", "W'(c)/ε<sub>c</sub>, b<sub>c</sub>/(b<sub>c</sub>"),
            ("u^{n+1}·∇φ d^(−1/2) s^-1", "u<sup>n+1</sup>·∇φ d<sup>−1/2</sup> s<sup>−1</sup>"),
            ("cell_size neck_radius_nm 2^ _x a_b_c", "cell_size neck_radius_nm 2^ _x a_b_c"),
            ("`r_c`", "<code>r_c</code>"),
        ):
            with self.subTest(text):
                command = ["pandoc", "--from=gfm", "--to=html5", f"--lua-filter={TOOLS / 'typography.lua'}"]
                found = subprocess.run(command, input=text, text=True, check=True, capture_output=True).stdout
                self.assertEqual(found.strip(), f"<p>{wanted}</p>")


class Checker(unittest.TestCase):
    """The checker finds what it is for."""

    def page(self, text):
        path = scratch_directory(self) / "page.md"
        path.write_text(text)
        return path

    def test_blocks_and_marks(self):
        page = self.page(
            "<!-- fails with 2: why -->\n```sh\nfalse\n```\n\n    build/endoflow check x \\\n        --json\n"
        )
        found = [(block.kind, block.mark, block.text) for block in blocks(page)]
        indented = "build/endoflow check x \\\n        --json\n"
        self.assertEqual(found, [("sh", "fails with 2: why", "false\n"), ("sh", "parse only: indented", indented)])

    def test_exit_codes(self):
        here = locations.ROOT / "README.md"
        with tempfile.TemporaryDirectory() as scratch:
            tools = Path(scratch) / check.TOOLS
            tools.mkdir()
            (tools / "python3").symlink_to(sys.executable)
            for kind, mark, text, problem in (
                ("sh", "", "python3 -m venv --without-pip own; own/bin/python3 -V", ""),
                ("sh", "", "exit 3", "exit code 3 instead of 0"),
                ("sh", "fails with 3: reason", "exit 3", ""),
                ("sh", "", "false | true", "exit code 1"),
                ("python", "", "import endoflow_of_nobody", "No module named"),
            ):
                with self.subTest(text):
                    found = check.run(Block(here, kind, mark, text), scratch, Path(scratch))
                    self.assertIn(problem, found) if problem else self.assertEqual(found, "")

    @unittest.skipUnless(PROGRAM and Path(PROGRAM).exists(), "ENDOFLOW_PROGRAM names no program")
    def test_unknown_commands_and_options(self):
        here, build = locations.ROOT / "README.md", Path(PROGRAM).parent
        for text, problem in (
            ("build/endoflow check a.toml --jsn", "has no --jsn"),
            ("build/endoflow chek a.toml", "did you mean 'check'"),
            ("if true; then", "syntax error"),
            ("mpirun -n 2 build/endoflow sweep a --vary b=1 --engine both", ""),
        ):
            with self.subTest(text):
                found = check.parse(Block(here, "sh", "", text), build)
                self.assertIn(problem, found) if problem else self.assertEqual(found, "")
        self.assertEqual(check.check_case(Block(here, "toml", "", "[time]\nend = 2\n"), build), "")
        self.assertIn("did you mean", check.check_case(Block(here, "toml", "", "[time]\nendd = 2\n"), build))


if __name__ == "__main__":
    unittest.main()
