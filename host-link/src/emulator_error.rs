//! Why the emulator does not run.

use std::io;
use std::path::PathBuf;
use std::process::ExitStatus;

use dashpot_files::FileError;

/// Program of the emulator.
pub(super) const EMULATOR: &str = "qemu-system-arm";

/// Why the emulator did not start, or no longer runs.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EmulatorError {
    /// There is no image.
    #[error("{}: no firmware image there; build it with `cargo xtask firmware`", .0.display())]
    NoImage(PathBuf),
    /// The file cannot be read or is no image.
    #[error(transparent)]
    Image(#[from] FileError),
    /// The emulator is not installed.
    #[error("{EMULATOR} is not installed; on Debian and Ubuntu: apt-get install qemu-system-arm")]
    NotInstalled,
    /// The system does not start it.
    #[error("cannot start {EMULATOR}: {0}")]
    Start(#[source] io::Error),
    /// No port for its serial line.
    #[error("cannot open a local port: {0}")]
    Port(#[source] io::Error),
    /// Its serial line cannot be taken.
    #[error("{EMULATOR}: {0}")]
    SerialLine(#[source] io::Error),
    /// It ended.
    #[error("{EMULATOR} ended: {status}{message}")]
    Ended {
        /// How.
        status: ExitStatus,
        /// What it wrote to standard error; may be empty.
        message: String,
    },
    /// It did not open its serial line in time.
    #[error("{EMULATOR} did not open its serial line within {seconds} s")]
    TimedOut {
        /// The time it had (s).
        seconds: u64,
    },
}
