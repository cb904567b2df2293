"""Compares wheel-rail contact with the command and with known values."""

import json
import math
import pathlib
import tempfile

import dashpot
import numpy
from common import DATA, Test, command, refusal
from interruption import interrupted

PROFILES = DATA.parent / "rail" / "tests" / "data"
CONTACT = {"load_n": 106.7e3, "a_m": 6.304e-3, "b_m": 12.61e-3, "friction": 0.33}


class Contacts(Test):
    def assert_is_that_of_the_command(self, geometry, *arguments):
        told = json.loads(command("contact", "--no-plots", "--format", "json", *arguments))
        for place, row in enumerate(told["conicity"]):
            self.assertEqual(geometry.conicity["amplitude_m"][place], row["amplitude_m"])
            value = geometry.conicity["equivalent_conicity"][place]
            expected = math.nan if row["equivalent_conicity"] is None else row["equivalent_conicity"]
            numpy.testing.assert_equal(value, expected)
        self.assertEqual(geometry.force_jump, told["force_jump"])
        self.assertEqual(list(geometry.shifts), list(told["shifts"][0]))
        for place, row in enumerate(told["shifts"]):
            self.assertEqual({name: column[40 * place] for name, column in geometry.shifts.items()}, row)

    def test_geometry_is_that_of_the_command(self):
        self.assert_is_that_of_the_command(dashpot.contact())
        self.assert_is_that_of_the_command(
            dashpot.contact("S1002", PROFILES / "uic60.ban", gauge_m=1.432, inclination=0.05),
            "--rail", PROFILES / "uic60.ban", "--gauge-m", 1.432, "--inclination", 0.05,
        )

    def test_a_pair_whose_force_jumps_is_that_of_the_command(self):
        rows = (PROFILES / "s1002.csv").read_text().split("y_mm,z_mm\n")[1].split()
        points = [tuple(map(float, row.split(","))) for row in rows]
        # Waves of 10 mm and 0.15 mm worn into the tread.
        wave = [0.15 * math.sin(0.2 * math.pi * y) * (-20 <= y < 40) for y, _ in points]
        with tempfile.TemporaryDirectory() as folder:
            worn = pathlib.Path(folder, "worn.csv")
            text = "".join(f"{y},{z + by}\n" for (y, z), by in zip(points, wave))
            worn.write_text("y_mm,z_mm\n" + text)
            geometry = dashpot.contact(worn)
            self.assert_is_that_of_the_command(geometry, "--wheel", worn)
            self.assertGreater(geometry.force_jump["jump_n"], geometry.force_jump["allowed_n"])

    def test_errors_have_the_words_of_the_command(self):
        self.assert_refused(refusal("contact", "--wheel", "s1003"), dashpot.contact, "s1003")
        self.assert_refused(refusal("contact", "--wheel", "no/such.whl"), dashpot.contact, "no/such.whl")
        self.assert_refused(refusal("contact", "--gauge-m", 9), dashpot.contact, gauge_m=9)
        self.assert_refused(refusal("contact", "--wheel-mirror", "y"), dashpot.contact, wheel_mirror="y")
        self.assert_refused("smoothing_m: NaN, allowed: 0 to 0.05 m", dashpot.contact, smoothing_m=math.nan)
        with self.assertRaises(OSError):
            dashpot.contact("no/such.whl")
        for wrong in ({"wheel_format": "paper"}, {"rail_mirror": "x"}, {"wheel_radius_m": -1}, {"gauge_m": math.nan}):
            with self.assertRaises(dashpot.DashpotError):
                dashpot.contact(**wrong)

    def test_creep_forces_are_within_friction_and_oppose(self):
        creepages = numpy.random.default_rng(7).normal(0, 1e-2, (500, 3))
        forces = dashpot.creep_forces(creepages, **CONTACT)
        self.assertEqual(forces.shape, (500, 3))
        self.assertLessEqual(numpy.hypot(forces[:, 0], forces[:, 1]).max(), 0.33 * 106.7e3 * (1 + 1e-9))
        self.assertTrue((numpy.sum(forces * creepages, axis=1) <= 0).all())
        # At a very large creepage, the force is the full friction force.
        slid = dashpot.creep_forces(numpy.array([[0.5, 0.0, 0.0]]), **CONTACT)
        self.assertAlmostEqual(slid[0, 0] / (-0.33 * 106.7e3), 1, 2)
        self.assertEqual(dashpot.creep_forces(numpy.zeros((4, 3)), **CONTACT).any(), False)
        self.assertEqual(dashpot.creep_forces(numpy.empty((0, 3)), **CONTACT).shape, (0, 3))

    def test_an_interruption_ends_them(self):
        self.assertTrue(interrupted(dashpot.creep_forces, numpy.full((1_000_000, 3), 1e-3), **CONTACT))

    def test_extreme_creepages_give_finite_forces(self):
        for extreme in (1e-300, -1e300, 1e300):
            self.assertTrue(numpy.isfinite(dashpot.creep_forces(numpy.full((1, 3), extreme), **CONTACT)).all())

    def test_invalid_creepages_and_axes_are_refused(self):
        for wrong, words in ((math.nan, "NaN"), (math.inf, "inf"), (-math.inf, "-inf")):
            creepages = numpy.zeros((4, 3))
            creepages[2, 1] = wrong
            self.assert_refused(f"creepages: row 2 has {words}, allowed: finite numbers", dashpot.creep_forces, creepages,
                                **CONTACT)
        for name, wrong in (("a_m", 1e300), ("b_m", 1e-300)):
            with self.assertRaisesRegex(dashpot.DashpotError, f"^{name}: .*, allowed: 1e-6 to 1$"):
                dashpot.creep_forces(numpy.zeros((1, 3)), **{**CONTACT, name: wrong})

    def test_an_invalid_contact_is_refused(self):
        zero = numpy.zeros((1, 3))
        for name in CONTACT:
            for wrong in (0, -1, math.nan, math.inf):
                with self.assertRaisesRegex(dashpot.DashpotError, f"^{name}: .*, allowed: above 0"):
                    dashpot.creep_forces(zero, **{**CONTACT, name: wrong})
        with self.assertRaises(dashpot.DashpotError):
            dashpot.creep_forces(zero, **CONTACT, poisson_ratio=7)
        self.assert_refused("creepages: 2 columns, allowed: 3, longitudinal, lateral and spin", dashpot.creep_forces,
                            zero[:, :2].copy(), **CONTACT)
