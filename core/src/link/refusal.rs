//! Why a request was not carried out.

use serde::{Deserialize, Serialize};

use super::message::{MOST_MEASURED, PROTOCOL};
use crate::encoding::ImageError;
use crate::health::HealthImageError;
use crate::parameters::Mount;

/// Why a request was not carried out; its text is for a person at the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// The frame was broken on the way; the header is not that of a request. Send again.
    #[error("the request reached the target broken")]
    Corrupt,
    /// The frame holds no request of this protocol.
    #[error("the target cannot read the request")]
    Unreadable,
    /// The device speaks this protocol.
    #[error("the target speaks version {0} of the link protocol, this host {PROTOCOL}")]
    Protocol(u16),
    /// No such session: say hello first. A device that was reset has none.
    #[error("the target knows no such session; say hello first")]
    NoSession,
    /// Expected this sequence number.
    #[error("the target expects the sequence number {0}")]
    OutOfOrder(u32),
    /// Expected this tick.
    #[error("the target expects tick {0}")]
    Tick(u32),
    /// Expected this many displacements or states.
    #[error("the target has {0} dampers; allowed: one value for each")]
    Count(u8),
    /// There is no such damper; this many are there.
    #[error("the target has {0} dampers; allowed: places 0 to {last}", last = .0.saturating_sub(1))]
    Damper(u8),
    /// Needs a rebuild on the host, then a load.
    #[error(
        "the target changes the clearance only; for other parameters build a damper on the host and load it"
    )]
    NeedsRebuild,
    /// The value is not finite or out of range.
    #[error(
        "the target refused a value as not finite or out of range; allowed: a clearance of {clearance}, \
         finite displacements, a link lost after 1 tick or more, 1 to {MOST_MEASURED} whole samples",
        clearance = Mount::RANGES.clearance_m.allowed
    )]
    Range,
    /// The image is no damper of this device.
    #[error("the target refused the damper's image: {0}")]
    Image(#[source] ImageError),
    /// The image is of a damper, or of a model of health, built for another step.
    #[error("the target refused a damper or model of health built for another step")]
    StepSize,
    /// A saved state is another damper's or damaged.
    #[error(
        "the target refused a state of another damper, or with values that no step leaves behind"
    )]
    State,
    /// Not while the tick runs free: stop first.
    #[error("the target's tick runs free; stop or reset the target first")]
    Running,
    /// Only while the tick runs free.
    #[error("the target's tick does not run free; run it first")]
    NotRunning,
    /// The link was lost: the safe output stays until run.
    #[error("the target lost the link; its outputs stay safe until it is run again")]
    LinkLost,
    /// Memory of this damper was damaged: the safe output stays until run or, where it is the constants, until the
    /// damper is loaded again and run.
    #[error(
        "memory of the damper in place {0} was damaged; the outputs stay safe until it is loaded again and run"
    )]
    Corrupted(u8),
    /// The damper in that place is not watched: load a model of health first. A device that was reset has none, and
    /// there may be places that it keeps none for.
    #[error(
        "the target does not watch the damper in that place; load a model of health, in a place that it can watch"
    )]
    NoHealth,
    /// The image is no model of health of this device.
    #[error("the target refused the model of health: {0}")]
    HealthImage(#[source] HealthImageError),
}
