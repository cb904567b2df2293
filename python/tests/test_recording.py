"""Compares recordings that are read as arrays with pandas and with the command."""

import math
import os
import pathlib
import re
import shutil
import tempfile
import warnings

import dashpot
import numpy
import pandas
from common import DATA, Test, columns, command, refusal

RIDE = DATA / "excitations" / "ride_made.csv"
BENCH = DATA / "bench" / "bench_made.mf4"


class Recordings(Test):
    def test_a_file_is_read_as_by_pandas(self):
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
            words = refusal("replay", "--input", path, "--output", "-")
            self.assertIn("choose one with --time NAME or its number", words)
            self.assert_refused(words.replace("--time NAME", "time=NAME"), dashpot.read, path)
            with self.assertRaisesRegex(dashpot.DashpotError, "^unit `furlong`, allowed: "):
                dashpot.read(path, **{**names, "displacement_unit": "furlong"})

    def test_missing_information_is_requested_by_argument(self):
        names = {"time": "time_s", "displacement": "x --force"}
        for text, options, told in (
            ("t,x\n0,1\n1,2\n", {}, "time=NAME"),
            ("time_s,x\n0,1\n1,2\n", {}, "displacement=NAME"),
            ("0,1\n1,2\n", {}, "header=True or header=False"),
            ("0,1\n1,2\n", {"header": False}, "choose one of 1 to 2 with time, and its unit with time_unit"),
            ("time_s,x --force\n0,1\n1,2\n", names, "give it with displacement_unit: "),
            ("time_s,displacement_m\n0,1\n1,\n2,3\n", {}, "use skip_invalid=True to skip rows"),
            ("1;2\n1.5;2,5\n", {"time": "1", "displacement": "2", "time_unit": "s", "displacement_unit": "m",
                                "header": False}, "decimal_mark="),
        ):
            with tempfile.TemporaryDirectory(prefix="--time ") as folder:
                path = pathlib.Path(folder, "run --force.csv")
                path.write_text(text)
                with self.assertRaises(dashpot.DashpotError) as raised:
                    dashpot.read(path, **options)
                file, reason = str(path), str(raised.exception)
                self.assertTrue(reason.startswith(file), reason)
                self.assertIn(told, reason)
                reason = reason.removeprefix(file).replace("x --force", "")
                self.assertNotIn("--", reason)

    def test_names_of_a_file_stay_as_they_are(self):
        """Fixed bug: options were replaced in the command's texts. After a backtick in a header, one was not replaced, and a header `--force` became `force`."""
        for text, options, told in (
            ("time_s,we`g,--force\n0,1,2\n1,2,3\n", {},
             "column displacement_m is missing; the file has `time_s`, `we`g`, `--force`; choose one with displacement=NAME or its number"),
            ("time_s,--force\n0,1\n1,2\n", {"displacement": "--force"},
             "the file does not state the unit of --force; give it with displacement_unit: m, cm, mm, um, in"),
            ("--time NAME,--force`\n0,1\n1,2\n", {"displacement": "--force`", "displacement_unit": "m"},
             "column time_s is missing; the file has `--time NAME`, `--force``; choose one with time=NAME or its number"),
            ("time_s,displacement_m,--group\n0,0,1\n1,0,x\n", {"with_force": True, "force": "--group", "force_unit": "N"},
             "3: column --group: `x` is not a finite number"),
            ("time_s,displacement_m\n0,0\n1,`--skip-invalid\n", {},
             "3: column displacement_m: ``--skip-invalid` is not a finite number"),
        ):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "run.csv")
                path.write_text(text)
                between = ":" if told.startswith("3: ") else ": "
                self.assert_refused(f"{path}{between}{told}", dashpot.read, path, **options)

    def test_a_last_line_without_an_end_is_warned_of(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "run.csv")
            path.write_text("time_s,displacement_m,force_n\n0,0,1\n1,0,125")
            for options in ({}, {"step_s": 1e-2}, {"with_force": True}):
                with self.assertWarnsRegex(UserWarning, f"^{re.escape(str(path))}:3: the last line has no line end"):
                    dashpot.read(path, **options)
            path.write_text("time_s,displacement_m,force_n\n0,0,1\n1,0,1250.5\n")
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                dashpot.read(path)

    def test_the_text_format_can_be_given(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "run.csv")
            path.write_text("1900;1,5\n1901;2\n")
            columns = {"time": "1", "displacement": "2", "time_unit": "s", "displacement_unit": "m"}
            read = dashpot.read(path, header=False, decimal_mark="comma", **columns)
            self.assertEqual(read["displacement_m"].tolist(), [1.5, 2.0])
            self.assert_refused("decimal_mark: `dot`, allowed: `point` or `comma`", dashpot.read, path, decimal_mark="dot")

    def test_paths_of_any_kind_are_read(self):
        expected = dashpot.read(RIDE)["displacement_m"].tobytes()
        with tempfile.TemporaryDirectory() as folder:
            # Bytes that are not UTF-8.
            path = os.path.join(os.fsencode(folder), b"run\xff.csv")
            shutil.copy(RIDE, path)
            for kind in (path, os.fsdecode(path), pathlib.Path(os.fsdecode(path))):
                self.assertEqual(dashpot.read(kind)["displacement_m"].tobytes(), expected)
            os.unlink(path)
            with self.assertRaises(OSError) as raised:
                dashpot.read(path)
            self.assertEqual(raised.exception.filename, os.fsdecode(path))

    def test_unreadable_files_are_refused(self):
        self.assert_refused(refusal("replay", "--input", "no/such.csv", "--output", "-"), dashpot.read, "no/such.csv")
        with self.assertRaises(OSError):
            dashpot.read("no/such.csv")
        for step_s in (0, -1, math.nan, math.inf):
            with self.assertRaisesRegex(dashpot.DashpotError, "^step: "):
                dashpot.read(RIDE, step_s=step_s)
        self.assert_refused("step_s and with_force: both given, allowed: only one of them", dashpot.read, BENCH,
                            step_s=1e-3, with_force=True)
