//! Why a request over the link has no result, in plain words.

use std::fmt;

use dashpot_core::link::Refusal;

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
            Self::Refused(refusal) => write!(f, "{refusal}"),
            Self::Unreadable => f.write_str("the target answers in another protocol"),
        }
    }
}

impl From<LinkError> for Failure {
    fn from(error: LinkError) -> Self {
        Self::new(error.to_string())
    }
}
