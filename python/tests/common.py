"""What the tests share: the command `dashpot` beside the package."""

import csv
import os
import pathlib
import subprocess
import unittest

PROGRAM = os.environ["DASHPOT_PROGRAM"]
DATA = pathlib.Path(os.environ["DASHPOT_DATA"])


def command(*arguments, folder=None):
    """The command, ended well; what it wrote to standard output."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def refusal(*arguments):
    """The words in which the command refuses."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode != 0, done.stdout
    return done.stderr.removeprefix("error: ").removeprefix("wrong use: ").strip()


def columns(path):
    """The columns of a CSV file, texts."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name: list(values) for name, *values in zip(*rows)}


class Test(unittest.TestCase):
    def assert_refused(self, words, call, *arguments, **options):
        """That a call is refused in these words, by the package's exception."""
        import dashpot

        with self.assertRaises(dashpot.DashpotError) as raised:
            call(*arguments, **options)
        self.assertEqual(str(raised.exception), words)
