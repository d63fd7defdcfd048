"""Every command on every kind of result: a table of what works and what is refused, in one line, walked cell by cell."""

import contextlib
import fcntl
import io
import json
import os
import shutil
import socket
import subprocess
import sys
import unittest
import unittest.mock
from pathlib import Path

import locations
from scratch import scratch_directory

from comparisons import commands
from engines import COARSE, options, texts

PROGRAM = os.environ.get("ENDOFLOW_PROGRAM", "")

WORKS = (0, "")

#: What every command says of a directory that holds another thing than a run.
ELSE = {
    "sweep": (4, r"it holds a sweep; give the directory of a run, such as .*boundary-integral"),
    "map": (4, "it holds a map; give the directory of a run, such as "),
    "converge": (4, "it holds a convergence study; give the directory of a run, such as "),
    "infer": (4, "it holds an inference; give the directory of a run, such as "),
    "modes": (4, "it holds the modes of a run, give the directory of a run"),
    "comparison": (4, "it holds a comparison, give the directory of a run"),
    "page": (4, "it holds a page, give the directory of a run"),
    "empty": (4, "is this a directory of `endoflow run`"),
    "a file": (4, "no such directory"),
    "nothing": (4, "no such directory"),
}

#: Results that are runs, and what is refused of them; the rest works.
SHARP_ONLY = (4, "modes are those of a run of the boundary-integral engine")
NO_BRANCH = (2, "not continued in molecules.patch_radius or membrane.bending_stiffness")
ONE_SHAPE = (4, "holds one shape, a film needs two; `endoflow report` draws it")
BRANCH = (4, "holds a branch of .* stationary shapes, one is wanted")
NO_ROW = (4, "history.csv: holds no time step")
MOTION = {"folds": NO_BRANCH}
DIFFUSE = {**MOTION, "modes": SHARP_ONLY}
REFUSED = {
    "sharp": MOTION,
    "sharp vesicle": MOTION,
    "diffuse": DIFFUSE,
    "diffuse vesicle": DIFFUSE,
    "geometric": DIFFUSE,
    "interrupted": MOTION,
    "failed": MOTION,
    "failed at once": dict.fromkeys(("report", "compare", "movie", "revolve", "crate", "folds"), NO_ROW)
    | {"modes": (4, "holds no shape")},
    "killed": MOTION,
    "running": MOTION,
    "state": {"movie": ONE_SHAPE, "modes": SHARP_ONLY, "folds": NO_BRANCH},
    "vesicle's state": {"movie": ONE_SHAPE, "modes": SHARP_ONLY, "folds": NO_BRANCH},
    "branch": {"compare": BRANCH, "modes": SHARP_ONLY},
    "vesicle's branch": {"compare": BRANCH, "modes": SHARP_ONLY, "folds": NO_BRANCH},
}

#: What `summary` says of a run's state.
SUMMARY = {
    "killed": "killed, no longer running; continue with --restart",
    "running": "running (no exit reason yet)",
    "interrupted": "interrupted (interrupted)",
    "failed": "failed (step-underflow: the step became too small)",
    "sharp": "β(0) = 50, β(1) = 600 pN nm, C(1) = 0.14184 1/nm",
    "vesicle's branch": "membrane.spontaneous_curvature from 0 to 0.002",
}

SHARP = ("boundary_integral.elements=36", "output.field_interval=0", "output.shape_interval=0.001")
AXES = ("--vary", "molecules.patch_radius=20:24", "--vary", "membrane.bending_stiffness=100:120")
VESICLE = {
    "domain.kind": "free-space",
    "domain.spheroid_polar_axis": 30,
    "domain.spheroid_equatorial_axis": 18,
    "membrane.bending_stiffness_coated": 100,
    "membrane.spontaneous_curvature": 0,
    "molecules.patch_radius": 1000,
    "phase_field.epsilon": 4,
    "phase_field.cell_size": 5,
}


def endoflow(*words):
    """The program's own answer: (exit code, stdout, stderr)."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=600)
    return done.returncode, done.stdout, done.stderr


def command(*words):
    """A Python command in this process, which has the plots' library loaded already: (exit code, stdout, stderr)."""
    streams = [io.TextIOWrapper(io.BytesIO(), encoding="utf-8") for _ in range(2)]
    with contextlib.redirect_stdout(streams[0]), contextlib.redirect_stderr(streams[1]):
        try:
            code = commands.call([str(word) for word in words])
        except SystemExit as error:
            code = error.code
    texts_ = []
    for stream in streams:
        stream.flush()
        texts_.append(stream.buffer.getvalue().decode("utf-8", "replace"))
    return code, *texts_


