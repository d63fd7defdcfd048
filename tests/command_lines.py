"""What tests of a program's command line ask."""

import unittest


class CommandLineTest(unittest.TestCase):
    def assert_refused(self, result, code, *words):
        """The finished process ended with this exit code and one line on stderr, which has these words."""
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
