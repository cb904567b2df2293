//! Why a request over the link has no result, in plain words.

use std::io;
use std::time::Duration;

use dashpot_core::link::{Refusal, StepSizeError};

use super::{EmulatorError, RetryLimits};

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
    /// The dampers of a device on the desk are not all built for one step.
    #[error(transparent)]
    StepSize(#[from] StepSizeError),
    /// A request does not fit into a frame.
    #[error("a request is too long for a frame")]
    TooLong,
    /// No answer to any try.
    #[error(
        "no answer from the target to {} tries within {:.1} s, the first wait {} ms",
        limits.tries,
        waited.as_secs_f64(),
        limits.timeout.as_millis()
    )]
    Silent {
        /// Limits of the waits.
        limits: RetryLimits,
        /// How long all tries together waited.
        waited: Duration,
    },
    /// The target does not know the session: it was reset, or another program said hello.
    #[error("the target was reset, or another program said hello to it")]
    SessionLost,
    /// The target said no.
    #[error(transparent)]
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
