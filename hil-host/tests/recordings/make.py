"""Writes the same recording with asammdf, pyarrow and pandas in every supported file format: make.py FOLDER ROWS.

expected.csv contains it in SI units. Names, units and formats are those read by forms.rs in this folder.
"""

import json
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
from asammdf import MDF, Signal

import unsorted

folder, rows = Path(sys.argv[1]), int(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)

# Values that every format represents exactly: multiples of 1/8 ms, 1/8 mm and 1/8 N.
number = np.arange(rows)
time_us = 1000 * number + 125 * (number * 7919 % 5)
counts = (number * 104729 % 4001 - 2000).astype(np.int16)
time_s = time_us / 1e6
displacement_mm = counts / 8
force_n = np.round(8000 * np.sin(0.01 * number)) / 8
expected = pd.DataFrame(
    {"time_s": time_s, "displacement_m": displacement_mm / 1e3, "force_n": force_n}
)
expected.to_csv(folder / "expected.csv", index=False)


def signals(**kinds):
    weg = kinds.get("weg", Signal(displacement_mm, time_s, "mm", "Weg"))
    kraft = kinds.get("kraft", Signal(force_n, time_s, "N", "Kraft"))
    return [weg, kraft]


def mdf(name, groups, **options):
    file = MDF(version="4.10")
    for group, acquisition in groups:
        file.append(group, acq_name=acquisition, comment="made")
    file.save(folder / name, overwrite=True, **options)
    file.close()


mdf("plain.mf4", [(signals(), "Messung")])
mdf("deflated.mf4", [(signals(), "Messung")], compression=1)
mdf("transposed.mf4", [(signals(), "Messung")], compression=2)
raw = Signal(counts, time_s, "mm", "Weg", conversion={"a": 0.125, "b": 0.0})
single = Signal(force_n.astype(np.float32), time_s, "N", "Kraft")
mdf("converted.mf4", [(signals(weg=raw, kraft=single), "Messung")], compression=2)
# 16-bit floats have 11 bits, enough for the displacement but not for the 13 bits of the force.
halves = Signal(displacement_mm.astype("<f2"), time_s, "mm", "Weg")
turned = Signal(displacement_mm.astype(">f2"), time_s, "mm", "geW")
big_endian = Signal(force_n.astype(">f4"), time_s, "N", "Kraft")
mdf("halves.mf4", [([halves, turned, big_endian], "Messung")])
# Samples 10, 110, 210 and so on, counted from 0, are marked as invalid.
marked = number % 100 == 10
wrong = np.where(marked, 4.0e3, displacement_mm)
invalid = Signal(wrong, time_s, "mm", "Weg", invalidation_bits=marked)
mdf("invalid.mf4", [(signals(weg=invalid), "Messung")])
slow = Signal(20.0 + number[::10] / 8, time_s[::10], "degC", "Temperatur")
other = Signal(displacement_mm[::10], time_s[::10], "mm", "Weg")
mdf("groups.mf4", [([slow, other], "langsam"), (signals(), "Messung")])

# Writes one file with a single data block, and one with several blocks that end within records.
for name, block_bytes in [("unsorted.mf4", None), ("unsorted_parts.mf4", 333)]:
    unsorted.write(folder / name, time_s, displacement_mm, force_n, block_bytes)
    with MDF(folder / name) as file:
        for channel, values in [("Weg", displacement_mm), ("Kraft", force_n)]:
            signal = file.get(channel)
            assert np.array_equal(signal.timestamps, time_s)
            assert np.array_equal(signal.samples, values)

table = pa.table({"time_s": time_s, "displacement_m": displacement_mm / 1e3, "force_n": force_n})


def parquet(name, table, **options):
    pq.write_table(table, folder / name, **options)


for codec in ["none", "snappy", "gzip", "brotli", "lz4", "zstd"]:
    parquet(f"{codec}.parquet", table, compression=codec, row_group_size=max(rows // 3, 1))
parquet("pages.parquet", table, data_page_version="2.0", data_page_size=256)
parquet(
    "plain.parquet",
    pa.table({"t": time_s, "Weg [mm]": displacement_mm.astype(np.float32), "Kraft": force_n}),
    use_dictionary=False,
)
for unit in ["us", "ns"]:
    scale = 1 if unit == "us" else 1000
    start = 1_700_000_000_000_000
    stamps = pa.array((start + time_us) * scale, pa.timestamp(unit, tz="UTC"))
    numbers = {"zeit": stamps, "Weg [mm]": counts / 8, "force_n": force_n}
    parquet(f"stamps_{unit}.parquet", pa.table(numbers))
durations = pa.array(time_us * 1000, pa.duration("ns"))
units = json.dumps({"x": "mm", "F": "N"})
labelled = pa.table({"t": durations, "x": displacement_mm, "F": force_n})
parquet("units.parquet", labelled.replace_schema_metadata({"units": units}))
holes = pa.array(np.where(marked, np.nan, displacement_mm / 1e3), from_pandas=True)
parquet("nulls.parquet", table.set_column(1, "displacement_m", holes))

german = pd.DataFrame(
    {"Zeit [ms]": time_us / 1e3, "Weg [µm]": displacement_mm * 1e3, "Kraft [kN]": force_n / 1e3}
)
for name, options in {
    "german.csv": {"encoding": "cp1252"},
    "utf_16.csv": {"encoding": "utf-16"},
    "german.csv.gz": {"encoding": "utf-8-sig", "compression": "gzip"},
}.items():
    german.to_csv(folder / name, sep=";", decimal=",", index=False, **options)
expected.to_csv(folder / "indexed.csv")
expected.to_csv(folder / "bare.csv", header=False, index=False, sep="\t")
german.to_parquet(folder / "pandas.parquet")
