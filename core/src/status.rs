//! Status bits that the step latches. The step never returns errors.

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
        /// A displacement was not finite, outside the damper's range, or too far from the previous one to catch up
        /// with. The last good displacement was held.
        const INPUT_HELD = 1;
        /// The displacement changed faster than the configured rate and was followed at that rate.
        const INPUT_LIMITED = 1 << 1;
        /// The element yielded: it reached the saturation force or the configured force limit.
        const SATURATED = 1 << 2;
        /// A different damper stepped this state; the force was carried over.
        const DAMPER_SWAPPED = 1 << 3;
        /// Memory was damaged. The step found an impossible state and restarted it at rest, or a slow check
        /// ([`integrity`](crate::integrity)) found impossible constants or an impossible state.
        const CORRUPTED = 1 << 4;
        /// A displacement was too far from the previous one to catch up with. The damper restarted at this
        /// displacement, at rest and without force.
        const RESTARTED = 1 << 5;
    }
}

impl Status {
    /// Returns these bits if `condition` holds, else none, without a branch.
    pub(crate) fn only_if(self, condition: bool) -> Self {
        Self::from_bits_retain(self.bits() * u16::from(condition))
    }
}
