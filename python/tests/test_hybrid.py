"""Hybrid tests: the bits of the core through every fault, and refused settings."""

import copy
import math
import struct

import dashpot
from common import DATA, Test

LIMITS = {"stroke_m": 0.05, "velocity_m_per_s": 0.5, "force_n": 20e3}
SPAN, FAULT_AT, FAULTS = 1000, 600, 17


def desired_m(tick):
    """Arcs of a parabola to alternate sides, as in tests/support/transfer_sequence.rs."""
    part = (tick % 200) / 200.0
    arc = 0.03 * part * (1.0 - part)
    displacement_m = arc if tick // 200 % 2 == 0 else -arc
    span, at = divmod(tick, SPAN)
    if span == 8 and at >= FAULT_AT:
        return 0.06
    if span == 9 and at == FAULT_AT:
        return math.nan
    if span == 10 and at >= FAULT_AT:
        return 6.0 * displacement_m
    if span == 15 and at == FAULT_AT:
        return 1e30
    return displacement_m


def measured(tick, displacement_m, force_n, noise):
    """What is measured, with the fault of the span."""
    span, at = divmod(tick, SPAN)
    if at < FAULT_AT:
        span = 0
    return {
        1: None,
        2: (math.nan, force_n),
        3: (displacement_m, math.inf),
        4: (displacement_m, -force_n),
        5: (0.0, force_n),
        6: (-displacement_m, force_n),
        7: (displacement_m, 25e3),
        11: (1.3 * displacement_m, force_n),
        13: None if noise > 0.3 else (displacement_m + 0.01, force_n) if noise < -0.3 else (displacement_m, force_n),
        14: (1e30, -1e30) if noise > 0.4 else (displacement_m, force_n),
        16: (displacement_m, 10.0 * noise),
    }.get(span, (displacement_m, force_n))


