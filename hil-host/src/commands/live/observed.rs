//! What the threads that make frames and write the recording tell the operator's side.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use dashpot_live::{HealthLine, Observer};

/// Numbers and texts; none of them is touched by the real-time thread.
#[derive(Debug, Default)]
pub(super) struct Observed {
    /// True while ticks go into the recording.
    pub is_recording: AtomicBool,
    /// Ticks in the files.
    pub recorded_ticks: AtomicU64,
    /// Ticks that are not in the files, because the disk was too slow or full.
    pub unrecorded_ticks: AtomicU64,
    warnings: Mutex<Vec<String>>,
    health: Mutex<Vec<HealthLine>>,
    recording_error: Mutex<Option<String>>,
    next: Mutex<Option<(u32, Observer)>>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Observed {
    /// Results outside the validity of the model, and what is wrong with the recording.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = lock(&self.warnings).clone();
        warnings.extend(self.recording_error());
        warnings
    }

    /// Health of the dampers.
    pub fn health(&self) -> Vec<HealthLine> {
        lock(&self.health).clone()
    }

    /// Takes what an observer has found so far.
    pub fn read(&self, observer: &Observer) {
        *lock(&self.warnings) = observer.warnings();
        *lock(&self.health) = observer.health();
    }

    /// Why the recording ended by itself.
    pub fn recording_error(&self) -> Option<String> {
        lock(&self.recording_error).clone()
    }

    /// Ends the recording because of an error.
    pub fn fail_recording(&self, error: String) {
        self.is_recording.store(false, Ordering::Relaxed);
        lock(&self.recording_error).get_or_insert(error);
    }

    /// Lays the observer of the next run ready, before the real-time thread starts it.
    pub fn set_next(&self, epoch: u32, observer: Observer) {
        *lock(&self.next) = Some((epoch, observer));
    }

    /// Takes the observer of a run.
    pub fn take_next(&self, epoch: u32) -> Option<Observer> {
        let next = &mut *lock(&self.next);
        let (_, observer) = next.take_if(|(of, _)| *of == epoch)?;
        Some(observer)
    }
}
