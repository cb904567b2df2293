//! State of a wheel on its rail.

/// State of a wheel on its rail, from harmless to worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Status {
    /// No patch is loaded.
    #[default]
    Lifted,
    /// The tread, the flange or both carry load.
    Rolling,
    /// The flange carries load beyond its steepest point: the wheel climbs.
    Climbing,
    /// The wheel runs on its flange tip or on the back of the flange.
    PastTip,
    /// The pose is outside the tables, and the forces are those at the nearest edge; or the penetration exceeds
    /// [`MAX_PENETRATION_M`](super::MAX_PENETRATION_M).
    OutsideTables,
    /// A field of the motion is NaN or greater than 1e9 in magnitude; the forces are zero.
    NotFinite,
}
