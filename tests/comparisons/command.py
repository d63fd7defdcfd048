"""Runs the command under test; `compare` on two runs whose membranes are parallel curves."""

import os
import subprocess
import sys
import unittest

import locations
import synthetic
from scratch import scratch_directory


def words(command, *arguments):
    """What is started as `endoflow COMMAND ARGUMENTS`."""
    return [sys.executable, locations.COMPARISONS, command, *map(str, arguments)]


def call(command, *arguments, stdout=subprocess.PIPE, **environment):
    """Run a command with additions to the environment; returns the finished process with its text."""
    return subprocess.run(
        words(command, *arguments),
        stdout=stdout,
        stderr=subprocess.PIPE,
        text=True,
        timeout=1200,
        env={**os.environ, **environment},
    )


def compare(*arguments, **how):
    """Run `compare`, otherwise as call."""
    return call("compare", *arguments, **how)


class CommandTest(unittest.TestCase):
    """What the tests of every command ask."""

    def assert_one_line(self, process, code, pattern):
        """The command ended with this exit code and one line on stderr that matches."""
        self.assertEqual(process.returncode, code, process.stderr)
        self.assertRegex(process.stderr, pattern)
        self.assertEqual(process.stderr.count("\n"), 1, process.stderr)


def unnamed_basis(page):
    """What a report page does not say of what every page must say: convention, resolution, alarms."""
    return [word for word in ("curvature convention", "resolution", "alarms") if word not in page]


class CompareTest(CommandTest):
    """Gives each test self.scratch (Path) with the runs self.a and self.b."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = scratch_directory(cls)
        cls.a, cls.b = synthetic.write_pair(cls.scratch, count=9)
