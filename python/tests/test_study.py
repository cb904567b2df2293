"""Compares the rows, columns and shards of studies with the command, and with the rows of a cluster."""

import pathlib
import pickle
import tempfile

import dashpot
import pandas
from common import DATA, Test, columns, command, refusal
from interruption import interrupted

STUDY = """
name = "clearance and speed"
observed = ["body_lateral_rms_m_per_s2", "derailment_greatest", "body_vertical_rms_m_per_s2"]

[[sweep]]
name = "clearance"
case = "straight-180"
duration_s = 0.5
seeds = [1, 2]
vary = [{ parameter = "vertical.mount.clearance_m", values = [0.0, 1e-3, 3.1e-3] }]

[[sweep]]
name = "dampers"
case = "straight-180"
duration_s = 0.25
vary = [{ parameter = "vertical", values = ["paper", "in-service"] }, { parameter = "speed_km_h", values = [100] }]

[[sweep]]
name = "off the rails"
case = "curve-r300"
speed_km_h = 260
duration_s = 30
"""


def texts(row):
    """Returns a row as the command writes it."""
    def text(name, cell):
        if cell is None:
            return ""
        if name in ("sweep", "ending", "study", "version", "physics", "row_digest") or not isinstance(cell, float):
            return str(cell)
        return cell

    return {name: text(name, cell) for name, cell in row.items()}


class Studies(Test):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name, "mine.toml")
        cls.path.write_text(STUDY)
        command("sweep", "mine.toml", "--output", "told", "--no-page", folder=cls.folder.name)
        cls.rows_csv = pathlib.Path(cls.folder.name, "told", "rows.csv")
        cls.told = columns(cls.rows_csv)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def assert_is_row_of_the_command(self, row):
        self.assertEqual(list(row), list(self.told))
        for name, cell in texts(row).items():
            told = self.told[name][row["case"]]
            # At most 17 digits reproduce the bits.
            self.assertEqual(cell, float(told) if isinstance(cell, float) else told, name)

    def test_a_row_is_that_of_the_command(self):
        study = dashpot.Study(self.path)
        self.assertEqual(len(study), 9)
        self.assertEqual(study.columns, list(self.told))
        self.assertEqual(study.digest, self.told["study"][0])
        for number in (8, 0, 3, 7):
            self.assert_is_row_of_the_command(study.row(number))
        derailed = study.row(8)
        self.assertNotEqual(derailed["ending"], "completed")
        self.assertIsNone(derailed["derailment_greatest"])
        self.assertEqual(dashpot.Study.from_toml(STUDY).row(3)["body_lateral_rms_m_per_s2"], study.row(3)["body_lateral_rms_m_per_s2"])

    def test_columns_are_those_of_the_command(self):
        frame = pandas.DataFrame(dashpot.Study(self.path).run(threads=2))
        told = pandas.read_csv(self.rows_csv, float_precision="round_trip")
        self.assertEqual(list(frame), list(told))
        for name in told:
            if told[name].dtype.kind in "if":
                numbers = pandas.to_numeric(frame[name])
                pandas.testing.assert_series_equal(numbers, told[name], check_exact=True, check_dtype=False)
            else:
                self.assertEqual(frame[name].fillna("").tolist(), told[name].fillna("").tolist())

    def test_shards_together_are_all(self):
        study = dashpot.Study(self.path)
        parts = [study.run(shard=(number, 2)) for number in range(2)]
        self.assertEqual([part["case"].tolist() for part in parts], [[0, 2, 4, 6, 8], [1, 3, 5, 7]])
        whole = study.run()
        for part in parts:
            for place, case in enumerate(part["case"]):
                for name in study.columns:
                    self.assertEqual(repr(part[name][place]), repr(whole[name][case]))

    def test_a_cluster_gives_the_rows_of_the_command(self):
        from distributed import Client, LocalCluster

        study = dashpot.Study(self.path)
        with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
            with Client(cluster) as client:
                self.assertEqual(len(client.scheduler_info()["workers"]), 2)
                rows = client.gather(client.map(study.row, range(len(study))))
        self.assertEqual([row["case"] for row in rows], list(range(len(study))))
        for row in rows:
            self.assert_is_row_of_the_command(row)

    def test_a_study_with_changed_files_is_not_unpickled(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "mine.toml")
            path.write_text(STUDY)
            sent = pickle.dumps(dashpot.Study(path))
            self.assertEqual(pickle.loads(sent).digest, dashpot.Study(path).digest)
            path.write_text(STUDY.replace("3.1e-3", "3.2e-3"))
            with self.assertRaisesRegex(dashpot.DashpotError, "its files or the version of the package differ from those"):
                pickle.loads(sent)
        text = dashpot.Study.from_toml(STUDY)
        self.assertEqual(pickle.loads(pickle.dumps(text)).digest, text.digest)

    def test_an_interruption_ends_a_row(self):
        long = dashpot.Study.from_toml(STUDY.replace("duration_s = 0.5", "duration_s = 60"))
        self.assertTrue(interrupted(long.row, 0))
        # The interruption reaches several threads in the middle of their rows.
        self.assertTrue(interrupted(long.run, threads=2))

    def test_shipped_studies_are_there(self):
        for path in (DATA / "studies").glob("*.toml"):
            self.assertEqual(dashpot.Study(path.stem).digest, dashpot.Study(path).digest)
        self.assertLess(len(dashpot.Study("paper", seeds=1)), len(dashpot.Study("paper")))

    def test_errors_have_the_words_of_the_command(self):
        sweep = ("sweep", "--list")
        self.assert_refused(refusal(*sweep, "papr"), dashpot.Study, "papr")
        self.assert_refused(refusal(*sweep, "no/such.toml"), dashpot.Study, "no/such.toml")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "wrong.toml")
            for wrong in (STUDY.replace("observed = [", "observed = [\"sperling\", "), STUDY.replace("[100]", "[-3]"),
                          STUDY.replace("seeds", "sedes"), "name = 3"):
                path.write_text(wrong)
                self.assert_refused(refusal(*sweep, path), dashpot.Study, path)
        with self.assertRaises(OSError) as raised:
            dashpot.Study.from_toml(STUDY.replace("straight-180", "no/such.toml", 1))
        self.assertRegex(str(raised.exception), "^study:[0-9]+: sweep clearance: no/such.toml: cannot read: ")
        self.assertEqual(raised.exception.filename, "no/such.toml")
        study = dashpot.Study.from_toml(STUDY)
        for number in (9, -1, 2**64, -(10**30)):
            with self.assertRaisesRegex(IndexError, f"^case {number}, allowed: 0 to 8$"):
                study.row(number)
        for number, of in ((2, 2), (-1, 2), (0, -2), (2**70, 2)):
            self.assert_refused(f"shard: {number} of {of}, allowed: 0 to one less than the number of shards", study.run,
                                shard=(number, of))
        for wrong in (0, -1, 1025, 2**64):
            self.assert_refused(f"threads: {wrong}, allowed: 1 to 1024", study.run, threads=wrong)
        for wrong in (0, -1, 2**64):
            words = f"seeds: {wrong}, allowed: 1 to 100000"
            self.assert_refused(words, dashpot.Study, "paper", seeds=wrong)
            self.assert_refused(words, dashpot.Study.from_toml, STUDY, seeds=wrong)
        # Python itself refuses to print such a number.
        self.assert_refused("threads: a number with thousands of digits, allowed: 1 to 1024", study.run, threads=10**5000)
        with self.assertRaises(TypeError):
            study.row(1.0)