class Digest:
    """FNV-1a of 64 bits; every NaN counts as the same."""

    def __init__(self):
        self.value = 0xCBF29CE484222325

    def add(self, data):
        for byte in data:
            self.value = (self.value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF

    def add_numbers(self, numbers):
        for number in numbers:
            self.add(b"\xff" * 4 if math.isnan(number) else struct.pack("<f", number))


class HybridTests(Test):
    def test_every_fault_has_the_bits_of_the_core(self):
        golden = (DATA.parent / "tests" / "golden" / "transfer.txt").read_text().splitlines()[1:]
        self.assertEqual([line.split("; ")[0] for line in golden], ["hold", "zero_force"])
        for action, expected in (line.split("; ") for line in golden):
            system = dashpot.TransferSystem(
                **LIMITS, compensator="adaptive", coefficients=(1.0, 0.008, 3.2e-5, 8.5e-8), delay_error_s=0.006,
                action=action, limited_s=0.02, approach_m_per_s=0.2, without_force_m=0.02,
                energy_window_s=0.3)
            motion_filter = dashpot.MotionFilter(pole_hz=40.0, step_s=1e-3)
            digest, random, reached_m, velocity_m_per_s = Digest(), 1, 0.0, 0.0
            noticed, phases = dashpot.HybridStatus(0), set()
            for tick in range(FAULTS * SPAN):
                random = (random * 1664525 + 1013904223) & 0xFFFFFFFF
                noise = (random >> 8) / 16777216.0 - 0.5
                x = desired_m(tick)
                sensed = measured(tick, reached_m + 2e-6 * noise, 20e3 * velocity_m_per_s + 20.0 * noise, noise)
                if tick == 12 * SPAN + FAULT_AT:
                    system.end()
                if math.isfinite(x):
                    motion = motion_filter.push(x)
                else:
                    motion_filter.rest_at(0.0)
                    motion = dashpot.Motion(x)
                command = system.tick(motion, sensed)
                change_m = 0.1 * (command.command_m - reached_m)
                reached_m += change_m
                velocity_m_per_s = 1000.0 * change_m
                digest.add_numbers((*motion, command.command_m, command.force_n))
                if tick % SPAN == SPAN - 1:
                    digest.add_numbers((*system.tracking, *system.energy, *system.coefficients))
                    system.clear()
                digest.add(struct.pack("<H", command.status))
                noticed |= command.status
                phases.add(system.phase)
            self.assertEqual(f"{digest.value:016x}", expected)
            self.assertEqual(noticed, dashpot.HybridStatus(4095))
            self.assertEqual(phases, {"approaching", "running", "ending", "held"})

    def test_compensators_lead_a_moving_actuator(self):
        # At a constant velocity every compensator commands the displacement one delay ahead.
        for options in ({"compensator": "polynomial", "delay_s": 0.01, "order": 2},
                        {"compensator": "inverse", "delay_s": 0.01},
                        {"compensator": "inverse", "coefficients": (1.0, 0.01, 0.0, 0.0)},
                        {"compensator": "adaptive", "delay_s": 0.01, "delay_error_s": 0.0,
                         "largest_change": (0, 0, 0, 0)},
                        {"compensator": "none"}):
            system = dashpot.TransferSystem(**LIMITS, **options, approach_m_per_s=0.4, error_m=0.5)
            for tick in range(400):
                x = 0.1e-3 * tick
                command = system.tick((x, 0.1, 0.0, 0.0), (x, 1e3 + tick))
            lead_m = 0.0 if options["compensator"] == "none" else 1e-3
            self.assertEqual(system.compensator, options["compensator"])
            self.assertEqual((system.phase, command.status), ("running", dashpot.HybridStatus(0)))
            self.assertAlmostEqual(command.command_m, x + lead_m, 5)

    def test_a_test_ends_and_starts_again(self):
        system = dashpot.TransferSystem(**LIMITS, ramp_s=0.05)
        system.place(0.01)
        first = system.tick(dashpot.Motion(0.01), dashpot.Measured(0.01, 100.0))
        self.assertEqual((first.command_m, system.phase), (struct.unpack("<f", struct.pack("<f", 0.01))[0], "running"))
        before = copy.copy(system)
        system.end()
        self.assertFalse(system.clear())
        for _ in range(100):
            command = system.tick(dashpot.Motion(0.01), (0.01, 100.0))
        self.assertEqual((system.phase, command.force_n), ("held", 0.0))
        self.assertEqual(command.status, dashpot.HybridStatus.REQUESTED)
        self.assertTrue(system.clear())
        self.assertEqual(system.status, dashpot.HybridStatus(0))
        self.assertEqual(before.phase, "running")
        self.assertEqual(copy.deepcopy(before).phase, "running")

    def test_wrong_settings_are_refused(self):
        for words, options in (
            ("guard.ramp_s = 0 is not allowed: must be 0.01 to 10", {"ramp_s": 0.0}),
            ("energy.largest_share = inf is not allowed: must be 0.01 to 100", {"energy_largest_share": math.inf}),
            ("tracking.step_s = 1 is not allowed: must be 1e-5 to 0.02", {"step_s": 1.0}),
            ("compensator: pid, allowed: none, polynomial, inverse or adaptive", {"compensator": "pid"}),
            ("action: stop, allowed: hold or zero_force", {"action": "stop"}),
            ('delay_s: compensator="none" has no such setting, allowed: none', {"delay_s": 0.01}),
            ('memory_s: compensator="polynomial" has no such setting, allowed: delay_s, order',
             {"compensator": "polynomial", "memory_s": 1.0}),
            ('delay_s: missing, which compensator="polynomial" needs', {"compensator": "polynomial"}),
            ("order: 300, allowed: 1 to 3", {"compensator": "polynomial", "delay_s": 0.01, "order": 300}),
            ('compensator="inverse" needs either delay_s or coefficients', {"compensator": "inverse"}),
            ('compensator="adaptive" needs either delay_s or coefficients',
             {"compensator": "adaptive", "delay_s": 0.01, "coefficients": (1, 0, 0, 0), "delay_error_s": 0.0}),
            ('delay_error_s: missing, which compensator="adaptive" needs',
             {"compensator": "adaptive", "delay_s": 0.01}),
            ("adaptive.change_s = 0 is not allowed: must be 0.01 to 1000",
             {"compensator": "adaptive", "delay_s": 0.01, "delay_error_s": 0.005, "change_s": 0}),
        ):
            self.assert_refused(words, dashpot.TransferSystem, **LIMITS, **options)
        self.assert_refused("motion.pole_hz = 300 is not allowed: must be 1 to a quarter of the rate of the ticks",
                            dashpot.MotionFilter, 300)
        for call in (dashpot.MotionFilter(40).rest_at, dashpot.TransferSystem(**LIMITS).place):
            self.assert_refused("displacement_m: NaN, allowed: finite numbers", call, math.nan)
        with self.assertRaises((TypeError, ValueError)):
            dashpot.TransferSystem(**LIMITS).tick((0.0, 0.0))
