"""Trends of the dampers of a fleet."""

from dataclasses import dataclass

from ._notebook import table


@dataclass(frozen=True, eq=False, repr=False)
class Fleet:
    """Trends of a fleet's dampers. `dashpot.fleet` returns it.

    `trends` has a row for each damper and parameter, the damper to look at first in front, and `readings` a row for
    each recording: dictionaries of columns, as `pandas.DataFrame` accepts them, with the names of the files that
    `dashpot health` writes with `--trends` and `--output`. `recordings_used` of the `recordings` have a place in a
    trend; the column `refused_because` of `readings` says why others have none. `text` is the report of the command.

    >>> import dashpot, numpy, pathlib, tempfile
    >>> damper, time_s = dashpot.Damper("in-service"), numpy.arange(8000) * 1e-3
    >>> x = 5e-3 * numpy.sin(8 * time_s) + 1e-3 * numpy.sin(50 * time_s)
    >>> noise = numpy.random.default_rng(1).normal(size=(2, len(x)))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     pathlib.Path(folder, "401", "rear").mkdir(parents=True)
    ...     for month in range(1, 7):
    ...         worn = damper.replace({"mount.clearance_m": 1e-3 + 1e-4 * month})
    ...         rows = numpy.stack([time_s, x + 1e-5 * noise[0], worn.build(1e-3, float).replay(x) + 20 * noise[1]], 1)
    ...         name = pathlib.Path(folder, "401", "rear", f"2026-{month:02}-01.csv")
    ...         numpy.savetxt(name, rows, delimiter=",", header="time_s,displacement_m,force_n", comments="")
    ...     found = dashpot.fleet(folder, damper)
    >>> found.recordings, found.recordings_used
    (6, 6)
    >>> row = found.trends["parameter"].index("clearance_m")
    >>> bool(abs(found.trends["rate"][row] - 12 * 1e-4) < 1e-4)
    True
    """

    vehicles: int
    dampers: int
    recordings: int
    recordings_used: int
    recordings_unreadable: int
    trends: dict
    readings: dict
    text: str

    def __repr__(self):
        return (
            f"<Fleet of {self.dampers} dampers on {self.vehicles} vehicles, {self.recordings_used} of "
            f"{self.recordings} recordings used>"
        )

    def _repr_html_(self):
        names = ("rank", "vehicle", "damper", "parameter", "value", "rate", "rate_per", "verdict", "limit_at")
        rows = zip(*(self.trends.get(name, ()) for name in names))
        return table("trends of a fleet", names, rows)
