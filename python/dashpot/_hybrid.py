"""Inputs and results of a hybrid test."""

import enum
from typing import NamedTuple


class HybridStatus(enum.IntFlag):
    """Bits latched since the last `TransferSystem.clear`. Any bit ends the test, except the first two.

    >>> import dashpot
    >>> system = dashpot.TransferSystem(stroke_m=0.1, velocity_m_per_s=1.0, force_n=20e3)
    >>> system.end()
    >>> system.status == dashpot.HybridStatus.REQUESTED
    True
    """

    COMMAND_LIMITED = 1
    """The command would have moved faster than its rate limit, and was limited."""
    MEASUREMENT_MISSED = 2
    """At least one tick had no valid measurement."""
    STROKE = 4
    """The desired displacement, or the compensator's command, was not a number or beyond the stroke."""
    VELOCITY = 8
    """The command was limited for too long."""
    FORCE = 16
    """The measured force was beyond its limit."""
    TRACKING = 32
    """Measured and desired displacement were too far apart for too long, or for a large part of the motion."""
    AGE = 64
    """Measured values were too old."""
    IMPLAUSIBLE = 128
    """A measured value jumped, was not a number, or did not change for too long while the command moved."""
    SIGN = 256
    """The force pushed in the direction of the motion: a wrong sign, or a specimen that is driven."""
    ENERGY = 512
    """The actuator added too much energy to the vehicle."""
    REQUESTED = 1024
    """`TransferSystem.end` was called."""
    NO_FORCE = 2048
    """The specimen moved far without a force worth the name: it is broken, or not connected."""


class Motion(NamedTuple):
    """Displacement of the damper's ends at a tick, positive in extension, and its derivatives.

    >>> import dashpot
    >>> dashpot.Motion(0.01).velocity_m_per_s
    0.0
    """

    displacement_m: float
    velocity_m_per_s: float = 0.0
    acceleration_m_per_s2: float = 0.0
    jerk_m_per_s3: float = 0.0


class Measured(NamedTuple):
    """Measured values of a tick: displacement, positive in extension, and force, positive when it resists extension.

    >>> import dashpot
    >>> dashpot.Measured(displacement_m=0.01, force_n=-500.0).force_n
    -500.0
    """

    displacement_m: float
    force_n: float


class Command(NamedTuple):
    """Result of a tick: command of the actuator, force for the vehicle, and status bits.

    The force is the measured one, or the last valid one; after the end of a test it fades to 0.

    >>> import dashpot
    >>> dashpot.Command(0.01, 500.0, dashpot.HybridStatus(0)).command_m
    0.01
    """

    command_m: float
    force_n: float
    status: HybridStatus


class TrackingReading(NamedTuple):
    """How well the measured displacement follows, over the fading past.

    `delay_s` is the time by which it is late, negative if it is early; `amplitude` is relative to the desired one;
    `relative_error` is relative to the root mean square of the desired displacement.

    >>> import dashpot
    >>> system = dashpot.TransferSystem(stroke_m=0.1, velocity_m_per_s=1.0, force_n=20e3)
    >>> system.tracking
    TrackingReading(delay_s=0.0, amplitude=0.0, relative_error=0.0, error_m=0.0)
    """

    delay_s: float
    amplitude: float
    relative_error: float
    error_m: float


class EnergyReading(NamedTuple):
    """Energy that the actuator has added to the vehicle since the start, and its share of the exchanged energy.

    Both are negative if the actuator took energy away; the share is over the fading past.

    >>> import dashpot
    >>> dashpot.TransferSystem(stroke_m=0.1, velocity_m_per_s=1.0, force_n=20e3).energy
    EnergyReading(added_j=0.0, added_share=0.0)
    """

    added_j: float
    added_share: float


for _class in (HybridStatus, Motion, Measured, Command, TrackingReading, EnergyReading):
    _class.__module__ = "dashpot"
del _class
