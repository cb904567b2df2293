"""Helpers that the tests share; they run the command `dashpot` for comparison."""

import csv
import os
import pathlib
import subprocess
import unittest

PROGRAM = os.environ["DASHPOT_PROGRAM"]
DATA = pathlib.Path(os.environ["DASHPOT_DATA"])


def command(*arguments, folder=None):
    """Runs the command, which must succeed, and returns its standard output."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def refusal(*arguments):
    """Runs the command, which must fail, and returns its error message."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode != 0, done.stdout
    return done.stderr.removeprefix("error: ").removeprefix("usage error: ").strip()


def columns(path):
    """Returns the columns of a CSV file as texts."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name: list(values) for name, *values in zip(*rows)}


class Test(unittest.TestCase):
    def assert_refused(self, words, call, *arguments, **options):
        """Asserts that a call raises the package's exception with this message."""
        import dashpot

        with self.assertRaises(dashpot.DashpotError) as raised:
            call(*arguments, **options)
        self.assertEqual(str(raised.exception), words)
