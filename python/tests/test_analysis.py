"""Response, verification, shim packs, modes, sheets and exports: the numbers of the command, tables, plots and refusals."""

import json
import pathlib
import pickle
import tempfile
import zipfile

import dashpot
import numpy
from common import Test, columns, command
from interruption import interrupted

SHEET = """title = "Acceptance"
[[field]]
name = "Part number"
text = "SV-25"
[[test]]
name = "one hertz"
amplitude_m = 10e-3
frequency_hz = 1
[test.limits.dynamic_stiffness_n_per_m]
nominal = 160e3
tolerance_percent = 3
"""


class Response(Test):
    def test_the_numbers_are_those_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            command("response", "--damper", "in-service", "--amplitude-m", "1e-3,5e-3", "--from-hz", "0.5", "--to-hz", "8",
                    "--points", "5", "--swept", "--output", "out.csv", folder=folder)
            told = columns(pathlib.Path(folder, "out.csv"))
        hz = numpy.array(told["frequency_hz"][:5], float)
        found = dashpot.response(dashpot.Damper("in-service"), [1e-3, 5e-3], frequency_hz=hz, swept=True)
        for kind, curves in (("harmonic", found.harmonic), ("swept", found.swept), ("linearised", found.linearised)):
            rows = [row for row, response in enumerate(told["response"]) if response == kind]
            for name in ("dynamic_stiffness_n_per_m", "loss_angle_deg", "storage_n_per_m", "loss_n_per_m", "damping_n_s_per_m"):
                expected = numpy.array([told[name][row] for row in rows], float).reshape(-1, 5)
                self.assertEqual(getattr(curves, name).tolist(), expected.tolist(), (kind, name))
        differences = [cell for cell, kind in zip(told["difference"], told["response"]) if kind == "swept"]
        self.assertEqual(found.difference.ravel().tolist(), [float(cell) for cell in differences])
        self.assertEqual(pickle.loads(pickle.dumps(found)).harmonic.loss_n_per_m.tolist(), found.harmonic.loss_n_per_m.tolist())
        self.assertEqual(len(found.plot().lines), 3)

    def test_the_defaults_are_those_of_the_command(self):
        report = json.loads(command("response", "--damper", "reduced-vertical", "--format", "json"))
        found = dashpot.response(dashpot.Damper("reduced-vertical"))
        self.assertEqual(found.amplitude_m.tolist(), [series["amplitude_m"] for series in report["series"][:3]])
        self.assertEqual(found.frequency_hz.tolist(), [row["frequency_hz"] for row in report["series"][0]["rows"]])
        self.assertIsNone(found.swept)

    def test_wrong_arguments_are_refused_and_an_interruption_ends_it(self):
        damper = dashpot.Damper("in-service")
        self.assert_refused("amplitude_m: empty, allowed: at least one amplitude", dashpot.response, damper, [])
        falling = numpy.array([2.0, 1.0])
        self.assert_refused("frequency_hz: not rising, allowed with swept=True: rising frequencies", dashpot.response, damper,
                            frequency_hz=falling, swept=True)
        with self.assertRaisesRegex(dashpot.DashpotError, "frequency"):
            dashpot.response(damper, frequency_hz=numpy.array([-1.0]))
        self.assertTrue(interrupted(dashpot.response, damper, frequency_hz=numpy.geomspace(0.1, 20, 5000)))


class Verification(Test):
    def test_the_numbers_are_those_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            time_s = numpy.arange(400) * 2e-3
            x = 5e-3 * numpy.sin(20 * time_s)
            path = pathlib.Path(folder, "run.csv")
            rows = "".join(f"{time!r},{position!r}\n" for time, position in zip(time_s.tolist(), x.tolist()))
            path.write_text("time_s,displacement_m\n" + rows)
            told = json.loads(command("verify", "--damper", "paper", "--input", path, "--step-us", 1000, "--format", "json"))
        found = dashpot.verify(dashpot.Damper("paper"), (time_s, x), step_s=1e-3)
        self.assertEqual([vars(row) for row in found], told["deviations"])
        self.assertLess(found[0].nrmse, 0.01)

    def test_the_fixed_set_is_that_of_the_command(self):
        told = json.loads(command("verify", "--damper", "reduced-vertical", "--step-us", 5000, "--format", "json"))
        found = dashpot.verify(dashpot.Damper("reduced-vertical"), step_s=5e-3)
        for row, expected in zip(found, told["errors"], strict=True):
            for name in ("nrmse_motion", "largest_error_motion"):
                expected[name] = tuple(expected[name][part] for part in ("kind", "speed_m_per_s"))
            self.assertEqual(vars(row), expected)

    def test_wrong_arguments_are_refused(self):
        damper = dashpot.Damper("paper")
        self.assert_refused("recording: 1 arrays, allowed: 2, time_s, displacement_m", dashpot.verify, damper, [numpy.zeros(3)])
        self.assert_refused("recording: no array displacement_m", dashpot.verify, damper, {"time_s": numpy.zeros(3)})
        self.assert_refused("3 times and 2 displacements, allowed: the same number of each", dashpot.verify, damper,
                            (numpy.arange(3.0), numpy.zeros(2)))
        self.assert_refused("top_speed_m_per_s: 99, allowed: above 0 and at most limits.rate_m_per_s = 2 m/s", dashpot.verify,
                            damper, top_speed_m_per_s=99)


