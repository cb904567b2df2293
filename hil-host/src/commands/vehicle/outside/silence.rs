//! Answers that a target does not give in time.

use serde::Serialize;

use dashpot_host_link::MissingAnswers;

/// Missing answers of a target.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Silence {
    /// Number of missing answers, in total and in a row.
    #[serde(flatten)]
    pub missing: MissingAnswers,
    /// Time of the first displacement without an answer, s.
    pub first_missing_s: Option<f64>,
    /// Time of the first displacement without an answer since the last answer, s.
    #[serde(skip)]
    pub(super) silent_since_s: Option<f64>,
}

impl Silence {
    /// Records the missing answers at the end of a tick.
    pub(super) fn update(&mut self, missing: MissingAnswers, time_s: f64) {
        let is_missing = missing.missing_answers > self.missing.missing_answers;
        self.missing = missing;
        if is_missing {
            self.first_missing_s.get_or_insert(time_s);
        }
        if missing.in_a_row == 0 {
            self.silent_since_s = None;
        } else {
            self.silent_since_s.get_or_insert(time_s);
        }
    }

    /// Records that the target was lost at `time_s`. Returns the start of its silence (s) and the number of answers
    /// missing since then, at least 1.
    pub(super) fn end(&mut self, missing: MissingAnswers, time_s: f64) -> (f64, u64) {
        self.update(missing, time_s);
        if self.missing.in_a_row == 0 {
            self.missing.missing_answers += 1;
            self.missing.in_a_row = 1;
            let most = &mut self.missing.most_missing_in_a_row;
            *most = 1.max(*most);
        }
        self.first_missing_s.get_or_insert(time_s);
        let since_s = *self.silent_since_s.get_or_insert(time_s);
        (since_s, self.missing.in_a_row)
    }

    /// Describes the missing answers; empty if there are none.
    pub(super) fn text(&self) -> String {
        let MissingAnswers {
            missing_answers,
            most_missing_in_a_row,
            ..
        } = self.missing;
        match self.first_missing_s {
            None => String::new(),
            Some(first_s) => format!(
                "; answers missing: {missing_answers}, at most {most_missing_in_a_row} in a row, the first at \
                 {first_s:.3} s; the last force was held"
            ),
        }
    }
}
