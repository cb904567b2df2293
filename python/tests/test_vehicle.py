"""Compares a vehicle on a track with the command."""

import json
import math
import pathlib
import re
import tempfile
import threading

import dashpot
import numpy
import pandas
from common import DATA, Test, command, refusal
from interruption import interrupted


class Vehicles(Test):
    def test_history_and_indices_are_those_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            command("vehicle", "--case", "straight-180", "--duration-s", 1.5, "--damper", "vertical=in-service",
                    "--set", "body.mass_kg=61e3", "--set", "vertical.mount.clearance_m=2e-3", "--no-page",
                    "--output", "told", folder=folder)
            told = pandas.read_csv(pathlib.Path(folder, "told", "history.csv"), float_precision="round_trip")
            report = json.loads(pathlib.Path(folder, "told", "indices.json").read_text())
        run = dashpot.vehicle("straight-180", duration_s=1.5, dampers={"vertical": "in-service"},
                              overrides={"body.mass_kg": 61e3, "vertical.mount.clearance_m": 2e-3})
        self.assertEqual((run.ending, run.is_completed), ("completed", True))
        self.assertEqual((run.case, run.step_s), (report["case"], report["step_s"]))
        frame = pandas.DataFrame(run.history)
        self.assertEqual(frame.shape[0], 1500)
        pandas.testing.assert_frame_equal(frame, told, check_exact=True, check_dtype=False)
        self.assertEqual(run.indices, report["indices"])

    def test_a_stepped_vehicle_runs_as_a_whole_one(self):
        run = dashpot.vehicle("straight-180", duration_s=0.5)
        vehicle = dashpot.Vehicle("straight-180")
        signals = [name for name in run.history if name != "time_s" and "_filtered_" not in name]
        self.assertEqual(vehicle.outputs, signals)
        rows = numpy.concatenate([vehicle.step(200), vehicle.step(300, numpy.array([vehicle.get(name) for name in vehicle.inputs]))])
        self.assertEqual(vehicle.time_s, 0.5)
        for column, name in zip(rows.T, vehicle.outputs):
            self.assertTrue(numpy.array_equal(column, run.history[name]), name)

    def test_inputs_of_a_stepped_vehicle_act(self):
        vehicle = dashpot.Vehicle("curve-r600", outside=["front lateral damper 1"], overrides={"rails": "rigid"})
        self.assertEqual(vehicle.inputs[:3], ["front_lateral_damper_1_force_n", "speed_m_per_s", "friction_factor"])
        start, start_m = vehicle.save(), vehicle.get("distance_m")
        ahead = vehicle.step(1000)
        vehicle.restore(start)
        vehicle.set("speed_m_per_s", 0.5 * vehicle.get("speed_m_per_s"))
        vehicle.step(1000)
        at = vehicle.outputs.index("distance_m")
        self.assertAlmostEqual(vehicle.get("distance_m") - start_m, 0.5 * (ahead[-1, at] - start_m), places=9)
        vehicle.reset()
        self.assertTrue(numpy.array_equal(vehicle.step(1000), ahead))
        # A side force of 30 kN acts on the wheelsets as a whole, and a broken damper has no force.
        vehicle.reset()
        vehicle.replace_damper("front vertical damper 1", dashpot.Damper("in-service", {"mount.stiffness_n_per_m": 1e5}))
        vehicle.set("body_applied_lateral_force_n", 30e3)
        pushed = vehicle.step(1000)
        self.assertGreater(numpy.abs(pushed - ahead).max(), 1e-3)
        self.assertEqual(vehicle.step(0).shape, (0, len(vehicle.outputs)))

    def test_a_stepped_vehicle_refuses(self):
        vehicle = dashpot.Vehicle("straight-180")
        for words, call in (
            ("straight, 180 km/h: no variable `speed`", lambda: vehicle.set("speed", 3.0)),
            ("body_lateral_m is an output, allowed: inputs", lambda: vehicle.set("body_lateral_m", 0.0)),
            ("speed_m_per_s 0.5, allowed: 1 to 150", lambda: vehicle.set("speed_m_per_s", 0.5)),
            ("friction_factor NaN, allowed: 0 to 5", lambda: vehicle.set("friction_factor", math.nan)),
            ("inputs: 2 values, allowed: ", lambda: vehicle.step(1, numpy.zeros(2))),
            ("inputs: speed_m_per_s 0, allowed: 1 to 150", lambda: vehicle.step(1, numpy.zeros(len(vehicle.inputs)))),
            ("state: not the state of a vehicle of this case", lambda: vehicle.restore(b"123")),
            ("straight, 180 km/h: no damper `front damper`", lambda: vehicle.replace_damper("front damper", dashpot.Damper("paper"))),
        ):
            with self.subTest(words), self.assertRaises(dashpot.DashpotError) as raised:
                call()
            self.assertIn(words, str(raised.exception))
        self.assertEqual(vehicle.time_s, 0.0)

    def test_a_damper_in_memory_replaces_as_its_file_does(self):
        vertical = dashpot.Damper("in-service", {"mount.clearance_m": 0.0})
        # A given damper takes precedence over a preset of the same name.
        lateral = dashpot.Damper.from_toml(dashpot.Damper("reduced-lateral").to_toml(), {"mount.clearance_m": 1e-6}, "paper")
        options = {"duration_s": 1.0, "overrides": {"lateral.mount.stiffness_n_per_m": 9e6}}
        with tempfile.TemporaryDirectory() as folder:
            files = {}
            for name, damper in (("vertical", vertical), ("lateral", lateral)):
                files[name] = pathlib.Path(folder, f"{name}.toml")
                files[name].write_text(damper.to_toml())
            told = dashpot.vehicle("straight-180", dampers=files, **options)
        mixed = {"vertical": vertical, "lateral": lateral, "front vertical damper": "in-service"}
        run = dashpot.vehicle("straight-180", dampers={"vertical": vertical, "lateral": lateral}, **options)
        for name, column in told.history.items():
            self.assertTrue(numpy.array_equal(run.history[name], column), name)
        self.assertEqual(run.indices, told.indices)
        # A name takes precedence over a direction.
        named = dashpot.vehicle("straight-180", dampers=mixed, **options)
        for place in ("vertical", "lateral"):
            force = f"front_{place}_damper_1_force_n"
            self.assertFalse(numpy.array_equal(named.history[force], run.history[force]), force)
        words = f"dampers upward={vertical!r}: no damper `upward`"
        with self.assertRaisesRegex(dashpot.DashpotError, f"^{re.escape(words)}"):
            dashpot.vehicle("straight-180", dampers={"upward": vertical})
        self.assert_refused('dampers: Damper, allowed: a dictionary such as {"vertical": "in-service"}', dashpot.vehicle,
                            "straight-180", dampers=vertical)

    def test_signals_are_chosen(self):
        names = ["front_lateral_damper_1_force_n", "time_s"]
        run = dashpot.vehicle(track="straight", speed_km_h=80, duration_s=0.3, signals=names)
        self.assertEqual(list(run.history), names)
        self.assertEqual(run.history["time_s"].tolist(), [tick / 1000 for tick in range(1, 301)])
        with self.assertRaisesRegex(dashpot.DashpotError, "no signal `time`, the nearest: time_s|no signal `time`"):
            dashpot.vehicle("straight-180", signals=["time"])

    def test_an_incomplete_run_reports_its_ending(self):
        run = dashpot.vehicle("curve-r300", speed_km_h=260, duration_s=60)
        self.assertFalse(run.is_completed)
        self.assertRegex(run.ending, r"(derailed|overturned|left the tables of the contact|diverged|beyond the model).* s, .* m along the track")
        self.assertIsNone(run.indices)
        self.assertLess(len(run.history["time_s"]), 60_000)

    def test_results_beyond_the_model_are_warnings(self):
        run = dashpot.vehicle("curve-r200", signals=["time_s"])
        self.assertTrue(run.is_completed)
        lifted = [warning for warning in run.warnings if "no load for" in warning]
        self.assertTrue(lifted)
        for warning in lifted:
            self.assertRegex(warning, r"^wheelset \d, (left|right) wheel: .* from [\d.]+ s on, [-\d.]+ m along the track")
        self.assertIn(f"completed, {len(run.warnings)} warning", repr(run))
        self.assertEqual(dashpot.vehicle("curve-r600", duration_s=1.0, signals=["time_s"]).warnings, [])

    def test_errors_have_the_words_of_the_command(self):
        self.assert_refused(refusal("vehicle", "--case", "straight"), dashpot.vehicle, "straight")
        self.assert_refused(refusal("vehicle", "--case", "no/such.toml"), dashpot.vehicle, "no/such.toml")
        self.assert_refused(refusal("vehicle", "--track", "straigt", "--speed-km-h", 80), dashpot.vehicle,
                            track="straigt", speed_km_h=80)
        with self.assertRaises(OSError):
            dashpot.vehicle("no/such.toml")
        self.assert_refused("no case: give case (straight-180, curve-r200, curve-r300, curve-r600), or track with "
                            "speed_km_h", dashpot.vehicle)
        for key, value in (("speed_km_h", -1), ("duration_s", math.nan), ("duration_s", math.inf), ("step_us", 0),
                           ("friction", 7), ("push_m", 3), ("start_m", -math.inf)):
            with self.assertRaisesRegex(dashpot.DashpotError, f"^{key} .*, allowed: "):
                dashpot.vehicle("straight-180", **{key: value})
        with self.assertRaises(dashpot.DashpotError):
            dashpot.vehicle("straight-180", dampers={"upward": "paper"})
        with self.assertRaises(dashpot.DashpotError):
            dashpot.vehicle("straight-180", overrides={"body.mass": 1.0})

    def test_the_contact_is_that_of_the_command(self):
        contact = {"rail_inclination": 0.05, "gauge_m": 1.437,
                   "friction_over_distance": numpy.array([[0, 0.4, 0.4], [5, 0.4, 0.1]])}
        with tempfile.TemporaryDirectory() as folder:
            # A straight tread with a cone of 1:20 and a flange of 60 degrees.
            wheel = pathlib.Path(folder, "cone.csv")
            points = [(y, -y / 20 if y > -38 else 1.9 + math.sqrt(3) * (-38 - y)) for y in range(-50, 60)]
            points = [(y, -z if y > -38 else z) for y, z in points]
            tip = max(z for _, z in points)
            back = [(-50 - i, tip - i * i / 4) for i in range(6, 0, -1)]
            rows = [f"{y},{z}" for y, z in back + points]
            wheel.write_text("y_mm,z_mm\n" + "\n".join(rows) + "\n")
            contact["wheel"] = wheel
            command("vehicle", "--case", "curve-r300", "--duration-s", 0.5, "--no-page", "--output", "told",
                    "--rail-inclination", 0.05, "--gauge-m", 1.437, "--wheel", wheel,
                    "--set", "contact.friction_over_distance=[[0, 0.4, 0.4], [5, 0.4, 0.1]]", folder=folder)
            told = pandas.read_csv(pathlib.Path(folder, "told", "history.csv"), float_precision="round_trip")
            run = dashpot.vehicle("curve-r300", duration_s=0.5, contact=contact)
        pandas.testing.assert_frame_equal(pandas.DataFrame(run.history), told, check_exact=True, check_dtype=False)
        self.assertEqual(run.indices["nadal"]["profile"], "cone")
        self.assert_refused("contact: list, allowed: a dictionary such as {\"gauge_m\": 1.432}", dashpot.vehicle,
                            "straight-180", contact=[1])
        with self.assertRaisesRegex(dashpot.DashpotError, "contact.gauge=.*did you mean `gauge_m`"):
            dashpot.vehicle("straight-180", contact={"gauge": 1.43})
        with self.assertRaisesRegex(dashpot.DashpotError, "^contact.gauge_m: .*allowed: "):
            dashpot.vehicle("straight-180", contact={"gauge_m": 1.2})

    def test_names_may_be_paths(self):
        named = dashpot.vehicle("straight-180", duration_s=0.1, signals=["body_vertical_m"])
        path = dashpot.vehicle(DATA / "cases" / "straight-180.toml", duration_s=0.1, signals=["body_vertical_m"])
        self.assertEqual(named.history["body_vertical_m"].tobytes(), path.history["body_vertical_m"].tobytes())

    def test_an_interruption_ends_it(self):
        self.assertTrue(interrupted(dashpot.vehicle, "straight-180", duration_s=60, signals=["time_s"]))

    def test_two_threads_run_at_once(self):
        def run():
            return dashpot.vehicle("straight-180", duration_s=0.3, signals=["body_vertical_m"]).history

        expected, got = run()["body_vertical_m"], []
        threads = [threading.Thread(target=lambda: got.append(run()["body_vertical_m"])) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(all(numpy.array_equal(one, expected) for one in got) and len(got) == 2)
