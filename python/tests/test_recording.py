"""Recordings as arrays, beside pandas and the command."""

import math
import pathlib
import tempfile

import dashpot
import numpy
import pandas
from common import DATA, Test, columns, command, refusal

RIDE = DATA / "excitations" / "ride_made.csv"
BENCH = DATA / "bench" / "bench_made.mf4"


class Recordings(Test):
    def test_a_file_is_what_pandas_reads(self):
        told, read = pandas.read_csv(RIDE, comment="#", float_precision="round_trip"), dashpot.read(RIDE)
        self.assertEqual(list(read), ["time_s", "displacement_m"])
        for name, column in read.items():
            self.assertEqual(column.tolist(), told[name].tolist())

    def test_ticks_are_those_of_the_command(self):
        for path, options in ((RIDE, {}), (BENCH, {})):
            with tempfile.TemporaryDirectory() as folder:
                command("replay", "--damper", "paper", "--input", path, "--output", "force.csv", "--step-us", 700,
                        folder=folder)
                told = columns(pathlib.Path(folder, "force.csv"))
            read = dashpot.read(path, step_s=700e-6, **options)
            for name, column in read.items():
                self.assertEqual(column.tolist(), [float(cell) for cell in told[name]])

    def test_forces_are_read_with_their_motion(self):
        read = dashpot.read(BENCH, with_force=True)
        self.assertEqual(list(read), ["time_s", "displacement_m", "force_n"])
        self.assertEqual(len({len(column) for column in read.values()}), 1)
        self.assertGreater(abs(read["force_n"]).max(), 100)
        self.assertTrue((numpy.diff(read["time_s"]) > 0).all())

    def test_channels_and_units_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "run.csv")
            path.write_text("t,weg,kraft\n0,1,2\n1,2,\n2,3,4\n")
            names = {"time": "t", "displacement": "weg", "time_unit": "ms", "displacement_unit": "mm"}
            self.assertEqual(dashpot.read(path, **names)["displacement_m"].tolist(), [1e-3, 2e-3, 3e-3])
            forces = dashpot.read(path, with_force=True, force="kraft", force_unit="kN", skip_invalid=True, **names)
            self.assertEqual(forces["force_n"].tolist(), [2e3, 4e3])
            self.assert_refused(refusal("replay", "--input", path, "--output", "-"), dashpot.read, path)
            with self.assertRaisesRegex(dashpot.DashpotError, "^unit `furlong`, allowed: "):
                dashpot.read(path, **{**names, "displacement_unit": "furlong"})

    def test_what_cannot_be_read_is_refused(self):
        self.assert_refused(refusal("replay", "--input", "no/such.csv", "--output", "-"), dashpot.read, "no/such.csv")
        with self.assertRaises(OSError):
            dashpot.read("no/such.csv")
        for step_s in (0, -1, math.nan, math.inf):
            with self.assertRaisesRegex(dashpot.DashpotError, "^step: "):
                dashpot.read(RIDE, step_s=step_s)
        self.assert_refused("step_s with with_force: allowed: one of them", dashpot.read, BENCH, step_s=1e-3,
                            with_force=True)