class Shims(Test):
    def test_the_numbers_are_those_of_the_command(self):
        told = json.loads(command("shims", "--damper", "in-service", "--no-plots", "--format", "json"))
        for found, expected in zip(dashpot.shims(dashpot.Damper("in-service")), told["valves"], strict=True):
            pack = expected.pop("pack") or {}
            cw, pressures, shims_m = pack.pop("cw", None), expected.pop("pressures"), expected.pop("shims_m")
            for name, value in {**expected, **pack}.items():
                self.assertEqual(getattr(found, name), value, name)
            self.assertEqual(found.shims_m.tolist(), shims_m)
            for name, values in found.pressures.items():
                expected = [numpy.nan if row[name] is None else row[name] for row in pressures]
                numpy.testing.assert_array_equal(values, expected)
            if cw:
                self.assertEqual(found.cw["cw_m6_per_n"].tolist(), [row["cw_m6_per_n"] for row in cw])
            self.assertIn(found.valve, found._repr_html_())
            self.assertEqual(len(found.plot("flow_m3_per_s").lines), 1)

    def test_a_damper_without_valves_is_refused(self):
        self.assert_refused("a reduced damper has no shim packs; use a damper with [valves], such as `paper`", dashpot.shims,
                            dashpot.Damper("reduced-vertical"))


class Modes(Test):
    def test_the_numbers_are_those_of_the_command(self):
        damper = dashpot.Damper("in-service")
        for options, arguments in (
            ((), {}),
            (("--speed-km-h", 120, "--set", "body.mass_kg=70e3", "--rail-inclination", 0.05),
             {"speed_km_h": 120, "overrides": {"body.mass_kg": 70e3}, "contact": {"rail_inclination": 0.05}}),
        ):
            told = json.loads(command("modes", "--vehicle", "locomotive", *options, "--format", "json"))
            found = dashpot.modes("locomotive", **arguments)
            self.assertEqual((found.axle_loads_n.tolist(), found.speed_km_h), (told["axle_loads_n"], told["speed_km_h"]))
            for name, values in found.modes.items():
                self.assertEqual(list(values), [row[name] for row in told["modes"]], name)
            self.assertIn(found.modes["mode"][0], found._repr_html_())
        softer = dashpot.modes("locomotive", dampers={"vertical": damper}).modes["damping_ratio"]
        self.assertNotEqual(softer.tolist(), dashpot.modes("locomotive").modes["damping_ratio"].tolist())

    def test_wrong_arguments_are_refused(self):
        self.assert_refused("speed_km_h: 0, allowed: 1 to 700 km/h", dashpot.modes, "locomotive", speed_km_h=0)
        self.assert_refused("hunting and speed_km_h: both given, allowed: only one of them", dashpot.modes, "locomotive",
                            speed_km_h=80, hunting=True)
        self.assert_refused("friction: 3, allowed: 0 to 2", dashpot.modes, "locomotive", speed_km_h=80, friction=3)
        with self.assertRaises(dashpot.DashpotError):
            dashpot.modes("lokomotive")


