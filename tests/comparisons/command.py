"""Runs the command under test."""

import os
import subprocess
import sys

import locations


def compare(*arguments, **environment):
    """Run compare.py with additions to the environment; returns the finished process with its text."""
    return subprocess.run(
        [sys.executable, str(locations.COMPARE), *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=60,
        env={**os.environ, **environment},
    )
