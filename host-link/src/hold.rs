//! Use of the last forces in real time, while a target does not answer.

use std::time::Duration;

use serde::Serialize;

use super::SessionError;

/// Limits for a target that does not answer: the wait in a tick, and the number of ticks that use the last forces.
///
/// The first tick without an answer waits for [`Self::answer_wait`]; each further one only until its deadline, so that
/// the run stays in real time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Hold {
    /// Longest wait for the answer to a step.
    pub answer_wait: Duration,
    /// Largest number of answers that may be missing in a row.
    pub max_missing_in_a_row: u64,
}

impl Hold {
    /// Creates the limits.
    pub const fn new(answer_wait: Duration, max_missing_in_a_row: u64) -> Self {
        Self {
            answer_wait,
            max_missing_in_a_row,
        }
    }
}

/// Steps whose answers did not come in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct MissingAnswers {
    /// Number of missing answers.
    pub missing_answers: u64,
    /// Largest number of missing answers in a row.
    pub most_missing_in_a_row: u64,
    /// Number of missing answers since the last answer.
    #[serde(skip)]
    pub in_a_row: u64,
}

impl MissingAnswers {
    /// Counts an answer.
    pub(super) fn answered(&mut self) {
        self.in_a_row = 0;
    }

    /// Counts a missing answer to the step of `tick`.
    ///
    /// # Errors
    /// More answers in a row are missing than `hold` allows.
    pub(super) fn missed(&mut self, tick: u32, hold: &Hold) -> Result<(), SessionError> {
        self.missing_answers += 1;
        self.in_a_row += 1;
        self.most_missing_in_a_row = self.most_missing_in_a_row.max(self.in_a_row);
        if self.in_a_row > hold.max_missing_in_a_row {
            return Err(SessionError::Unanswered {
                tick: u64::from(tick).saturating_sub(self.in_a_row),
                missing: self.in_a_row,
                allowed: hold.max_missing_in_a_row,
            });
        }
        Ok(())
    }
}
