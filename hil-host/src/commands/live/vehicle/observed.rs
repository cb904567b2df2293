//! What the threads that make frames and write the recording tell the operator's side.

use std::sync::{Mutex, MutexGuard, PoisonError};

use dashpot_live::{HealthLine, Observer};

use crate::commands::live::recorded::RecordingState;

/// Numbers and texts; none of them is touched by the real-time thread.
#[derive(Debug, Default)]
pub(super) struct Observed {
    /// The recording.
    pub recording: RecordingState,
    warnings: Mutex<Vec<String>>,
    health: Mutex<Vec<HealthLine>>,
    next: Mutex<Option<(u32, Observer)>>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Observed {
    /// Results outside the validity of the model, and what is wrong with the recording.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = lock(&self.warnings).clone();
        warnings.extend(self.recording.error());
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
