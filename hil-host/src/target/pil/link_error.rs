//! Why a request over the link has no result, in plain words.

use std::fmt;

use dashpot_core::link::{PROTOCOL, Refusal};
use dashpot_core::parameters::LARGEST_CLEARANCE_M;

use super::Patience;
use crate::error::Failure;

/// Why a request has no result.
#[derive(Clone, Debug, PartialEq)]
pub enum LinkError {
    /// The line itself failed.
    Broken(Failure),
    /// No answer to any try.
    Silent(Patience),
    /// The target does not know the session: it was reset, or another program said hello.
    SessionLost,
    /// The target said no.
    Refused(Refusal),
    /// An answer that is none of this protocol.
    Unreadable,
}

impl fmt::Display for LinkError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Broken(failure) => write!(f, "{failure}"),
            Self::Silent(patience) => write!(
                f,
                "no answer from the target to {} tries of {} ms",
                patience.tries,
                patience.timeout.as_millis()
            ),
            Self::SessionLost => {
                f.write_str("the target was reset, or another program said hello to it")
            }
            Self::Refused(refusal) => explain(*refusal, f),
            Self::Unreadable => f.write_str("the target answers in another protocol"),
        }
    }
}

/// What the target refused and what it allows.
fn explain(refusal: Refusal, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    match refusal {
        Refusal::Corrupt => f.write_str("the request reached the target broken"),
        Refusal::Unreadable => f.write_str("the target cannot read the request"),
        Refusal::Protocol(version) => write!(
            f,
            "the target speaks version {version} of the link protocol, this host {PROTOCOL}"
        ),
        Refusal::NoSession => f.write_str("the target knows no such session; say hello first"),
        Refusal::OutOfOrder(expected) => {
            write!(f, "the target expects the sequence number {expected}")
        }
        Refusal::Tick(expected) => write!(f, "the target expects tick {expected}"),
        Refusal::Count(dampers) => write!(
            f,
            "the target has {dampers} dampers; allowed: one value for each"
        ),
        Refusal::Damper(dampers) => write!(
            f,
            "the target has {dampers} dampers; allowed: places 0 to {}",
            dampers.saturating_sub(1)
        ),
        Refusal::NeedsRebuild => f.write_str(
            "the target changes the clearance only; for other parameters build a damper on the \
             host and load it",
        ),
        Refusal::Range => write!(
            f,
            "the target refused a value as not finite or out of range; allowed: a clearance of 0 \
             to {LARGEST_CLEARANCE_M} m, finite displacements, a link lost after 1 tick or more"
        ),
        Refusal::ImageBytes(bytes) => {
            write!(f, "the target takes images of {bytes} bytes only")
        }
        Refusal::Image => {
            f.write_str("the target refused the damper's image as damaged or of another version")
        }
        Refusal::StepSize => f.write_str("the target refused a damper built for another step"),
        Refusal::State => f.write_str(
            "the target refused a state of another damper, or with values that no step leaves \
             behind",
        ),
        Refusal::Running => {
            f.write_str("the target's tick runs free; stop or reset the target first")
        }
        Refusal::NotRunning => f.write_str("the target's tick does not run free; run it first"),
        Refusal::LinkLost => {
            f.write_str("the target lost the link; its outputs stay safe until it is run again")
        }
        Refusal::Corrupted(place) => write!(
            f,
            "memory of the damper in place {place} was damaged; the outputs stay safe until it is \
             loaded again and run"
        ),
    }
}

impl From<LinkError> for Failure {
    fn from(error: LinkError) -> Self {
        Self::new(error.to_string())
    }
}
