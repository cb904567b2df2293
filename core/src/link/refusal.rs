//! Reasons for refusing a request.

use serde::{Deserialize, Serialize};

use super::limits::{MAX_MEASURED, PROTOCOL};
use crate::encoding::ImageError;
use crate::health::HealthImageError;
use crate::parameters::Mount;

/// Reason for refusing a request. The text is for the user at the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// The frame was corrupt. The header of this response is not that of the request. Send the request again.
    #[error("the request was corrupted on its way to the target")]
    Corrupt,
    /// The frame contains no request of this protocol.
    #[error("the target cannot read the request")]
    Unreadable,
    /// The device uses this version of the protocol.
    #[error(
        "the target speaks version {0} of the link protocol, but this host speaks version {PROTOCOL}"
    )]
    Protocol(u16),
    /// The session is not open: send a hello first. A device has no session after a reset.
    #[error("the target knows no such session; say hello first")]
    NoSession,
    /// This sequence number was expected.
    #[error("the target expects the sequence number {0}")]
    OutOfOrder(u32),
    /// This tick was expected.
    #[error("the target expects tick {0}")]
    Tick(u32),
    /// This number of displacements or states was expected.
    #[error("the target has {0} dampers; allowed: one value for each")]
    Count(u8),
    /// The index is out of range; the device has this many dampers.
    #[error("the target has {0} dampers; allowed: 0 to {last}", last = .0.saturating_sub(1))]
    Damper(u8),
    /// For this change, the host must build the damper again and load it.
    #[error(
        "the target can change only the clearance; for other parameters build a damper on the host and load it"
    )]
    NeedsRebuild,
    /// A value is not finite or is out of range.
    #[error(
        "the target refused a value that is not finite or out of range; allowed: a clearance of {clearance}, \
         finite displacements, a loss of link after 1 tick or more, 1 to {MAX_MEASURED} whole samples",
        clearance = Mount::RANGES.clearance_m.allowed
    )]
    Range,
    /// The image is not a valid damper for this device.
    #[error("the target refused the damper's image: {0}")]
    Image(#[source] ImageError),
    /// The image is a damper or a health model for another step size.
    #[error("the target refused a damper or health model built for another step")]
    StepSize,
    /// A saved state belongs to another damper or is damaged.
    #[error(
        "the target refused a state: it belongs to another damper, or has values that no step produces"
    )]
    State,
    /// The device is free-running; stop it first.
    #[error("the target is free-running; stop it first")]
    Running,
    /// The device is not free-running.
    #[error("the target is not free-running; run it first")]
    NotRunning,
    /// The link was lost. The safe outputs remain until the next run.
    #[error("the target lost the link; its outputs stay safe until you run it again")]
    LinkLost,
    /// Memory of this damper was damaged. The safe outputs remain until the next run. Load damaged constants again
    /// before that run.
    #[error(
        "the memory of damper {0} was damaged; the outputs stay safe until you load the damper again and run the target"
    )]
    Corrupted(u8),
    /// The damper is not watched: load a health model first. A device has no models after a reset, and may have room
    /// for fewer models than dampers.
    #[error(
        "the target does not watch this damper; load a health model for a damper that it can watch"
    )]
    NoHealth,
    /// The image is not a valid health model for this device.
    #[error("the target refused the health model: {0}")]
    HealthImage(#[source] HealthImageError),
}
