"""RO-Crate metadata of a run: every file is named, every reference leads somewhere, parameters are those of the run."""

import contextlib
import io
import json
import tempfile
import unittest

import locations  # noqa: F401
import synthetic
from scratch import scratch_directory

from comparisons.commands import call


class Crate(unittest.TestCase):
    def crate(self, *arguments):
        """The run's directory, exit code, and content of the metadata after `endoflow crate`."""
        directory = scratch_directory(self) / "run"
        synthetic.write_run(directory, "boundary-integral", lambda t: synthetic.budding_membrane(t, 1.0), [0.0, 1.0])
        with contextlib.redirect_stdout(io.StringIO()):
            code = call(["crate", str(directory), *arguments])
        return directory, code, json.loads((directory / "ro-crate-metadata.json").read_text())

    def test_graph(self):
        directory, code, content = self.crate()
        self.assertEqual(code, 0)
        self.assertEqual(content["@context"], "https://w3id.org/ro/crate/1.1/context")
        entities = {entity["@id"]: entity for entity in content["@graph"]}
        self.assertEqual(len(entities), len(content["@graph"]))
        files = {path.name for path in directory.iterdir()} - {"ro-crate-metadata.json"}
        self.assertEqual({part["@id"] for part in entities["./"]["hasPart"]}, files)
        self.assertEqual(int(entities["history.csv"]["contentSize"]), (directory / "history.csv").stat().st_size)
        self.assertEqual(entities["#parameter-molecules.patch_radius"]["value"], synthetic.PATCH_RADIUS)
        self.assertEqual(entities["#run"]["actionStatus"], "http://schema.org/CompletedActionStatus")

        def references(value):
            if isinstance(value, dict):
                if set(value) == {"@id"}:
                    yield value["@id"]
                for inner in value.values():
                    yield from references(inner)
            if isinstance(value, list):
                for inner in value:
                    yield from references(inner)

        outside = {name for name in references(content["@graph"]) if not name.startswith("https://")}
        self.assertLessEqual(outside, set(entities))

    def test_licence_is_left_to_who_publishes(self):
        self.assertNotIn("license", self.crate()[2]["@graph"][1])
        own = self.crate("--license", "https://creativecommons.org/licenses/by/4.0/")[2]["@graph"][1]
        self.assertEqual(own["license"], {"@id": "https://creativecommons.org/licenses/by/4.0/"})

    def test_no_run(self):
        with tempfile.TemporaryDirectory() as scratch, contextlib.redirect_stderr(io.StringIO()) as errors:
            self.assertEqual(call(["crate", scratch]), 4)
        self.assertIn("is this a directory of `endoflow run`?", errors.getvalue())


if __name__ == "__main__":
    unittest.main()
