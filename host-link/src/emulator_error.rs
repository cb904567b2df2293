//! Errors from the emulator.

use std::io;
use std::path::PathBuf;
use std::process::ExitStatus;

use dashpot_files::FileError;

/// Program name of the emulator.
pub(super) const EMULATOR: &str = "qemu-system-arm";

/// Errors from the emulator.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EmulatorError {
    /// The image file does not exist.
    #[error("{}: no firmware image there", .0.display())]
    NoImage(PathBuf),
    /// The file cannot be read or is not an image.
    #[error(transparent)]
    Image(#[from] FileError),
    /// The emulator is not installed.
    #[error("{EMULATOR} is not installed")]
    NotInstalled,
    /// The system cannot start the emulator.
    #[error("cannot start {EMULATOR}: {0}")]
    Start(#[source] io::Error),
    /// No local port is available for the serial line.
    #[error("cannot open a local port: {0}")]
    Port(#[source] io::Error),
    /// The serial line cannot be opened.
    #[error("{EMULATOR}: {0}")]
    SerialLine(#[source] io::Error),
    /// The emulator ended.
    #[error("{EMULATOR} ended: {status}{message}")]
    Ended {
        /// Exit status.
        status: ExitStatus,
        /// Output on standard error; may be empty.
        message: String,
    },
    /// The emulator did not open its serial line in time.
    #[error("{EMULATOR} did not open its serial line within {seconds} s")]
    TimedOut {
        /// Time limit (s).
        seconds: u64,
    },
}
