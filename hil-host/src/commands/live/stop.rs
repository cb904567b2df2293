//! The emergency stop.

use std::sync::atomic::{AtomicBool, Ordering};

/// A button that anybody may press. It passes all other messages.
#[derive(Debug, Default)]
pub(super) struct Stop(AtomicBool);

impl Stop {
    /// Presses it: acts at the next tick.
    pub fn press(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// True once after each [`Self::press`].
    pub fn takes(&self) -> bool {
        // Reading first keeps the memory shared in all other ticks.
        self.0.load(Ordering::Relaxed) && self.0.swap(false, Ordering::Relaxed)
    }
}
