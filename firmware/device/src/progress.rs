//! Progress of ticks and link, for a watchdog.

use core::sync::atomic::{AtomicU32, Ordering};

/// Counts of what the server has done. A watchdog is fed only while both rise.
#[derive(Debug, Default)]
pub struct Progress {
    ticks: AtomicU32,
    link: AtomicU32,
}

impl Progress {
    /// Nothing is done yet.
    pub const fn new() -> Self {
        Self {
            ticks: AtomicU32::new(0),
            link: AtomicU32::new(0),
        }
    }

    pub(crate) fn ran_ticks(&self) {
        self.ticks.fetch_add(1, Ordering::Relaxed);
    }

    /// Bytes were moved, or no byte had to be: a silent host is no fault of the board.
    pub(crate) fn link_alive(&self) {
        self.link.fetch_add(1, Ordering::Relaxed);
    }

    fn counts(&self) -> [u32; 2] {
        [&self.ticks, &self.link].map(|count| count.load(Ordering::Relaxed))
    }
}

/// Tells whether ticks and link both made progress since the last check.
///
/// ```
/// use dashpot_device::{Progress, ProgressCheck};
///
/// static PROGRESS: Progress = Progress::new();
/// let mut check = ProgressCheck::default();
/// assert!(!check.both_moved(&PROGRESS)); // no server runs: do not feed the watchdog
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct ProgressCheck([u32; 2]);

impl ProgressCheck {
    /// Returns true if both counts moved since the last call that returned true.
    pub fn both_moved(&mut self, progress: &Progress) -> bool {
        let counts = progress.counts();
        let moved = counts
            .iter()
            .zip(&self.0)
            .all(|(now, before)| now != before);
        if moved {
            self.0 = counts;
        }
        moved
    }
}
