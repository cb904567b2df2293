//! What the step noticed: latched bits and a counter, never errors.

/// Latched status bits of one damper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Status(u16);

impl Status {
    /// A displacement was NaN or infinite; the last good one was held.
    pub const INPUT_HELD: Self = Self(1);
    /// A displacement moved faster than the configured rate; it was followed at that rate.
    pub const INPUT_LIMITED: Self = Self(1 << 1);
    /// The element yielded: saturation force or configured force limit reached.
    pub const SATURATED: Self = Self(1 << 2);
    /// Another damper than before stepped this state; the force was carried over.
    pub const DAMPER_SWAPPED: Self = Self(1 << 3);
    /// Memory was damaged: a state that no damper made was met and started over at rest, or a slow check
    /// ([`integrity`](crate::integrity)) found constants or a state that no build and no step leaves behind.
    pub const CORRUPTED: Self = Self(1 << 4);

    /// No bit set.
    pub const fn empty() -> Self {
        Self(0)
    }

    /// The bits as a number, for a log or a link.
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// The status of `bits`, unknown ones dropped.
    pub const fn from_bits(bits: u16) -> Self {
        Self(bits & 0x1f)
    }

    /// Whether every bit of `other` is set.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// These bits where `condition` holds, without a branch.
    pub(crate) fn only_if(self, condition: bool) -> Self {
        Self(self.0 * u16::from(condition))
    }
}
