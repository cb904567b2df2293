"""Acceptance sheets from recordings of a bench."""

import html
from dataclasses import dataclass

from ._notebook import axes_for, table


@dataclass(frozen=True, eq=False, repr=False)
class SheetTest:
    """A measured test of a `dashpot.Sheet`.

    `indices` has the values by name, `half_widths` half of the 95 % interval of each, and `limits` a dictionary for
    each limit of the sheet: `index`, `value`, `half_width`, `least`, `most`, `verdict` (`within`, `undecided` or
    `outside`) and further keys. `recording`, `start_s` and `end_s` say where it was measured, in `cycles` cycles;
    `unsteady_cycles` were left out. `distortion` is the displacement about a sine, `force_change` the change of the
    force from the first to the last cycles, each as a share. `displacement_m`, `velocity_m_per_s` and `force_n` are the
    mean cycle, in steps of `step_s`.

    >>> import dashpot
    >>> "force_n" in dashpot.SheetTest.__dataclass_fields__
    True
    """

    name: str
    amplitude_m: float
    frequency_hz: float
    peak_velocity_m_per_s: float
    temperature_c: float | None
    step_s: float
    cycles: int
    indices: dict
    limits: list
    recording: str
    start_s: float
    end_s: float
    unsteady_cycles: int
    distortion: float
    force_change: float
    half_widths: dict
    displacement_m: object
    velocity_m_per_s: object
    force_n: object

    def __repr__(self):
        return f"<SheetTest '{self.name}', {self.cycles} cycles of {self.amplitude_m:g} m at {self.frequency_hz:g} Hz>"


@dataclass(frozen=True, eq=False, repr=False)
class Sheet:
    """An acceptance sheet from recordings of a bench. `dashpot.sheet` returns it.

    `verdict` is `passed`, `failed`, `undecided`, `incomplete` or `no_limits`; `is_good` is true for the first and the
    last. `tests` has a `dashpot.SheetTest` for each measured test, and `missing` the names of the others.
    `recordings` states each file with its SHA-256, `other_motions` the motions that belong to no test, and
    `unused_cycles` the cycles that belong to no steady motion. `limits` and `limits_not_kept` are numbers. `page` is
    the sheet as a self-contained HTML page, for archiving or printing, and `text` the report of the command.

    >>> import dashpot, numpy, pathlib, tempfile
    >>> time_s = numpy.arange(4000) * 2e-3
    >>> x, v = 0.01 * numpy.sin(6 * time_s), 0.06 * numpy.cos(6 * time_s)
    >>> rows = numpy.stack([time_s, x, 100e3 * x + 20e3 * v], 1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     acceptance, bench = pathlib.Path(folder, "acceptance.toml"), pathlib.Path(folder, "bench.csv")
    ...     _ = acceptance.write_text('''
    ... title = "Acceptance"
    ... [[test]]
    ... name = "slow"
    ... amplitude_m = 0.01
    ... frequency_hz = 0.955
    ... [test.limits.max_extension_force_n]
    ... nominal = 1560
    ... tolerance_percent = 5
    ... ''')
    ...     numpy.savetxt(bench, rows, delimiter=",", header="time_s,displacement_m,force_n", comments="")
    ...     found = dashpot.sheet(acceptance, bench)
    >>> found.verdict, round(found.tests[0].indices["max_extension_force_n"], -1)
    ('passed', 1560.0)
    """

    title: str
    sheet: str
    fields: dict
    verdict: str
    is_good: bool
    limits: int
    limits_not_kept: int
    warnings: list
    tests: list
    recordings: list
    missing: list
    other_motions: list
    unused_cycles: list
    text: str
    page: str

    def __repr__(self):
        return f"<Sheet '{self.title}': {self.verdict}, {self.limits_not_kept} of {self.limits} limits not kept>"

    def _repr_html_(self):
        keys = ("index", "value", "half_width", "least", "most", "verdict")
        rows = [(test.name, *(limit[key] for key in keys)) for test in self.tests for limit in test.limits]
        warnings = "".join(f"<p>{html.escape(warning)}</p>" for warning in self.warnings)
        header = ("test", "index", "value", "±", "from", "to", "verdict")
        return table(f"{self.title}: {self.verdict}", header, rows) + warnings

    def plot(self, axes=None):
        """Plots the mean loops of force over displacement with matplotlib; returns the axes, new ones by default."""
        axes = axes_for(axes)
        for test in self.tests:
            axes.plot(1e3 * test.displacement_m, 1e-3 * test.force_n, label=test.name)
        axes.set_xlabel("displacement, mm")
        axes.set_ylabel("force, kN")
        axes.legend()
        return axes
