//! Errors of requests over a link.

use std::io;
use std::time::Duration;

use dashpot_core::link::{Refusal, StepSizeError};

use super::{EmulatorError, RetryLimits};

/// Errors of requests over a link.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LinkError {
    /// The line cannot be opened or has broken.
    #[error("{line}: {action}{source}")]
    Line {
        /// Name of the line.
        line: String,
        /// Failed action, as the start of the message, such as `cannot send: `; may be empty.
        action: String,
        /// Reason given by the system.
        source: io::Error,
    },
    /// The emulator behind the link failed.
    #[error(transparent)]
    Emulator(#[from] EmulatorError),
    /// The program was built without serial links.
    #[error("this build has no serial links because it lacks the feature `serial`")]
    NoSerial,
    /// The link cannot reset its target.
    #[error("this link cannot reset its target")]
    CannotReset,
    /// Resets cannot be injected because the link cannot reset its target.
    #[error("fault `reset`: this link cannot reset its target")]
    ResetFaults,
    /// The dampers of a simulated device are not all built for the same step.
    #[error(transparent)]
    StepSize(#[from] StepSizeError),
    /// A request does not fit into a frame.
    #[error("the request is too long for a frame")]
    TooLong,
    /// No try was answered.
    #[error(
        "no answer from the target to {} tries within {:.1} s; the first try waited {} ms",
        limits.tries,
        waited.as_secs_f64(),
        limits.timeout.as_millis()
    )]
    Silent {
        /// Limits for waiting and repeating.
        limits: RetryLimits,
        /// Total time of all tries.
        waited: Duration,
    },
    /// The target does not know the session: it was reset, or another program opened a session.
    #[error("the target was reset, or another program opened a session with it")]
    SessionLost,
    /// The target refused the request.
    #[error(transparent)]
    Refused(Refusal),
    /// The answer does not belong to this protocol.
    #[error("the target answers in another protocol")]
    Unreadable,
    /// The dampers of the target are not in single precision.
    #[error("the target computes in f64, but this host computes in f32")]
    DoublePrecision,
    /// The target was replaced during the run.
    #[error("the target that answers is not the one at the start")]
    OtherTarget,
}

impl LinkError {
    /// Creates an error for an `action` that failed on a line.
    pub(super) fn line(line: &str, action: &str, source: io::Error) -> Self {
        Self::Line {
            line: line.to_owned(),
            action: action.to_owned(),
            source,
        }
    }
}
