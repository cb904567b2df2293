//! What a run's page shows of its ticks, of bounded size however long the run is.

use dashpot_report::plot::envelope::{Envelope, time_s};
use dashpot_vehicle_run::signals::Signal;

/// Rows kept at most; of a longer run every second, third, ...
const MOST: u64 = 12_000;

/// Signals over time as envelopes, so that no peak vanishes; over one another as rows.
pub(super) struct History {
    signals: Vec<Signal>,
    /// Of each signal, by ticks.
    envelopes: Vec<Envelope>,
    step_s: f64,
    stride: u64,
    seen: u32,
    rows: Vec<Vec<f64>>,
}

impl History {
    /// Of a run of so many ticks.
    pub(super) fn new(signals: Vec<Signal>, ticks: u64, step_s: f64) -> Self {
        Self {
            envelopes: signals.iter().map(|_| Envelope::default()).collect(),
            signals,
            step_s,
            stride: ticks.div_ceil(MOST).max(1),
            seen: 0,
            rows: Vec::new(),
        }
    }

    /// Adds the row of a tick.
    pub(super) fn add(&mut self, row: &[f64]) {
        for (envelope, value) in self.envelopes.iter_mut().zip(row) {
            envelope.record(self.seen, *value);
        }
        if u64::from(self.seen).is_multiple_of(self.stride) {
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

    /// Points of a signal times a factor over time (s), the lowest and highest of each stretch of ticks; none where there is no
    /// such signal.
    pub(super) fn over_time(&self, name: &str, factor: f64) -> Vec<(f64, f64)> {
        let envelope = self.number(name).map(|number| &self.envelopes[number]);
        let samples = envelope.into_iter().flat_map(Envelope::samples);
        samples
            .map(|(tick, value)| (time_s(tick, self.step_s), value * factor))
            .collect()
    }
}
