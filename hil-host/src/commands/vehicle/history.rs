//! History of a run for its page, with bounded memory for runs of any length.

use dashpot_report::plot::envelope::{Envelope, time_s};

/// Maximum number of rows kept. A longer run keeps every second, third, ... row.
const MAX_ROWS: u64 = 12_000;

/// Signals of a run: envelopes over time, which keep every peak, and rows for plots of one signal over another.
pub(super) struct History {
    names: Vec<String>,
    /// Envelope of each signal over ticks.
    envelopes: Vec<Envelope>,
    step_s: f64,
    stride: u64,
    seen: u32,
    rows: Vec<Vec<f64>>,
}

impl History {
    /// Creates an empty history of the signals with these names, for a run of `ticks` ticks.
    pub(super) fn new(names: Vec<String>, ticks: u64, step_s: f64) -> Self {
        Self {
            envelopes: names.iter().map(|_| Envelope::default()).collect(),
            names,
            step_s,
            stride: ticks.div_ceil(MAX_ROWS).max(1),
            seen: 0,
            rows: Vec::new(),
        }
    }

    /// Adds the row of one tick.
    pub(super) fn add(&mut self, row: &[f64]) {
        for (envelope, value) in self.envelopes.iter_mut().zip(row) {
            envelope.record(self.seen, *value);
        }
        if u64::from(self.seen).is_multiple_of(self.stride) {
            self.rows.push(row.to_vec());
        }
        self.seen += 1;
    }

    /// Returns the times of the first and the last tick (s).
    pub(super) fn ends_s(&self) -> [f64; 2] {
        [0, self.seen.saturating_sub(1)].map(|tick| time_s(tick, self.step_s))
    }

    fn number(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Returns points of signal `y` over signal `x`, each scaled by its factor; empty for an unknown signal.
    pub(super) fn points(&self, [x, y]: [&str; 2], [by_x, by_y]: [f64; 2]) -> Vec<(f64, f64)> {
        let (Some(x), Some(y)) = (self.number(x), self.number(y)) else {
            return Vec::new();
        };
        self.rows
            .iter()
            .map(|row| (row[x] * by_x, row[y] * by_y))
            .collect()
    }

    /// Returns points of a scaled signal over time (s): the minimum and maximum of each group of ticks. Empty for an
    /// unknown signal.
    pub(super) fn over_time(&self, name: &str, factor: f64) -> Vec<(f64, f64)> {
        let envelope = self.number(name).map(|number| &self.envelopes[number]);
        let samples = envelope.into_iter().flat_map(Envelope::samples);
        samples
            .map(|(tick, value)| (time_s(tick, self.step_s), value * factor))
            .collect()
    }
}
