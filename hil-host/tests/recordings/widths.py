"""Compares widths.mf4, as read by asammdf, with widths.csv in the same folder; widths.rs writes both: widths.py FOLDER.

Integers of more than 53 bits are skipped: asammdf 8.8.28 reads some of them with a wrong sign, or not at all.
"""

import csv
import sys
from pathlib import Path

from asammdf import MDF

folder = Path(sys.argv[1])
with open(folder / "widths.csv", newline="") as file:
    names, *rows = csv.reader(file)
compared = 0
with MDF(folder / "widths.mf4") as file:
    for name, *expected in zip(names, *rows):
        bits = int(name.split("_")[1])
        if bits > 53 and not name.startswith(("4", "5")):
            continue
        read = [float(value) for value in file.get(name).samples]
        assert read == [float(cell) for cell in expected], name
        compared += 1
assert compared > 500, compared
