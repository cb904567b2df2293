//! Why a request over the link has no result, in plain words.

use std::fmt;
use std::io;

use dashpot_core::link::{PROTOCOL, Refusal};
use dashpot_core::parameters::LARGEST_CLEARANCE_M;

use super::{EmulatorError, Patience};

/// Why a request over a link has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LinkError {
    /// The line cannot be opened, or broke.
    #[error("{line}: {action}{source}")]
    Line {
        /// Name of the line.
        line: String,
        /// What failed, such as `cannot send: `; may be empty.
        action: String,
        /// The system's reason.
        source: io::Error,
    },
    /// The emulator behind the link failed.
    #[error(transparent)]
    Emulator(#[from] EmulatorError),
    /// The program was built without serial links.
    #[error("serial links are left out of this build; build dashpot-hil with the feature `serial`")]
    NoSerial,
    /// The link has no way to reset its target.
    #[error("this link cannot reset its target")]
    CannotReset,
    /// Resets are to be injected on a link that has no way to reset its target.
    #[error("fault `reset`: this link cannot reset its target")]
    ResetFaults,
    /// A request does not fit into a frame.
    #[error("a request is too long for a frame")]
    TooLong,
    /// No answer to any try.
    #[error(
        "no answer from the target to {} tries of {} ms",
        .0.tries,
        .0.timeout.as_millis()
    )]
    Silent(Patience),
    /// The target does not know the session: it was reset, or another program said hello.
    #[error("the target was reset, or another program said hello to it")]
    SessionLost,
    /// The target said no.
    #[error("{}", Sentence(*.0))]
    Refused(Refusal),
    /// An answer that does not belong to this protocol.
    #[error("the target answers in another protocol")]
    Unreadable,
    /// The target's dampers are not in single precision.
    #[error("the target steps in f64, this host in f32")]
    DoublePrecision,
    /// Another target than at the start of the run.
    #[error("another target answers than at the start")]
    OtherTarget,
}

impl LinkError {
    /// `action` failed on the line called `line`.
    pub(super) fn line(line: &str, action: &str, source: io::Error) -> Self {
        Self::Line {
            line: line.to_owned(),
            action: action.to_owned(),
            source,
        }
    }
}

/// What the target refused and what it allows.
struct Sentence(Refusal);

impl fmt::Display for Sentence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
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
            Refusal::Image => f.write_str(
                "the target refused the damper's image as damaged or of another version",
            ),
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
}