class Results:
    """Makes every kind of result in a directory (Path), each as small as it can be."""

    def __init__(self, root):
        self.root = root

    def made(self, name, *words, code=0):
        """A directory that the program writes with -o."""
        found, _, errors = endoflow(*words, "-o", self.root / name)
        assert found == code, errors
        return self.root / name

    def copied(self, name, **changes):
        """The sharp run with another record."""
        path = self.root / name
        shutil.copytree(self.root / "sharp", path)
        record = json.loads((path / "run.json").read_text())
        (path / "run.json").write_text(json.dumps({**record, **changes}))
        return path

    def marked(self, name, mark, run=None):
        """What a study leaves: the file it is known by, and a run below."""
        path = self.root / name
        path.mkdir()
        (path / mark).write_text("{}")
        if run:
            shutil.copytree(self.root / "sharp", path / run)

    def make(self):
        sharp = options(SHARP)
        self.made("sharp", "run", "boundary-integral", "standard", "--until", "0.002", *sharp)
        vesicle = options(("boundary_integral.elements=16", *SHARP[1:]))
        self.made("sharp vesicle", "run", "boundary-integral", "closed_vesicle", "--until", "0.002", *vesicle)
        self.made("failed at once", "run", "boundary-integral", "standard", code=3,
                  *options(("boundary_integral.elements=20", "molecules.interface_width=0.05", "output.field_interval=0")))
        self.made("state", "statics", "statics")
        self.made("branch", "statics", "statics", *options(["molecules.patch_radius=20"]),
                  "--continue-in", "molecules.patch_radius=20.5")
        self.made("vesicle's state", "statics", "closed_vesicle")
        self.made("vesicle's branch", "statics", "closed_vesicle", "--continue-in", "membrane.spontaneous_curvature=0.002")
        if self.has("phase-field"):
            coarse = texts(COARSE["phase-field"])
            self.diffuse("diffuse", *coarse)
            self.diffuse("geometric", *coarse, "fluid.dynamics=geometric")
            self.diffuse("diffuse vesicle", *texts(VESICLE))
        lock = f"process 1 on {socket.gethostname()} since 2026-01-31T12:34:56Z"
        self.copied("interrupted", state="interrupted", exit_reason="interrupted")
        self.copied("failed", state="failed", exit_reason="step-underflow: the step became too small")
        for name in ("killed", "running"):
            (self.copied(name, state="running", exit_reason=None, ended=None) / "lock").write_text(lock)
        self.studies(sharp)

    def diffuse(self, name, *settings):
        self.made(name, "run", "phase-field", "standard", *options((*settings, "output.field_interval=0", "time.end=2e-5")))

    def studies(self, sharp):
        code, _, errors = command("sweep", "standard", "--vary", "molecules.patch_radius=20", "--engine", "boundary-integral",
                                  "--until", "0.0005", *sharp, "-o", self.root / "sweep")
        assert code == 0, errors
        code, _, errors = command("map", "standard", *AXES, "--cells", 1, "--levels", 1, "--until", "0.0005", *sharp,
                                  "--folds", self.root / "branch", "-o", self.root / "map")
        assert code == 0, errors
        code, _, errors = endoflow("modes", self.root / "sharp", "--modes", "1", "--times", "1", "--tables-only",
                                   "-o", self.root / "modes")
        assert code == 0, errors
        self.marked("converge", "converge.csv", "epsilon=2.4")
        self.marked("infer", "infer.json", "runs/1")
        self.marked("comparison", "metrics.json")
        self.marked("page", "report.html")
        (self.root / "empty").mkdir()
        (self.root / "a file").write_text("")

    @staticmethod
    def has(engine):
        return (Path(PROGRAM).parent / f"endoflow-{engine}").exists()