class Sheet(Test):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)
        (self.folder / "sheet.toml").write_text(SHEET)
        time_s = numpy.arange(4000) * 2e-3
        w = 2 * numpy.pi
        x = 0.01 * numpy.sin(w * time_s)
        force_n = 1e5 * x + 2e4 * w * 0.01 * numpy.cos(w * time_s)
        rows = numpy.stack([time_s, 1e3 * x, force_n], 1)
        numpy.savetxt(self.folder / "bench.csv", rows, delimiter=",", header="time_s,Weg,force_n", comments="")

    def sheet(self, **options):
        return dashpot.sheet(self.folder / "sheet.toml", self.folder / "bench.csv", displacement="Weg",
                             displacement_unit="mm", **options)

    def test_the_sheet_is_that_of_the_command(self):
        options = ("sheet", "--sheet", "sheet.toml", "--input", "bench.csv", "--displacement", "Weg", "--displacement-unit", "mm",
                   "--operator", "A. Miller", "--temperature-c", "20")
        text = command(*options, folder=self.folder)
        told = json.loads(command(*options, "--page", "page.html", "--format", "json", folder=self.folder))
        found = self.sheet(operator="A. Miller", temperature_c=20)
        self.assertEqual((found.verdict, found.limits, found.title), (told["verdict"], told["limits"], told["title"]))
        self.assertEqual((found.verdict, found.is_good), ("passed", True))
        self.assertEqual(found.fields, {line["name"]: line["text"] for line in told["fields"]})
        self.assertEqual(found.recordings, told["recordings"])
        self.assertEqual(found.text, text)
        self.assertEqual(found.page.replace(str(self.folder) + "/", ""), (self.folder / "page.html").read_text())
        for test, expected in zip(found.tests, told["tests"], strict=True):
            for name, value in expected.items():
                self.assertEqual(getattr(test, name), value, name)
            self.assertAlmostEqual(test.force_n.max() / 1e3, 1.606, 2)
        self.assertIn("one hertz", found._repr_html_())
        self.assertEqual(len(found.plot().lines), 1)

    def test_a_failed_sheet_is_returned(self):
        (self.folder / "sheet.toml").write_text(SHEET.replace("160e3", "250e3"))
        found = self.sheet()
        self.assertEqual((found.verdict, found.is_good, found.limits_not_kept), ("failed", False, 1))
        self.assertEqual(found.tests[0].limits[0]["verdict"], "outside")

    def test_wrong_arguments_are_refused(self):
        self.assert_refused("recordings: empty, allowed: at least one file", dashpot.sheet, "example", [])
        self.assert_refused("temperature_c: 2 values for 1 recordings, allowed: one for all, or one for each", self.sheet,
                            temperature_c=[20, 30])
        self.assert_refused("force_uncertainty_percent: -1, allowed: 0 to 100", self.sheet, force_uncertainty_percent=-1)
        with self.assertRaises(dashpot.DashpotFileError):
            dashpot.sheet("example", self.folder / "none.csv")


