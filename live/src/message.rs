//! Messages from the page.

use serde::Deserialize;

use crate::{Action, Choice};

/// Factors of real time that an operator may choose.
pub const FACTOR: [f64; 2] = [0.0, 100.0];

/// Largest number of ticks that one message asks for.
pub const MAX_STEPS: u32 = 10_000;

/// A message from the page.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Message {
    /// Number of the message; the answer has it too.
    #[serde(default)]
    pub id: u64,
    /// What is wanted.
    #[serde(flatten)]
    pub request: Request,
}

/// What a page wants.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case")]
pub enum Request {
    /// A run from its start.
    Start {
        /// The case.
        choice: Choice,
        /// Actions that follow by themselves, each with the number of ticks before it.
        #[serde(default)]
        actions: Vec<(u64, Action)>,
    },
    /// An action of the operator.
    Act {
        /// The action.
        action: Action,
    },
    /// Another speed of time.
    Run {
        /// Factor of real time; 0 pauses.
        factor: f64,
    },
    /// A few ticks of a paused run.
    Step {
        /// Their number.
        ticks: u32,
    },
    /// The vehicle as new beside the vehicle.
    Compare {
        /// False takes it away.
        on: bool,
    },
    /// Back to the start, without actions.
    Reset,
    /// The state as a text.
    Save,
    /// Goes on from a saved state.
    Load {
        /// The text of a saved state.
        state: String,
    },
    /// Begins or ends a recording.
    Record {
        /// False ends it.
        on: bool,
    },
    /// The recording as a file.
    Recording {
        /// `csv` or `mdf4`.
        format: String,
    },
    /// Digest of the reference run.
    Digest,
    /// Status and health.
    Status,
    /// Emergency stop.
    Stop,
}
