"""Status of a damper's state."""

import enum


class Status(enum.IntFlag):
    """Bits latched since the last `State.clear_status`.

    >>> import dashpot
    >>> built = dashpot.Damper("paper").build()
    >>> state = built.at_rest(0.0)
    >>> built.step(state, float("nan"))
    0.0
    >>> state.status == dashpot.Status.INPUT_HELD
    True
    """

    INPUT_HELD = 1
    """A displacement was not finite, beyond `limits.displacement_m`, or too far from the last one to catch up with; the
    last valid displacement was held."""
    INPUT_LIMITED = 2
    """The displacement changed faster than the configured rate; the step followed it at that rate."""
    SATURATED = 4
    """The element yielded: it reached the saturation force or the configured force limit."""
    DAMPER_SWAPPED = 8
    """Another damper took over this state; the force was carried over."""
    CORRUPTED = 16
    """Memory was damaged: a step found a state that no step produces and restarted it at rest."""
    RESTARTED = 32
    """A displacement was too far from the last one to catch up with: the damper restarted at rest there, without
    force."""


Status.__module__ = "dashpot"
