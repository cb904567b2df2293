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
    last good one was held."""
    INPUT_LIMITED = 2
    """A displacement moved faster than the configured rate; it was followed at that rate."""
    SATURATED = 4
    """The element yielded: saturation force or configured force limit reached."""
    DAMPER_SWAPPED = 8
    """Another damper than before stepped this state; the force was carried over."""
    CORRUPTED = 16
    """Memory was damaged: a state that no step produces was found and restarted at rest."""
    RESTARTED = 32
    """A displacement was too far from the last one to catch up with: the damper restarted at rest there, without
    force."""


Status.__module__ = "dashpot"
