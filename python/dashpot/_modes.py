"""Natural modes of a vehicle."""

from dataclasses import dataclass

from ._notebook import table


@dataclass(frozen=True, eq=False, repr=False)
class Modes:
    """Modes of a vehicle. `dashpot.modes` returns it.

    `modes` has columns, as `pandas.DataFrame` accepts them: what moves (`mode`), `undamped_hz`, `damped_hz` and
    `damping_ratio`, which is negative if a mode grows. `axle_loads_n` is an array, and `speed_km_h` the speed of the
    modes, `None` at standstill. The critical speeds and the amplitude of the limit cycle, `limit_cycle_m`, are `None`
    unless `hunting` found them. `friction_elements` is the number of friction elements of the vehicle.

    >>> import dashpot
    >>> found = dashpot.modes("locomotive")
    >>> len(found.axle_loads_n), found.critical_speed_km_h
    (6, None)
    """

    vehicle: str
    axle_loads_n: object
    speed_km_h: float | None
    critical_speed_km_h: float | None
    nonlinear_critical_speed_km_h: float | None
    limit_cycle_m: float | None
    friction_elements: int
    modes: dict

    def __repr__(self):
        speed = "standstill" if self.speed_km_h is None else f"{self.speed_km_h:g} km/h"
        return f"<Modes of {self.vehicle} at {speed}: {len(self.modes['mode'])}>"

    def _repr_html_(self):
        return table(repr(self)[1:-1], tuple(self.modes), zip(*self.modes.values()))
