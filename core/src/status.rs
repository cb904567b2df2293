//! What the step noticed: latched bits and a counter, never errors.

bitflags::bitflags! {
    /// Latched status bits of one damper.
    ///
    /// ```
    /// use dashpot_core::Status;
    ///
    /// let status = Status::from_bits_truncate(5);
    /// assert_eq!(status, Status::INPUT_HELD | Status::SATURATED);
    /// ```
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct Status: u16 {
        /// A displacement was not finite, beyond the damper's range of displacement, or too far from the last one to
        /// catch up with; the last good one was held.
        const INPUT_HELD = 1;
        /// A displacement moved faster than the configured rate; it was followed at that rate.
        const INPUT_LIMITED = 1 << 1;
        /// The element yielded: saturation force or configured force limit reached.
        const SATURATED = 1 << 2;
        /// Another damper than before stepped this state; the force was carried over.
        const DAMPER_SWAPPED = 1 << 3;
        /// Memory was damaged: a state that no step leaves behind was met and started over at rest, or a slow check
        /// ([`integrity`](crate::integrity)) found constants or a state that no build and no step leaves behind.
        const CORRUPTED = 1 << 4;
        /// A displacement was too far from the last one to catch up with: the damper restarted at rest there, without
        /// force.
        const RESTARTED = 1 << 5;
    }
}

impl Status {
    /// These bits where `condition` holds, without a branch.
    pub(crate) fn only_if(self, condition: bool) -> Self {
        Self::from_bits_retain(self.bits() * u16::from(condition))
    }
}
