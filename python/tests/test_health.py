"""Health of a damper and of a fleet: the numbers of the command, alarms, baselines and refusals."""

import csv
import json
import math
import pathlib
import pickle
import subprocess
import tempfile

import dashpot
import numpy
from common import PROGRAM, Test, columns, command

NAMES = ("flow_factor", "damping_factor", "stiffness_n_per_m", "clearance_m", "lag_s", "compliance_m_per_n", "force_zero_n",
         "added_friction_n")


def motion(seconds=10):
    time_s = numpy.arange(1000 * seconds) * 1e-3
    return time_s, 5e-3 * numpy.sin(8 * time_s) + 1e-3 * numpy.sin(50 * time_s)


def recording(overrides, seed=1):
    """Returns time, displacement and force of a damper with these overrides, with noise."""
    time_s, x = motion()
    force_n = dashpot.Damper("in-service", overrides).build(1e-3, float).replay(x)
    noise = numpy.random.default_rng(seed).normal(size=(2, len(x)))
    return {"time_s": time_s, "displacement_m": x + 1e-5 * noise[0], "force_n": force_n + 20 * noise[1]}


def write(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(rows)
        writer.writerows(zip(*(column.tolist() for column in rows.values())))


class Health(Test):
    @classmethod
    def setUpClass(cls):
        cls.damper = dashpot.Damper("in-service")
        cls.worn = recording({"mount.clearance_m": 3e-3})

    def test_the_numbers_are_those_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            write(pathlib.Path(folder, "worn.csv"), self.worn)
            text = command("replay", "--damper", "in-service", "--input", "worn.csv", "--output", "force.csv", "--health",
                           "page.html", "--format", "json", folder=folder)
            told = json.loads(text)["health"]
            read = dashpot.read(pathlib.Path(folder, "worn.csv"), with_force=True)
        found = dashpot.health(self.damper, read)
        for name in NAMES:
            estimate = getattr(found, name)
            # The command prints single precision.
            self.assertEqual([numpy.float32(told[name][part]) for part in ("value", "sd")], list(estimate), name)
            self.assertEqual(found.history[name][-1], estimate.value)
            self.assertEqual(found.history[f"{name}_sd"][-1], estimate.sd)
        for name in ("samples", "rejected", "displacement_noise_m", "force_noise_n"):
            self.assertEqual(getattr(found, name), told[name])
        self.assertEqual(found.is_trusted, told["trusted"])
        status = {bit.name.lower() for bit in found.status}
        self.assertEqual(status, set(told["status"]))
        self.assertEqual([(alarm.parameter, alarm.time_s) for alarm in found.alarms],
                         [(alarm["parameter"], alarm["time_s"]) for alarm in told["alarms"]])
        self.assertEqual([cause[:3] for cause in found.causes],
                         [(cause["kind"], cause["value"], cause["probability"]) for cause in told["causes"]["causes"]])

    def test_wear_raises_an_alarm_and_names_its_cause(self):
        found = dashpot.health(self.damper, self.worn)
        self.assertAlmostEqual(found.clearance_m.value / 3e-3, 1, 1)
        self.assertEqual([alarm.parameter for alarm in found.alarms], ["clearance"])
        self.assertIn(dashpot.HealthStatus.CLEARANCE, found.status)
        self.assertEqual(found.causes[0].kind, "clearance")
        self.assertIn("clearance", repr(found))
        self.assertIn("alarm", found._repr_html_())
        again = pickle.loads(pickle.dumps(found))
        self.assertEqual(again.clearance_m, found.clearance_m)

    def test_a_baseline_is_what_the_damper_is_compared_with(self):
        healthy = dashpot.health(self.damper, self.worn)
        found = dashpot.health(self.damper, recording({"mount.clearance_m": 3e-3}, seed=2), baseline=healthy)
        self.assertEqual((found.alarms, found.causes), ([], None))

    def test_given_noise_is_used(self):
        found = dashpot.health(self.damper, self.worn, displacement_noise_m=2e-5, force_noise_n=30.0)
        self.assertEqual((found.displacement_noise_m, found.force_noise_n), (2e-5, 30.0))

    def test_wrong_arguments_are_refused(self):
        def refused(words, **changes):
            self.assert_refused(words, dashpot.health, self.damper, {**self.worn, **changes})

        for name, words in (("memory_s", "^memory_s: -1, allowed: "), ("step_s", "^step: -1 s, allowed: ")):
            with self.assertRaisesRegex(dashpot.DashpotError, words):
                dashpot.health(self.damper, self.worn, **{name: -1.0})
        count = len(self.worn["time_s"])
        refused(f"recording: {count - 1} times, {count} displacements and {count} forces, allowed: the same number of each",
                time_s=self.worn["time_s"][1:])
        nan = self.worn["force_n"].copy()
        nan[3] = math.nan
        refused("recording: sample 3: allowed: finite numbers", force_n=nan)
        still = numpy.zeros(count)
        refused("cannot estimate the noise: this needs motion and at least 100 samples without a gap; give "
                "displacement_noise_m and force_noise_n", displacement_m=still, force_n=still)
        with self.assertRaises(AttributeError):
            dashpot.health(self.damper, self.worn, baseline=3.0)


class Fleet(Test):
    def test_trends_are_those_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            position = pathlib.Path(folder, "fleet", "401", "front-lateral")
            position.mkdir(parents=True)
            for month in range(1, 7):
                worn = recording({"mount.clearance_m": 1e-3 + 2e-4 * month}, seed=month)
                write(position / f"2026-{month:02}-01.csv", worn)
            (position / "2026-07-01.csv").write_text("time_s\n1\n")
            history = pathlib.Path(folder, "fleet")
            found = dashpot.fleet(history, dashpot.Damper("in-service"))
            arguments = ("--history", history, "--damper", "in-service", "--output", "readings.csv", "--trends", "trends.csv")
            done = subprocess.run([PROGRAM, "health", *map(str, arguments)], cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 1, done.stderr)
            for table, name in ((found.readings, "readings.csv"), (found.trends, "trends.csv")):
                told = columns(pathlib.Path(folder, name))
                self.assertEqual(list(table), list(told))
                for key, cells in told.items():
                    if isinstance(table[key], numpy.ndarray):
                        expected = numpy.array([float(cell or "nan") for cell in cells])
                        same = expected.astype(numpy.float32) == table[key].astype(numpy.float32)
                        self.assertTrue((same | numpy.isnan(expected)).all(), key)
                    else:
                        shown = [str(cell).lower() if isinstance(cell, bool) else cell or "" for cell in table[key]]
                        self.assertEqual(shown, cells, key)
            self.assertEqual((found.dampers, found.recordings, found.recordings_used, found.recordings_unreadable),
                             (1, 7, 6, 1))
            self.assertIn("6 of 7 recordings used", found.text)
            row = found.trends["parameter"].index("clearance_m")
            self.assertAlmostEqual(found.trends["rate"][row] / (12 * 2e-4), 1, 1)
            self.assertEqual(pickle.loads(pickle.dumps(found)).text, found.text)
            self.assertIn("front-lateral", found._repr_html_())

    def test_wrong_arguments_are_refused(self):
        damper = dashpot.Damper("in-service")
        self.assert_refused("limit_clearance_m: -1, allowed: a number above 0", dashpot.fleet, ".", damper,
                            limit_clearance_m=-1)
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(dashpot.DashpotError, "no recording; allowed"):
            dashpot.fleet(folder, damper)