class EveryResult(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = scratch_directory(cls)
        cls.results = Results(cls.root)
        cls.results.make()
        holder = (cls.root / "running" / "lock").open()
        cls.addClassCleanup(holder.close)
        fcntl.flock(holder, fcntl.LOCK_EX)
        cls.kinds = [name for name in (*REFUSED, *ELSE) if name == "nothing" or (cls.root / name).exists()]
        cls.out = cls.root / "out"

    def expected(self, kind, name):
        return ELSE[kind] if kind in ELSE else REFUSED[kind].get(name, WORKS)

    def walk(self, name, call):
        """Check the column of a command: call(directory) gives (exit code, stdout, stderr)."""
        for kind in self.kinds:
            with self.subTest(kind, command=name):
                code, told, errors = call(self.root / kind)
                wanted, pattern = self.expected(kind, name)
                self.assertNotRegex(errors, "Traceback|unexpected|internal error|Warning")
                self.assertEqual(code, wanted, errors)
                if wanted:
                    self.assertRegex(errors, pattern)
                    self.assertEqual(errors.count("\n"), 1, errors)
                else:
                    self.assertTrue(told)

    def test_report(self):
        self.walk("report", lambda directory: command("report", directory, "-o", self.out / "report"))

    def test_compare(self):
        """As the first of two runs; refused likewise as the second."""
        other, output = self.root / "sharp", ("-o", self.out / "comparison")
        self.walk("compare", lambda directory: command("compare", directory, other, *output))
        self.kinds = [kind for kind in self.kinds if self.expected(kind, "compare") != WORKS]
        self.walk("compare", lambda directory: command("compare", other, directory, *output))

    def test_one_shape_beside_itself(self):
        """One row of history holds at its own time."""
        for kind in ("state", "vesicle's state"):
            code, _, errors = command("compare", self.root / kind, self.root / kind, "-o", self.out / "itself")
            self.assertEqual((code, errors), (0, ""))

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed (Debian package ffmpeg)")
    def test_movie(self):
        film = ("-o", self.out / "film.gif", "--seconds", 1, "--fps", 2, "--width", 320)
        self.walk("movie", lambda directory: command("movie", directory, *film))

    def test_revolve(self):
        self.walk("revolve", lambda directory: command("revolve", directory, "-o", self.out / "revolve", "--angle", 20))

    def test_crate(self):
        self.walk("crate", lambda directory: command("crate", directory))

    def test_folds(self):
        """Those of `map`; a branch in one of its parameters is what the map among the results was made with."""
        def call(directory):
            if directory.name == "branch":
                return 0, (self.root / "map" / "report.html").read_text()[:10], ""
            return command("map", "standard", *AXES, "--folds", directory, "-o", self.out / "map")

        self.walk("folds", call)

    def test_modes(self):
        """Of the sharp runs, those among the results are what `modes` was made with."""
        def call(directory):
            if self.expected(directory.name, "modes") == WORKS:
                return 0, (self.root / "modes" / "modes.csv").read_text(), ""
            return endoflow("modes", directory, "-o", self.out / "modes", "--times", "1")

        with unittest.mock.patch.dict(ELSE, dict.fromkeys(ELSE, (4, "run.json"))):
            self.walk("modes", call)

    def test_summary(self):
        with unittest.mock.patch.dict(ELSE, dict.fromkeys(ELSE, (4, "run.json"))):
            self.walk("summary", lambda directory: endoflow("summary", directory))
        for kind, words in SUMMARY.items():
            with self.subTest(kind):
                self.assertIn(words, endoflow("summary", self.root / kind)[1])

    def test_states_in_python(self):
        """As `summary` has them."""
        import endoflow as reader

        for kind in ("killed", "running", "interrupted", "failed"):
            self.assertEqual(reader.load(self.root / kind).record["state"], kind)

    def test_pages_say_what_became_of_the_run(self):
        command("report", self.root / "killed", "-o", self.out / "killed")
        page = (self.out / "killed" / "report.html").read_text(encoding="utf-8")
        self.assertIn("the run did not finish: killed, no longer running; continue with --restart", page)

    def test_films_of_branches_are_not_of_time(self):
        run = self.root / "vesicle's branch"
        told = command("movie", run, "-o", self.out / "branch.gif", "--seconds", 1, "--fps", 2, "--width", 320)[1]
        self.assertRegex(told, r"^2 frames, membrane.spontaneous_curvature 0 to 0.002 1/nm: ")


if __name__ == "__main__":
    sys.path.insert(0, str(locations.ROOT))
    unittest.main()
