"""Dampers from presets, files and text. Errors have the words of the command."""

import copy
import errno
import os
import pathlib
import pickle
import tempfile

import dashpot
import numpy
from common import DATA, Test, command, refusal


class Dampers(Test):
    def test_a_file_is_the_preset(self):
        for name in ("paper", "in-service", "calibrated", "reduced-vertical", "reduced-lateral"):
            path = DATA / "dampers" / f"{name}.toml"
            preset, read = dashpot.Damper(name), dashpot.Damper(path)
            self.assertEqual(preset, read)
            self.assertEqual(preset, dashpot.Damper.from_toml(path.read_text()))
            self.assertEqual(preset, dashpot.Damper.from_toml(preset.to_toml()))
            self.assertEqual(preset, pickle.loads(pickle.dumps(preset)))
            self.assertEqual(hash(preset), hash(read))
            self.assertEqual(dict(preset), dict(read))

    def test_overrides_are_those_of_the_command(self):
        damper = dashpot.Damper("in-service", {"mount.clearance_m": 1e-3, "mount.stiffness_n_per_m": 9000000})
        self.assertEqual(damper["mount.clearance_m"], 1e-3)
        self.assertEqual(damper["mount.stiffness_n_per_m"], 9e6)
        self.assertNotEqual(damper, dashpot.Damper("in-service"))
        self.assertEqual(damper, dashpot.Damper("in-service").replace(dict(damper)))
        self.assertEqual(dashpot.Damper("paper", {"mount.clearance_m": numpy.float32(0.5e-3)})["mount.clearance_m"],
                         float(numpy.float32(0.5e-3)))
        self.assertIn("mount.clearance_m", damper)
        self.assertNotIn("mount.clearance", damper)
        self.assertNotIn(3, damper)
        self.assertEqual(len(damper), len(list(damper)))

    def test_errors_have_the_words_of_the_command(self):
        missing = "no/such.toml"
        rig = ("rig", "--damper")
        self.assert_refused(refusal(*rig, "papr"), dashpot.Damper, "papr")
        self.assert_refused(refusal(*rig, missing), dashpot.Damper, missing)
        self.assert_refused(refusal(*rig, "paper", "--set", "mount.clearance_m=-1.0"),
                            dashpot.Damper, "paper", {"mount.clearance_m": -1})
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "mine.toml")
            for text in ("[mount\n", "[mount]\nclearance = 1.0\n", "[mount]\nclearance_m = 0.5\n"):
                path.write_text(text)
                self.assert_refused(refusal(*rig, path), dashpot.Damper, path)

    def test_a_missing_file_is_an_error_of_the_system(self):
        with self.assertRaises(OSError) as raised:
            dashpot.Damper("no/such.toml")
        error = raised.exception
        self.assertIsInstance(error, dashpot.DashpotFileError)
        self.assertEqual(str(error), refusal("rig", "--damper", "no/such.toml"))
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((str(again), again.args), (str(error), error.args))
        for told in (error, again):
            self.assertEqual((told.errno, told.filename), (errno.ENOENT, "no/such.toml"))
            self.assertEqual(told.strerror, os.strerror(errno.ENOENT))
        self.assertFalse(issubclass(dashpot.DashpotError, OSError))

    def test_paths_are_text_or_bytes(self):
        path = DATA / "dampers" / "paper.toml"
        for kind in (str(path), os.fsencode(path), path, b"paper"):
            self.assertEqual(dashpot.Damper(kind), dashpot.Damper("paper"))
        for wrong in (b"dampers/\xff.toml", "dampers/\udcff.toml", pathlib.Path("dampers/\udcff.toml")):
            words = "dampers/\ufffd.toml: allowed: a name or a path in UTF-8"
            self.assert_refused(words, dashpot.Damper, wrong)
            self.assert_refused(words, dashpot.vehicle, wrong)
            self.assert_refused(words, dashpot.Study, wrong)
            self.assert_refused(words, dashpot.contact, wrong)

    def test_a_reason_outside_the_system_has_no_errno(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "mine.toml")
            path.write_bytes(b"\xff")
            with self.assertRaises(dashpot.DashpotFileError) as raised:
                dashpot.Damper(path)
        self.assertEqual((raised.exception.errno, raised.exception.filename), (None, str(path)))
        self.assertTrue(str(raised.exception).startswith(f"{path}: cannot read: "))

    def test_wrong_overrides_are_refused(self):
        self.assert_refused("override mount.clearance_m: NoneType, allowed: a number, a string or a bool",
                            dashpot.Damper, "paper", {"mount.clearance_m": None})
        self.assert_refused('overrides: list, allowed: a dictionary such as {"mount.clearance_m": 1e-3}',
                            dashpot.Damper, "paper", ["mount.clearance_m=1"])
        self.assert_refused("override mount.clearance_m: a number beyond the range of float64, allowed: finite numbers",
                            dashpot.Damper, "paper", {"mount.clearance_m": 10**400})
        for value in (float("nan"), float("inf"), -1e300, "wide", True):
            with self.assertRaises(dashpot.DashpotError):
                dashpot.Damper("paper", {"mount.clearance_m": value})
        with self.assertRaises(TypeError):
            dashpot.Damper(7)

    def test_it_is_a_mapping(self):
        damper, clearance = dashpot.Damper("in-service"), "mount.clearance_m"
        self.assertEqual(damper.items(), list(dict(damper).items()))
        self.assertEqual(damper.values(), [damper[key] for key in damper])
        self.assertEqual(list(damper), damper.keys())
        self.assertEqual(damper.get(clearance), damper[clearance])
        self.assertEqual([damper.get("no.such"), damper.get("no.such", 7), damper.get(3, 7)], [None, 7, 7])
        words = "paper: no number at `mount.clearanse_m`; did you mean `mount.clearance_m`?"
        for kind in (KeyError, dashpot.DashpotError, dashpot.DashpotKeyError):
            with self.assertRaises(kind) as raised:
                dashpot.Damper("paper")["mount.clearanse_m"]
            self.assertEqual(str(raised.exception), words)
        self.assertEqual(str(pickle.loads(pickle.dumps(raised.exception))), words)

    def test_invalid_steps_are_refused(self):
        damper = dashpot.Damper("paper")
        for step_s in (0.0, -1e-3, float("nan"), float("inf"), 1.0, 1e-12):
            with self.assertRaisesRegex(dashpot.DashpotError, "step_s"):
                damper.build(step_s)
        self.assert_refused("dtype: int32, allowed: float32 or float64", damper.build, dtype=numpy.int32)
        self.assert_refused("dtype: >f4, allowed: float32 or float64", damper.build, dtype=">f4")
        self.assertEqual(damper.build(dtype="f8").dtype, numpy.float64)
        self.assertEqual(damper.build(dtype=float).dtype, numpy.float64)
        self.assertEqual(damper.build().dtype, numpy.float32)

    def test_a_clearance_is_changed_as_firmware_does(self):
        for dtype in (numpy.float32, numpy.float64):
            built = dashpot.Damper("paper").build(1e-3, dtype)
            worn = built.with_clearance_m(3e-3)
            self.assertNotEqual(built.revision, worn.revision)
            self.assertAlmostEqual(worn.clearance_m, 3e-3, 9)
            anew = dashpot.Damper("paper", {"mount.clearance_m": 3e-3}).build(1e-3, dtype)
            x = (5e-3 * numpy.sin(numpy.arange(3000) / 160)).astype(dtype)
            numpy.testing.assert_allclose(worn.replay(x), anew.replay(x), rtol=1e-4, atol=0.1)
            again = pickle.loads(pickle.dumps(worn))
            self.assertEqual(again.revision, worn.revision)
            self.assertTrue(numpy.array_equal(again.replay(x), worn.replay(x)))
        for clearance_m in (-1e-6, 0.2, float("nan")):
            with self.assertRaisesRegex(dashpot.DashpotError, "mount.clearance_m must be"):
                built.with_clearance_m(clearance_m)

    def test_it_is_immutable(self):
        damper = dashpot.Damper("paper")
        with self.assertRaises(TypeError):
            damper["mount.clearance_m"] = 0.0
        with self.assertRaises(AttributeError):
            damper.build().step_s = 1.0

    def test_the_command_accepts_a_damper_of_the_package(self):
        damper = dashpot.Damper("in-service", {"mount.clearance_m": 1.25e-3})
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "mine.toml").write_text(damper.to_toml())
            told = command("rig", "--damper", "mine.toml", "--format", "json", folder=folder)
            self.assertEqual(told.split('"cycles"')[1], command(
                "rig", "--damper", "in-service", "--set", "mount.clearance_m=1.25e-3", "--format", "json"
            ).split('"cycles"')[1])
        self.assertEqual(copy.deepcopy(damper), damper)
