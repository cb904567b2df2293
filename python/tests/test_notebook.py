"""Tables and plots in notebooks, and the example notebook."""

import json
import sys
import unittest
from unittest import mock

import dashpot
import matplotlib
import numpy
from common import DATA

matplotlib.use("Agg")


class Tables(unittest.TestCase):
    def test_a_damper_shows_every_key_with_its_value(self):
        damper = dashpot.Damper("paper", {"mount.clearance_m": 1.25e-3})
        table = damper._repr_html_()
        self.assertEqual(table.count("<td>"), 2 * len(damper))
        self.assertIn("<td>mount.clearance_m</td><td>0.00125</td>", table)

    def test_a_bench_test_shows_its_indices(self):
        cycle = dashpot.Damper("reduced-vertical").rig(1e-3, 1.0)
        self.assertEqual(cycle._repr_html_().count("<td>"), 2 * len(cycle.indices))

    def test_names_are_escaped(self):
        text = dashpot.Damper("paper").to_toml()
        self.assertIn("<caption>&lt;b&gt;</caption>", dashpot.Damper.from_toml(text, name="<b>")._repr_html_())

    def test_a_calibration_shows_values_and_intervals(self):
        key = "reduced.damping_n_s_per_m"
        made = dashpot.Damper("reduced-vertical", {"mount.clearance_m": 0.0})
        time_s = numpy.arange(4000) * 1e-3
        x = 4e-3 * numpy.sin(2 * numpy.pi * time_s)
        force_n = made.build(1e-3, float).replay(x) + numpy.random.default_rng(1).normal(0, 10, len(x))
        found = dashpot.calibrate(made, [(time_s, x, force_n)], [key], step_s=1e-3, starts=1)
        low, high = found.intervals[key]
        self.assertIn(f"<td>{key}</td><td>{found.values[key]:.6g}</td><td>{low:.6g}</td><td>{high:.6g}</td>",
                      found._repr_html_())

    def test_a_run_shows_its_ending(self):
        run = dashpot.vehicle("straight-180", duration_s=0.1, signals=["time_s"])
        self.assertIn(f"<td>ending</td><td>{run.ending}</td></tr><tr><td>ticks</td><td>100</td>", run._repr_html_())


class Example(unittest.TestCase):
    def test_every_cell_of_the_notebook_runs(self):
        notebook = json.loads((DATA.parent / "python/examples/worn_damper.ipynb").read_text())
        self.assertEqual(notebook["nbformat"], 4)
        cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
        space = {}
        for number, cell in enumerate(cells):
            exec(compile(cell, f"worn_damper.ipynb, code cell {number}", "exec"), space)
        self.assertTrue(space["run"].is_completed)
        self.assertEqual(len(space["axes"].lines), 2)


class Plots(unittest.TestCase):
    def tearDown(self):
        from matplotlib import pyplot

        pyplot.close("all")

    def test_a_loop_has_its_values_in_millimetres_and_kilonewtons(self):
        cycle = dashpot.Damper("reduced-vertical").rig(1e-3, 1.0)
        (line,) = cycle.plot().lines
        self.assertTrue(numpy.array_equal(line.get_xdata(), 1e3 * cycle.displacement_m))
        self.assertTrue(numpy.array_equal(line.get_ydata(), 1e-3 * cycle.force_n))

    def test_axes_may_be_given(self):
        from matplotlib import pyplot

        axes = pyplot.subplots()[1]
        cycle = dashpot.Damper("reduced-vertical").rig(1e-3, 1.0)
        self.assertIs(cycle.plot(axes), axes)

    def test_a_run_draws_the_named_signals_or_all(self):
        names = ["time_s", "body_vertical_acceleration_m_per_s2", "body_lateral_acceleration_m_per_s2"]
        run = dashpot.vehicle("straight-180", duration_s=0.1, signals=names)
        self.assertEqual([line.get_label() for line in run.plot().lines], names[1:])
        (line,) = run.plot(names[2]).lines
        self.assertTrue(numpy.array_equal(line.get_ydata(), run.history[names[2]]))
        with self.assertRaises(KeyError):
            run.plot("speed")

    def test_without_matplotlib_the_error_names_the_remedy(self):
        cycle = dashpot.Damper("reduced-vertical").rig(1e-3, 1.0)
        with mock.patch.dict(sys.modules, {"matplotlib": None}), self.assertRaisesRegex(ImportError, "pip install"):
            cycle.plot()
