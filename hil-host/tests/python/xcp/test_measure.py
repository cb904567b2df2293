"""Measurement with pyXCP."""

import os
import struct
import unittest
from pathlib import Path

from running import Collected, Running, Vehicle, daq_list, master, uploaded


class Measure(unittest.TestCase):
    def measure(self, ticks, protocol, *options):
        """Measures 20 signals in every tick of a run; compares them with the recording."""
        with Vehicle("--duration-s", str(ticks / 1000), *options) as vehicle:
            a2l = vehicle.a2l()
            names = list(a2l.measured)
            names = names[:: len(names) // 20][:20]
            collected = Collected([daq_list(a2l, names)])
            with master(vehicle.port, protocol, collected) as xcp:
                self.assertEqual(uploaded(xcp).text, a2l.text)
                collected.setup()
                collected.run_until(ticks)
            report = vehicle.end()
            history = vehicle.history(names)
        self.assertEqual(collected.lost(), 0)
        self.assertEqual(len(collected.samples), ticks)
        self.assertTrue(collected.times_us == [1000 * tick for tick in range(1, ticks + 1)])
        self.assertEqual(set(collected.columns()), set(names))
        for name, column in collected.columns().items():
            # To the bit: the text of a history has all digits.
            self.assertTrue(column == history[name], name)
        xcp = report["xcp"]
        self.assertEqual((xcp["measured_ticks"], xcp["lost_ticks"], xcp["sessions"]), (ticks, 0, 1))
        self.assertEqual((xcp["refused_commands"], xcp["changes"]), (0, []))

    def test_100_000_samples_of_20_signals_without_a_loss(self):
        self.measure(100_000, "TCP")

    def test_datagrams(self):
        self.measure(300, "UDP")

    def test_a_damper_on_a_virtual_rig(self):
        rig = ["--outside", "front yaw damper 1=desk", "--actuator", "servo"]
        self.measure(300, "TCP", *rig)

    def test_a_bank_of_dampers_on_a_target(self):
        motion = Path(__file__).parents[4] / "data/excitations/ride_made.csv"
        target = os.environ["DASHPOT_TARGET"]
        bank = ["pil", "--link", target, "--damper", "in-service", "--input", str(motion), "--ticks", "400"]
        with Running(*bank, "--output", "rows.csv", "--a2l", "xcp.a2l") as running:
            a2l = running.a2l()
            names = list(a2l.measured)
            collected = Collected([daq_list(a2l, names)])
            with master(running.port, policy=collected):
                collected.setup()
                collected.run_until(400)
            report = running.end()
            rows = running.columns("rows.csv", names)
        self.assertEqual((collected.lost(), report["xcp"]["measured_ticks"]), (0, 400))
        self.assertIn("target_force_n_0", names)
        for name, column in collected.columns().items():
            # A row has the digits of single precision.
            single = [struct.unpack("<f", struct.pack("<f", number))[0] for number in rows[name]]
            self.assertTrue(column == rows[name] or list(column) == single, name)


if __name__ == "__main__":
    unittest.main()
