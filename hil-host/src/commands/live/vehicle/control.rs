//! Numbers that the real-time thread shares with all others. Nobody waits for them.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use dashpot_live::Place;

use crate::commands::live::stop::Stop;

/// Numbers and wishes.
#[derive(Debug, Default)]
pub(super) struct Control {
    ticks: AtomicU64,
    distance_bits: AtomicU64,
    factor_bits: AtomicU64,
    late_ticks: AtomicU64,
    /// The emergency stop.
    pub stop: Arc<Stop>,
    /// The operator's side has failed.
    end: AtomicBool,
}

impl Control {
    /// Tells where the vehicle is.
    pub fn set_place(&self, place: Place) {
        self.ticks.store(place.tick, Ordering::Relaxed);
        let bits = place.distance_m.to_bits();
        self.distance_bits.store(bits, Ordering::Relaxed);
    }

    /// Where the vehicle is, about now.
    pub fn place(&self) -> Place {
        Place {
            tick: self.ticks.load(Ordering::Relaxed),
            distance_m: f64::from_bits(self.distance_bits.load(Ordering::Relaxed)),
        }
    }

    /// Tells how fast time goes.
    pub fn set_factor(&self, factor: f64) {
        self.factor_bits.store(factor.to_bits(), Ordering::Relaxed);
    }

    /// Factor of real time; 0 while paused.
    pub fn factor(&self) -> f64 {
        f64::from_bits(self.factor_bits.load(Ordering::Relaxed))
    }

    /// Tells how many ticks missed their deadline.
    pub fn set_late_ticks(&self, ticks: u64) {
        self.late_ticks.store(ticks, Ordering::Relaxed);
    }

    /// Ticks that missed their deadline.
    pub fn late_ticks(&self) -> u64 {
        self.late_ticks.load(Ordering::Relaxed)
    }

    /// Ends the run.
    pub fn end(&self) {
        self.end.store(true, Ordering::Relaxed);
    }

    /// True if the run has to end.
    pub fn is_ending(&self) -> bool {
        self.end.load(Ordering::Relaxed)
    }
}
