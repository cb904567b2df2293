"""Health of a damper, and of the dampers of a fleet."""

import enum
from dataclasses import dataclass
from typing import NamedTuple

from ._notebook import axes_for, table


class HealthStatus(enum.IntFlag):
    """Bits of a health estimate. Alarms are latched; `DOUBTS` are the bits of an estimate that cannot be trusted.

    >>> import dashpot
    >>> dashpot.HealthStatus.CLEARANCE in dashpot.HealthStatus(5)
    True
    """

    FLOW = 1
    """Alarm: the flow at the same force, and thus the damping, has changed."""
    STIFFNESS = 2
    """Alarm: the stiffness of the mount has changed."""
    CLEARANCE = 4
    """Alarm: the clearance has changed."""
    LITTLE_EXCITATION = 8
    """There is too little motion in contact for an alarm."""
    INPUT_REJECTED = 16
    """A sample was not finite or not credible and was left out."""
    RESTARTED = 32
    """The estimate contradicted the samples for a long time and was restarted."""
    NO_FORCE = 64
    """Alarm: the damper moved, but the force is zero or does not change."""
    FORCE_ZERO = 128
    """Alarm: the force sensor has a zero offset. The estimates are corrected for it."""
    LATE = 256
    """The lag between the channels is larger than assumed, so stiffness and clearance are wrong."""
    SEVERAL_CHANGED = 512
    """Several parameters differ from the baseline; a wrong sensor is likelier than wear."""
    MISFIT = 1024
    """The model cannot explain the samples, or the estimate is still converging after a change."""
    DOUBTS = NO_FORCE | LATE | SEVERAL_CHANGED | MISFIT


class Estimate(NamedTuple):
    """An estimated value and its standard deviation.

    >>> import dashpot
    >>> dashpot.Estimate(value=1.2e-3, sd=1e-5).sd
    1e-05
    """

    value: float
    sd: float


class HealthAlarm(NamedTuple):
    """An alarm: its parameter, when it was first raised (s), and a sentence.

    >>> import dashpot
    >>> dashpot.HealthAlarm("clearance", 3.5, "clearance differs from the baseline").time_s
    3.5
    """

    parameter: str
    time_s: float
    words: str


class HealthCause(NamedTuple):
    """A possible cause of what the end of a recording shows, with its size, its probability, and a sentence.

    `kind` is a name such as `clearance` or `force_scale`; `value` is in the unit of that quantity.

    >>> import dashpot
    >>> dashpot.HealthCause("clearance", 1.2e-3, 0.98, "clearance 1.20 mm").probability
    0.98
    """

    kind: str
    value: float
    probability: float
    words: str


_ROWS = (
    ("damping over nominal", "damping_factor"),
    ("stiffness, N/m", "stiffness_n_per_m"),
    ("clearance 2a, m", "clearance_m"),
    ("lag of the force, s", "lag_s"),
    ("zero of the force sensor, N", "force_zero_n"),
    ("added friction, N", "added_friction_n"),
)


@dataclass(frozen=True, eq=False, repr=False)
class Health:
    """Health of a damper at the end of a recording. `dashpot.health` returns it.

    The quantities from `flow_factor` to `added_friction_n` are each a `dashpot.Estimate`. `samples` were used and
    `rejected` left out. `alarms` lists each alarm once; `doubts` has sentences that say why the estimates cannot be
    trusted. `causes` has the possible causes of a change, the most likely first, or is `None` with a baseline and for a
    recording that is too short to tell; `remarks` belongs to the causes. `history` has arrays over `time_s`: each
    estimate and its standard deviation (`clearance_m`, `clearance_m_sd`, ...), the bits `status`, the extremes of the
    force, and the share of the samples used.

    >>> import dashpot, numpy
    >>> damper, time_s = dashpot.Damper("in-service"), numpy.arange(8000) * 1e-3
    >>> x = 5e-3 * numpy.sin(8 * time_s) + 1e-3 * numpy.sin(50 * time_s)
    >>> force_n = damper.replace({"mount.clearance_m": 3e-3}).build(1e-3, float).replay(x)
    >>> noise = numpy.random.default_rng(1).normal(size=(2, len(x)))
    >>> found = dashpot.health(damper, (time_s, x + 1e-5 * noise[0], force_n + 20 * noise[1]))
    >>> abs(found.clearance_m.value - 3e-3) < 1e-4
    True
    >>> [alarm.parameter for alarm in found.alarms]
    ['clearance']
    """

    flow_factor: Estimate
    damping_factor: Estimate
    stiffness_n_per_m: Estimate
    clearance_m: Estimate
    lag_s: Estimate
    compliance_m_per_n: Estimate
    force_zero_n: Estimate
    added_friction_n: Estimate
    samples: int
    rejected: int
    status: HealthStatus
    is_trusted: bool
    displacement_noise_m: float
    force_noise_n: float
    alarms: list
    doubts: list
    causes: list | None
    remarks: list
    history: dict

    def __repr__(self):
        alarms = ", ".join(alarm.parameter for alarm in self.alarms) or "none"
        trust = "" if self.is_trusted else ", not trusted"
        return (
            f"Health(damping_factor={self.damping_factor.value:.3g}, clearance_m={self.clearance_m.value:.3g}, "
            f"alarms: {alarms}{trust})"
        )

    def _repr_html_(self):
        rows = [(name, *getattr(self, key)) for name, key in _ROWS]
        rows += [("alarm", alarm.words, f"{alarm.time_s:.1f} s") for alarm in self.alarms]
        rows += [("warning", doubt, "") for doubt in self.doubts]
        return table("health of a damper", ("estimate", "value", "standard deviation"), rows)

    def plot(self, quantity="clearance_m", axes=None):
        """Plots an estimate over time with a band of two standard deviations, and returns the axes, new ones by
        default. An unknown name raises `KeyError`.
        """
        time_s, value, sd = self.history["time_s"], self.history[quantity], self.history[f"{quantity}_sd"]
        axes = axes_for(axes)
        axes.plot(time_s, value)
        axes.fill_between(time_s, value - 2 * sd, value + 2 * sd, alpha=0.2)
        axes.set_xlabel("time, s")
        axes.set_ylabel(quantity)
        return axes
