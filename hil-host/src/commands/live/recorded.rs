//! What is known about a recording while it grows, and in the end.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use serde::Serialize;

use crate::commands::counted;

/// State of a recording.
#[derive(Debug, Default)]
pub(super) struct RecordingState {
    is_on: AtomicBool,
    ticks: AtomicU64,
    unrecorded_ticks: AtomicU64,
    error: Mutex<Option<String>>,
}

impl RecordingState {
    /// True while ticks go into the recording.
    pub fn is_on(&self) -> bool {
        self.is_on.load(Ordering::Relaxed)
    }

    /// Begins, interrupts or continues it.
    pub fn turn(&self, on: bool) {
        self.is_on.store(on, Ordering::Relaxed);
    }

    /// What the operator wants, if it is possible.
    ///
    /// # Errors
    /// There is no file to record to, or it cannot be written.
    pub fn operate(&self, on: bool, has_file: bool) -> Result<(), String> {
        if !has_file {
            return Err(
                "there is no file to record to: start dashpot live with --record FILE.mf4".into(),
            );
        }
        match self.error() {
            Some(error) if on => Err(error),
            _ => {
                self.turn(on);
                Ok(())
            }
        }
    }

    /// Ticks in the files.
    pub fn ticks(&self) -> u64 {
        self.ticks.load(Ordering::Relaxed)
    }

    /// Counts ticks that are in the files.
    pub fn add(&self, ticks: u64) {
        self.ticks.fetch_add(ticks, Ordering::Relaxed);
    }

    /// Counts ticks that are not in the files, because the disk was too slow or full.
    pub fn leave_out(&self, ticks: u64) {
        self.unrecorded_ticks.fetch_add(ticks, Ordering::Relaxed);
    }

    /// Ends the recording because of an error.
    pub fn fail(&self, error: String) {
        self.turn(false);
        let mut first = self.error.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    }

    /// Why the recording ended by itself.
    pub fn error(&self) -> Option<String> {
        let error = self.error.lock().unwrap_or_else(PoisonError::into_inner);
        error.clone()
    }

    /// The recording in a report.
    pub fn report(&self, file: &Path) -> Recorded {
        Recorded {
            file: file.to_owned(),
            ticks: self.ticks(),
            unrecorded_ticks: self.unrecorded_ticks.load(Ordering::Relaxed),
            error: self.error(),
        }
    }
}

/// The recording of a run.
#[derive(Serialize)]
pub(super) struct Recorded {
    file: PathBuf,
    ticks: u64,
    unrecorded_ticks: u64,
    pub error: Option<String>,
}

impl Recorded {
    /// Prints the recording as text.
    pub fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let ticks = counted(self.ticks, "tick");
        writeln!(out, "recording: {ticks} in {}", self.file.display())?;
        if self.unrecorded_ticks > 0 {
            let left_out = counted(self.unrecorded_ticks, "tick");
            writeln!(out, "warning: {left_out} not recorded")?;
        }
        match &self.error {
            Some(error) => writeln!(out, "warning: {error}"),
            None => Ok(()),
        }
    }
}