class Export(Test):
    def shown(self, path):
        """Returns a file without the comments that state the command or the call."""
        calls = ("dashpot export ", "dashpot.export(", "dashpot.export_health(")
        return [line for line in path.read_text().splitlines() if not any(call in line for call in calls)]

    def assert_same(self, files, folder):
        """Asserts that the files are those of the command in another folder."""
        for file in map(pathlib.Path, files):
            told = folder / file.name
            if file.suffix == ".bin":
                self.assertEqual(file.read_bytes(), told.read_bytes())
            else:
                self.assertEqual(self.shown(file), self.shown(told))

    def test_the_files_are_those_of_the_command(self):
        damper = dashpot.Damper("in-service")
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for lang, end, standalone in (("c", ".c", False), ("c", ".c", True), ("rust", ".rs", False), ("bin", ".bin", False)):
                # The C library uses single precision.
                both = (("f32", numpy.float32), ("f64", float))
                for scalar, dtype in both[:1] if lang == "c" and not standalone else both:
                    told, mine = folder / "told" / f"x{end}", folder / "mine" / f"x{end}"
                    told.parent.mkdir(exist_ok=True)
                    mine.parent.mkdir(exist_ok=True)
                    options = ("--standalone",) if standalone else ()
                    command("export", "--damper", "in-service", "--lang", lang, "--scalar", scalar, "--step-us", 500, *options,
                            "--output", told)
                    files = dashpot.export(damper, mine, lang=lang, standalone=standalone, step_s=500e-6, dtype=dtype)
                    self.assertEqual([pathlib.Path(file).name for file in files], [mine.name, *(["x.h"] if lang == "c" else [])])
                    self.assert_same(files, told.parent)

    def test_a_health_model_is_that_of_the_command(self):
        damper = dashpot.Damper("in-service")
        noise = {"displacement_noise_m": 60e-6, "force_noise_n": 60}
        with tempfile.TemporaryDirectory() as folder:
            told, mine = pathlib.Path(folder, "told"), pathlib.Path(folder, "mine")
            told.mkdir()
            mine.mkdir()
            for lang, end in (("c", ".c"), ("rust", ".rs"), ("bin", ".bin")):
                command("export", "--damper", "in-service", "--health", "--lang", lang, "--step-us", 500, "--displacement-noise-m",
                        60e-6, "--force-noise-n", 60, "--memory-s", 2, "--output", told / f"x{end}")
                files = dashpot.export_health(damper, mine / f"x{end}", lang=lang, step_s=500e-6, memory_s=2, **noise)
                self.assertEqual(len(files), 2 if lang == "c" else 1)
                self.assert_same(files, told)
        self.assert_refused("displacement_noise_m: 0, allowed: 1e-9 to 1e-2 m", dashpot.export_health, damper, "x.c",
                            **{**noise, "displacement_noise_m": 0})
        self.assert_refused('name: `A`, but bytes have no name; allowed with lang="rust" or "c"', dashpot.export_health, damper,
                            "x.bin", lang="bin", name="A", **noise)

    def test_an_fmu_is_that_of_the_command(self):
        def contents(path):
            with zipfile.ZipFile(path) as archive:
                return {name: archive.read(name) for name in archive.namelist()}

        one, bank = dashpot.Damper("in-service"), [dashpot.Damper("paper"), dashpot.Damper("in-service")]
        with tempfile.TemporaryDirectory() as folder:
            told, mine = pathlib.Path(folder, "told.fmu"), pathlib.Path(folder, "mine.fmu")
            cases = (
                (one, {}, ("--damper", "in-service", "--fmi", 3)),
                (bank, {"fmi": 2, "dtype": float, "loadable": True, "name": "two", "step_s": 500e-6, "sources_only": True},
                 ("--damper", "paper", "--also", "in-service", "--fmi", 2, "--scalar", "f64", "--loadable", "--name", "two",
                  "--step-us", 500, "--sources-only")),
            )
            for dampers, options, words in cases:
                command("export", *words, "--output", told)
                platforms = dashpot.export_fmu(dampers, mine, **options)
                self.assertEqual(len(platforms), 0 if options else 1)
                self.assertEqual(contents(mine), contents(told))
            changed = dashpot.Damper("in-service", {"mount.clearance_m": 1e-3})
            dashpot.export_fmu(changed, mine, sources_only=True)
            self.assertIn(b"in-service, mount.clearance_m=0.001", contents(mine)["modelDescription.xml"])

    def test_wrong_arguments_of_an_fmu_are_refused(self):
        damper = dashpot.Damper("in-service")

        def export(dampers=damper, **options):
            return dashpot.export_fmu(dampers, "/nowhere/x.fmu", **options)

        self.assert_refused("fmi: 1, allowed: 2 or 3", export, fmi=1)
        self.assert_refused("dampers: empty, allowed: a damper, or a sequence of at least one", export, [])
        self.assert_refused("platforms: not with sources_only=True, which compiles for no platform", export,
                            platforms={"x86_64-windows": "cc"}, sources_only=True)
        self.assert_refused("platforms: x86_64-windows: no compiler", export, platforms={"x86_64-windows": ""})
        with self.assertRaisesRegex(dashpot.DashpotError, "platforms: unknown platform win64; allowed: a processor"):
            export(platforms={"win64": "cc"})
        with self.assertRaisesRegex(dashpot.DashpotError, "none-cc.*allowed: another C compiler with platforms={\"aarch64-linux\": "
                                    "COMPILER}, or no library with sources_only=True"):
            export(platforms={"aarch64-linux": "none-cc"})
        with self.assertRaisesRegex(dashpot.DashpotError, "FMI 2 has no folder.*allowed: fmi=3"):
            export(fmi=2, platforms={"aarch64-linux": "cc"})
        with self.assertRaises(dashpot.DashpotFileError):
            export(sources_only=True)

    def test_wrong_arguments_are_refused(self):
        damper = dashpot.Damper("in-service")
        self.assert_refused("lang: `java`, allowed: `rust`, `c` or `bin`", dashpot.export, damper, "x.java", lang="java")
        self.assert_refused('standalone: allowed only with lang="c"', dashpot.export, damper, "x.rs", lang="rust", standalone=True)
        self.assert_refused("output: the name of the header, allowed: another one, such as x.c", dashpot.export, damper, "x.h")
        with self.assertRaisesRegex(dashpot.DashpotError, "lower"):
            dashpot.export(damper, "x.c", name="lower")
        with self.assertRaises(dashpot.DashpotFileError):
            dashpot.export(damper, "/nowhere/x.c")
