//! The rows of a run that its page shows.

use crate::report::plot::envelope::thin;
use crate::study::vehicle::signals::Signal;

/// Rows kept at most; of a longer run every second, third, ...
const MOST: u64 = 20_000;

/// Rows of all signals.
pub(super) struct History {
    signals: Vec<Signal>,
    stride: u64,
    seen: u64,
    rows: Vec<Vec<f64>>,
}

impl History {
    /// Of a run of so many ticks.
    pub(super) fn new(signals: Vec<Signal>, ticks: u64) -> Self {
        Self {
            signals,
            stride: ticks.div_ceil(MOST).max(1),
            seen: 0,
            rows: Vec::new(),
        }
    }

    /// Adds the row of a tick.
    pub(super) fn add(&mut self, row: &[f64]) {
        if self.seen.is_multiple_of(self.stride) {
            self.rows.push(row.to_vec());
        }
        self.seen += 1;
    }

    fn number(&self, name: &str) -> Option<usize> {
        self.signals.iter().position(|signal| signal.name() == name)
    }

    /// Points of a signal over another, each times a factor; none where there is no such signal.
    pub(super) fn points(&self, [x, y]: [&str; 2], [by_x, by_y]: [f64; 2]) -> Vec<(f64, f64)> {
        let (Some(x), Some(y)) = (self.number(x), self.number(y)) else {
            return Vec::new();
        };
        self.rows
            .iter()
            .map(|row| (row[x] * by_x, row[y] * by_y))
            .collect()
    }

    /// As [`Self::points`], thinned to the lowest and highest of each stretch of rows.
    pub(super) fn thinned(&self, names: [&str; 2], factors: [f64; 2]) -> Vec<(f64, f64)> {
        thin(&self.points(names, factors))
    }
}
