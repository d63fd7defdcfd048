"""Directories that tests write into."""

import tempfile
from pathlib import Path


def scratch_directory(owner):
    """A new directory (Path) that goes when `owner` is done: a unittest.TestCase, or a class of them in its setUpClass."""
    directory = tempfile.TemporaryDirectory()
    (owner.addClassCleanup if isinstance(owner, type) else owner.addCleanup)(directory.cleanup)
    return Path(directory.name)
