"""Compares wheel-rail contact with the command and with known values."""

import json
import math
import pathlib
import tempfile
import warnings

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
        self.assertEqual(list(geometry.shifts), list(told["shifts"][0]))
        for place, row in enumerate(told["shifts"]):
            self.assertEqual({name: column[40 * place] for name, column in geometry.shifts.items()}, row)

    def test_geometry_is_that_of_the_command(self):
        self.assert_is_that_of_the_command(dashpot.contact())
        self.assert_is_that_of_the_command(
            dashpot.contact("S1002", PROFILES / "uic60.ban", gauge_m=1.432, inclination=0.05),
            "--rail", PROFILES / "uic60.ban", "--gauge-m", 1.432, "--inclination", 0.05,
        )

    def assert_has_rows(self, table, rows):
        """Compares a table of arrays with rows of the command, which have the same names."""
        for place, row in enumerate(rows):
            for name, value in row.items():
                if name in table and value is None:
                    self.assertTrue(numpy.isnan(table[name][place]), name)
                elif name in table:
                    self.assertEqual(table[name][place], value, name)
        self.assertEqual({column.shape for column in table.values()}, {(len(rows),)})

    def test_a_loaded_wheelset_is_that_of_the_command(self):
        loaded = dashpot.contact(
            left_wheel=PROFILES / "s1002.whl", load_n=80e3, lateral_m=[0.0, 4e-3], yaw_rad=3e-3, speed_m_per_s=20.0,
            friction=0.3,
        )
        told = json.loads(command(
            "contact", "--no-plots", "--format", "json", "--left-wheel", PROFILES / "s1002.whl", "--load-kn", 80,
            "--lateral-mm", "0,4", "--yaw-mrad", 3, "--speed-km-h", 72, "--friction", 0.3,
        ))["under_load"]
        self.assert_has_rows(loaded.elastic_conicity, told["conicity"])
        wheels = [
            {"lateral_shift_m": shift["lateral_shift_m"], "side": side, **shift[name]}
            for shift in told["shifts"] for side, name in ((-1, "left"), (1, "right"))
        ]
        self.assert_has_rows(loaded.wheels, wheels)
        patches = [{**patch, "side": wheel["side"]} for wheel in wheels for patch in wheel["patches"]]
        self.assert_has_rows(loaded.patches, patches)
        self.assertLessEqual(set(patches[0]), set(loaded.patches))
        numpy.testing.assert_allclose(loaded.wheels["vertical_force_n"], 80e3, rtol=1e-3)

    def test_without_a_load_there_are_no_patches(self):
        geometry = dashpot.contact()
        self.assertEqual((geometry.patches, geometry.wheels, geometry.elastic_conicity), (None, None, None))
        self.assert_refused("load_n: none, required with lateral_m, yaw_rad, speed_m_per_s and friction", dashpot.contact,
                            friction=0.3)
        self.assert_refused("load_n: 0, allowed: 1000 to 400000", dashpot.contact, load_n=0)
        self.assert_refused("lateral_m: 0.02, allowed: -0.012 to 0.012", dashpot.contact, load_n=1e5, lateral_m=[0.02])

    def test_a_rail_that_contains_its_inclination_is_named(self):
        rail = numpy.loadtxt(PROFILES / "uic60.csv", delimiter=",", skiprows=2)
        angle = math.atan(0.025)
        laid = rail @ numpy.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "laid.csv"
            numpy.savetxt(path, laid, fmt="%.4f")
            with self.assertWarnsRegex(UserWarning, "rail laid: .* Use inclination=0"):
                dashpot.contact(rail=path)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                conicity = dashpot.contact(rail=path, inclination=0).conicity["equivalent_conicity"]
            self.assertAlmostEqual(conicity[5], dashpot.contact().conicity["equivalent_conicity"][5], 2)

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
