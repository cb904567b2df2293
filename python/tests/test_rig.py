"""Bench test, characteristic and reference."""

import json
import math
import pathlib
import tempfile

import dashpot
import numpy
from common import Test, command, refusal
from interruption import interrupted


class Rig(Test):
    def test_indices_are_those_of_the_command(self):
        for name in ("paper", "in-service"):
            told = json.loads(command("rig", "--damper", name, "--amplitude-m", 5e-3, "--frequency-hz", 2,
                                      "--format", "json"))
            cycle = dashpot.Damper(name).rig(amplitude_m=5e-3, frequency_hz=2)
            self.assertEqual((cycle.step_s, cycle.cycles), (told["step_s"], told["cycles"]))
            indices = dashpot.Damper(name).indices(5e-3, 2)
            self.assertEqual(indices, cycle.indices)
            # The command's other values describe the test.
            others = {"damper", "amplitude_m", "frequency_hz", "peak_velocity_m_per_s", "step_s", "cycles", "published", "plots"}
            self.assertEqual(told.keys() - others, told.keys() & indices.keys())
            self.assertEqual({key: indices[key] for key in told.keys() - others},
                             {key: told[key] for key in told.keys() - others})

    def test_indices_are_all_those_of_a_sheet(self):
        with tempfile.TemporaryDirectory() as folder:
            sheet = pathlib.Path(folder, "sheet.toml")
            sheet.write_text('title = "one"\n[[test]]\nname = "one"\namplitude_m = 5e-3\nfrequency_hz = 2\n')
            told = json.loads(command("rig", "--damper", "in-service", "--sheet", sheet, "--format", "json"))
        indices = dashpot.Damper("in-service").indices(5e-3, 2)
        self.assertEqual(list(indices.items()), list(told["tests"][0]["indices"].items()))

    def test_a_spring_and_a_damper_in_series_are_the_closed_form(self):
        # C in series with K: the force amplitude is C w A/sqrt(1 + (w C/K)^2); the energy per cycle is pi A times the component in phase with the velocity.
        damper = dashpot.Damper("reduced-vertical", {"mount.clearance_m": 0})
        (c, k), (a, w) = (damper["reduced.damping_n_s_per_m"], damper["mount.stiffness_n_per_m"]), (1e-3, 2 * math.pi)
        indices = damper.indices(a, 1.0)
        force_n = c * w * a / math.hypot(1, w * c / k)
        self.assertAlmostEqual(indices["max_extension_force_n"] / force_n, 1, 4)
        energy_j = math.pi * a * force_n / math.hypot(1, w * c / k)
        self.assertAlmostEqual(indices["energy_per_cycle_j"] / energy_j, 1, 4)
        self.assertAlmostEqual(indices["loss_angle_deg"], math.degrees(math.atan2(k, w * c)), 2)

    def test_a_cycle_follows_its_motion(self):
        cycle = dashpot.Damper("paper").rig(24.875e-3, 0.64)
        self.assertAlmostEqual(cycle.displacement_m.max(), 24.875e-3, 9)
        self.assertAlmostEqual(cycle.velocity_m_per_s.max(), 0.1, 3)
        area = numpy.sum(cycle.force_n * cycle.velocity_m_per_s) * cycle.step_s
        self.assertAlmostEqual(area / cycle.indices["energy_per_cycle_j"], 1, 3)

    def test_no_force_has_no_asymmetry(self):
        wide = dashpot.Damper("paper", {"mount.clearance_m": 0.1})
        self.assertIsNone(wide.indices(1e-3, 1.0)["asymmetry_rate"])

    def test_invalid_motions_are_refused(self):
        damper = dashpot.Damper("paper")
        for amplitude_m, frequency_hz in ((0, 1), (-1, 1), (2, 1), (math.nan, 1)):
            with self.assertRaisesRegex(dashpot.DashpotError, "^amplitude: "):
                damper.rig(amplitude_m, frequency_hz)
        for frequency_hz in (0, -1, 1e9, math.nan, math.inf):
            with self.assertRaisesRegex(dashpot.DashpotError, "^frequency: "):
                damper.rig(1e-3, frequency_hz)
        words = refusal("rig", "--damper", "paper", "--amplitude-m", 0.9, "--frequency-hz", 9)
        self.assert_refused(words, damper.rig, 0.9, 9)
        for step_s in (0, -1, math.nan, 1):
            with self.assertRaises(dashpot.DashpotError):
                damper.rig(1e-3, 1, step_s)

    def test_an_interruption_ends_it(self):
        damper = dashpot.Damper("paper")
        self.assertTrue(interrupted(damper.rig, 1e-3, 1e-3))
        self.assertTrue(interrupted(damper.indices, 1e-3, 1e-3))
        x = 5e-3 * numpy.sin(numpy.arange(200_000) / 80)
        self.assertTrue(interrupted(damper.reference, x, 1e-3))

    def test_the_characteristic_is_the_law(self):
        reduced = dashpot.Damper("reduced-lateral")
        v = numpy.linspace(-0.2, 0.2, 41)
        limit = reduced["reduced.saturation_velocity_m_per_s"]
        expected = reduced["reduced.damping_n_s_per_m"] * numpy.clip(v, -limit, limit)
        numpy.testing.assert_allclose(reduced.characteristic(v), expected, rtol=1e-14, atol=1e-9)
        force_n = dashpot.Damper("in-service").characteristic(v)
        self.assertTrue((numpy.diff(force_n) > 0).all())
        for wrong in (math.nan, math.inf):
            with self.assertRaises(dashpot.DashpotError):
                reduced.characteristic(numpy.array([wrong]))

    def test_the_step_is_within_its_promise_of_the_reference(self):
        damper = dashpot.Damper("in-service")
        x = 5e-3 * numpy.sin(2 * math.pi * 2 * numpy.arange(1000) * 1e-3)
        reference = damper.reference(x, 1e-3)
        for dtype in (numpy.float32, numpy.float64):
            error = damper.build(1e-3, dtype).replay(x.astype(dtype)) - reference
            self.assertLess(numpy.sqrt(numpy.mean(error**2) / numpy.mean(reference**2)), 0.02)
        for wrong in (numpy.array([0, math.nan]), numpy.empty(0)):
            with self.assertRaises(dashpot.DashpotError):
                damper.reference(wrong, 1e-3)
        for step_s in (0, -1e-3, math.nan):
            with self.assertRaises(dashpot.DashpotError):
                damper.reference(x, step_s)
