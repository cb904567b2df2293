"""Calibration with pyXCP, judged by runs of cases whose dampers change at the same time."""

import tempfile
import unittest
from pathlib import Path

from running import Collected, Vehicle, columns, daq_list, master, plain_run, uploaded, value, write

DAMPER = "front lateral damper 1"
SLUG = "front_lateral_damper_1"
SIGNALS = [f"{SLUG}_force_n", f"{SLUG}_displacement_m", "wheelset_1_lateral_m", "time_s"]
# The locomotive without its own model of this damper, which has no oil.
OPTIONS = ["--damper", "front lateral damper=in-service", "--duration-s", "0.8"]
TICKS = 800


def judged(faults):
    """Signals of a run whose dampers change at a time."""
    case = 'name = "judge"\nvehicle = "locomotive"\ntrack = "straight"\nspeed_km_h = 180\nduration_s = 5\n'
    case += "start_m = -15\nfriction = 0.4\n"
    for time_s, damper, numbers in faults:
        numbers = ", ".join(f'"{key}={number!r}"' for key, number in numbers.items())
        case += f'[[fault]]\ntime_s = {time_s}\ndamper = "{damper}"\nset = [{numbers}]\n'
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "case.toml").write_text(case)
        plain_run(folder, "--case", "case.toml", *OPTIONS)
        return columns(Path(folder) / "history.csv", SIGNALS)


class Calibrate(unittest.TestCase):
    def run_with(self, change):
        """Measures until tick 400 or later, has the master change something, and measures until the end."""
        with Vehicle(*OPTIONS) as vehicle:
            a2l = vehicle.a2l()
            collected = Collected([daq_list(a2l, SIGNALS)])
            with master(vehicle.port, policy=collected) as xcp:
                collected.setup()
                collected.run_until(400)
                at_us = collected.times_us[-1]
                changed = change(xcp, uploaded(xcp))
                collected.run_until(TICKS)
            report = vehicle.end()["xcp"]
            self.assertEqual(collected.lost(), 0)
            measured = collected.columns()
            self.assert_same(measured, vehicle.history(SIGNALS))
        tick = at_us // 1000
        self.assertGreaterEqual(tick, 400)
        for change in report["changes"]:
            self.assertEqual(round(1e6 * change["time_s"]), at_us)
        return changed, tick, measured, report["changes"]

    def assert_same(self, measured, expected):
        """To the bit; the first difference is enough to see."""
        for name in SIGNALS:
            pairs = enumerate(zip(measured[name], expected[name], strict=True))
            self.assertEqual(next((pair for pair in pairs if pair[1][0] != pair[1][1]), None), None, name)

    def assert_continuous(self, force_n, tick):
        """The force of the damper does not jump where the damper changes."""
        steps = [abs(after - before) for before, after in zip(force_n, force_n[1:])]
        # Tick 1 has number 0.
        self.assertLessEqual(steps[tick - 1], max(steps[tick - 20 : tick - 1]))

    def test_clearance_temperature_air_and_stiffness(self):
        numbers = {
            "mount.clearance_m": 3.5e-3,
            "oil.temperature_c": -20.0,
            "oil.column.air_fraction": 0.03,
            "mount.stiffness_n_per_m": 4.5e6,
        }

        def change(xcp, a2l):
            for key, number in numbers.items():
                write(xcp, a2l.parameters[f"{SLUG}.{key}"], number)
                self.assertEqual(value(xcp, a2l.parameters[f"{SLUG}.{key}"]), number)

        _, tick, measured, changes = self.run_with(change)
        expected = judged([(tick / 1000, DAMPER, numbers)])
        self.assert_same(measured, expected)
        self.assertNotEqual(measured, judged([]))
        self.assert_continuous(measured[SIGNALS[0]], tick)
        self.assertEqual([(found["key"], found["value"]) for found in changes], list(numbers.items()))
        self.assertEqual({found["damper"] for found in changes}, {DAMPER})

    def test_pages_as_new_and_worn(self):
        names = {}

        def change(xcp, a2l):
            self.assertEqual(xcp.getCalPage(0x01, 0), 0)
            as_new = {name: value(xcp, address) for name, address in a2l.parameters.items()}
            xcp.setCalPage(0x83, 0, 1)
            self.assertEqual(xcp.getCalPage(0x01, 0), 1)
            worn = {name: value(xcp, address) for name, address in a2l.parameters.items()}
            self.assertNotEqual(worn, as_new)
            self.assertEqual(worn[f"{SLUG}.mount.clearance_m"], as_new[f"{SLUG}.mount.clearance_m"] + 5e-3)
            # Numbers of each damper, whose name has blanks in place of underscores.
            for name, number in worn.items():
                damper, key = name.split(".", 1)
                names.setdefault(damper.replace("_", " "), {})[key] = number

        _, tick, measured, changes = self.run_with(change)
        self.assertEqual([found["page"] for found in changes], ["worn"])
        faults = [(tick / 1000, damper, numbers) for damper, numbers in names.items()]
        self.assertGreaterEqual(len(faults), 12)
        self.assert_same(measured, judged(faults))
        self.assertNotEqual(measured, judged([]))
        self.assert_continuous(measured[SIGNALS[0]], tick)


if __name__ == "__main__":
    unittest.main()
