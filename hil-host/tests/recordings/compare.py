"""Compares values and units of force.parquet and force.mf4 with force.csv in the same folder: compare.py FOLDER."""

import json
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
from asammdf import MDF

folder = Path(sys.argv[1])
expected = pd.read_csv(folder / "force.csv", float_precision="round_trip")
units = {"time_s": "s", "displacement_m": "m", "force_n": "N"}

table = pq.read_table(folder / "force.parquet")
assert json.loads(table.schema.metadata[b"units"]) == units
assert table.column_names == list(expected.columns)
assert table.to_pandas().equals(expected)

with MDF(folder / "force.mf4") as file:
    for name in ["displacement_m", "force_n"]:
        signal = file.get(name)
        assert signal.unit == units[name], signal.unit
        assert np.array_equal(signal.samples, expected[name])
        assert np.array_equal(signal.timestamps, expected["time_s"])
