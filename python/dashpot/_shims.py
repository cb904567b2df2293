"""Shim packs of a damper."""

from dataclasses import dataclass

from ._notebook import axes_for, table


@dataclass(frozen=True, eq=False, repr=False)
class Shims:
    """A valve of a damper and its shim pack. `dashpot.shims` returns one for each valve.

    `shims_m` are the thicknesses of the discs (m), which are clamped at `clamp_radius_m` and free at `free_radius_m`.
    `equivalent_thickness_m` and `edge_compliance_m_per_pa` follow from disc theory under uniform pressure, as does
    `cw`, the deflection coefficient `cw_m6_per_n` over `radius_m`; all three are `None` if the file gives the
    compliance `given_edge_compliance_m_per_pa` instead of discs. The damper model uses
    `effective_edge_compliance_m_per_pa`, which is one of the two multiplied by `equivalent_pressure_factor`, and no
    lift below `preload_pa`.

    `pressures` has columns over `pressure_pa`: `lift_m` and `flow_m3_per_s` as used, `theory_uniform_m`, and the
    published deflections, NaN except for the packs of the source paper, as `theory_over_published`.

    >>> import dashpot
    >>> valve = dashpot.shims(dashpot.Damper("in-service"))[0]
    >>> row = valve.pressures["pressure_pa"].argmax()
    >>> lifted = valve.effective_edge_compliance_m_per_pa * (10e6 - valve.preload_pa)
    >>> bool(abs(valve.pressures["lift_m"][row] / lifted - 1) < 1e-12)
    True
    """

    valve: str
    clamp_radius_m: float
    free_radius_m: float
    shims_m: object
    equivalent_thickness_m: float | None
    edge_compliance_m_per_pa: float | None
    cw: dict | None
    given_edge_compliance_m_per_pa: float | None
    equivalent_pressure_factor: float
    effective_edge_compliance_m_per_pa: float
    preload_pa: float
    theory_over_published: float | None
    pressures: dict

    def __repr__(self):
        return f"<Shims of {self.valve}: {len(self.shims_m)} discs, {self.effective_edge_compliance_m_per_pa:.3g} m/Pa>"

    def _repr_html_(self):
        return table(self.valve, tuple(self.pressures), zip(*self.pressures.values()))

    def plot(self, quantity="lift_m", axes=None):
        """Plots a column of `pressures` over the pressure with matplotlib, and returns the axes, new ones by default.
        An unknown name raises `KeyError`.
        """
        values = self.pressures[quantity]
        axes = axes_for(axes)
        axes.plot(1e-6 * self.pressures["pressure_pa"], values, label=self.valve)
        axes.set_xlabel("pressure, MPa")
        axes.set_ylabel(quantity)
        axes.legend()
        return axes
