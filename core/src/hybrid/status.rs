//! Status bits of a hybrid test.

bitflags::bitflags! {
    /// Latched status bits of a hybrid test. Any bit ends the test, except [`COMMAND_LIMITED`](Self::COMMAND_LIMITED)
    /// and [`MEASUREMENT_MISSED`](Self::MEASUREMENT_MISSED).
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct HybridStatus: u16 {
        /// The command would have moved faster than its rate limit, and was limited.
        const COMMAND_LIMITED = 1;
        /// At least one tick had no valid measurement.
        const MEASUREMENT_MISSED = 1 << 1;
        /// The desired displacement, or the compensator's command, was not a number or beyond the stroke.
        const STROKE = 1 << 2;
        /// The command was limited for too long.
        const VELOCITY = 1 << 3;
        /// The measured force was beyond its limit.
        const FORCE = 1 << 4;
        /// Measured and desired displacement were too far apart for too long, or for a large part of the motion.
        const TRACKING = 1 << 5;
        /// Measured values were too old.
        const AGE = 1 << 6;
        /// A measured value jumped, was not a number, or did not change for too long while the command moved.
        const IMPLAUSIBLE = 1 << 7;
        /// The force pushed in the direction of the motion: a wrong sign, or a specimen that is driven.
        const SIGN = 1 << 8;
        /// The actuator added too much energy to the vehicle.
        const ENERGY = 1 << 9;
        /// A program asked for the end of the test.
        const REQUESTED = 1 << 10;
        /// The specimen moved far without a force worth the name: it is broken, or not connected.
        const NO_FORCE = 1 << 11;
    }
}

impl HybridStatus {
    /// The bits that end a test.
    pub const ENDING: Self = Self::all()
        .difference(Self::COMMAND_LIMITED)
        .difference(Self::MEASUREMENT_MISSED);

    /// Returns these bits if `condition` holds, else none.
    #[inline]
    pub(super) fn only_if(self, condition: bool) -> Self {
        Self::from_bits_retain(self.bits() * u16::from(condition))
    }
}
