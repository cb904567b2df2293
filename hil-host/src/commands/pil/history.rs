//! History of a run for its page, with bounded memory for runs of any length.

use hdrhistogram::Histogram;

use dashpot_host_link::{Event, TickRecord};
use dashpot_report::plot::envelope::Envelope;

/// Forces of one slot (N).
#[derive(Default)]
pub(super) struct Forces {
    pub(super) target_n: Envelope,
    pub(super) host_n: Envelope,
    /// Target minus host.
    pub(super) difference_n: Envelope,
    /// True if any two forces differ.
    pub(super) differ: bool,
}

impl Forces {
    /// Largest force of the target and largest difference, in magnitude (N).
    pub(super) fn largest_n(&self) -> [f64; 2] {
        [&self.target_n, &self.difference_n].map(|envelope| {
            let values = envelope.samples().map(|(_, value)| value.abs());
            values.fold(0.0, f64::max)
        })
    }
}

/// History of a run over its ticks.
pub(super) struct History {
    start_s: f64,
    step_s: f64,
    pub(super) places: Vec<Forces>,
    pub(super) clock_ticks: Envelope,
    /// Distribution of clock ticks per tick of the bank.
    pub(super) clock_spread: Histogram<u64>,
    pub(super) round_trip_ns: Envelope,
    pub(super) faults_made: Envelope,
    pub(super) recoveries: Envelope,
}

impl History {
    /// Creates an empty history.
    pub(super) fn new(places: usize, start_s: f64, step_s: f64) -> Self {
        Self {
            start_s,
            step_s,
            places: (0..places).map(|_| Forces::default()).collect(),
            clock_ticks: Envelope::default(),
            // 32-bit counts with three digits are within the allowed bounds.
            clock_spread: Histogram::new_with_bounds(1, u64::from(u32::MAX), 3)
                .expect("constant bounds are valid"),
            round_trip_ns: Envelope::default(),
            faults_made: Envelope::default(),
            recoveries: Envelope::default(),
        }
    }

    /// Records one tick.
    pub(super) fn record(&mut self, record: &TickRecord<'_>) {
        let tick = record.tick;
        let forces = record.target_forces_n.iter().zip(record.host_forces_n);
        for (place, (target_n, host_n)) in self.places.iter_mut().zip(forces) {
            let (target, host) = (f64::from(*target_n), f64::from(*host_n));
            place.target_n.record(tick, target);
            place.host_n.record(tick, host);
            place.difference_n.record(tick, target - host);
            place.differ |= target_n.to_bits() != host_n.to_bits();
        }
        self.clock_ticks.record(tick, f64::from(record.clock_ticks));
        self.clock_spread
            .saturating_record(record.clock_ticks.into());
        // The round trip is drawn on a logarithmic scale, which has no zero.
        let round_trip_ns = record.round_trip_ns.max(1);
        self.round_trip_ns.record(tick, round_trip_ns as f64);
        if record.events.iter().any(|event| event.is_injected()) {
            self.faults_made.record(tick, 1.0);
        }
        if record.events.contains(&Event::Recovery) {
            self.recoveries.record(tick, 1.0);
        }
    }

    /// Returns the time of a tick in the recording (s).
    pub(super) fn time_s(&self, tick: u32) -> f64 {
        self.start_s + (f64::from(tick) - 1.0) * self.step_s
    }

    /// Returns the step (s).
    pub(super) fn step_s(&self) -> f64 {
        self.step_s
    }
}
