"""The example of docs/xcp.md."""

import contextlib
import csv
import io
import os
import runpy
import unittest
from pathlib import Path

from pyxcp.config import Transport
from running import PATIENCE_S, Vehicle

EXAMPLE = Path(__file__).parents[4] / "docs" / "xcp_client.py"


class Example(unittest.TestCase):
    def test_it_measures_and_calibrates(self):
        Transport.timeout.default_value = PATIENCE_S
        with Vehicle() as vehicle, contextlib.chdir(vehicle.folder.name):
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                runpy.run_path(os.fspath(EXAMPLE))["main"]("127.0.0.1", vehicle.port)
            with open("signals.csv", newline="") as file:
                rows = list(csv.reader(file))
        self.assertEqual(rows[0][0], "time_us")
        self.assertEqual(len(rows[0]), 4)
        # pyXCP counts the time from the first sample on.
        self.assertEqual([int(row[0]) for row in rows[1:]], [1000 * tick for tick in range(len(rows) - 1)])
        self.assertIn(f"{len(rows) - 1} ticks of 3 signals", printed.getvalue())


if __name__ == "__main__":
    unittest.main()
