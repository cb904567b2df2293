//! Errors from loading a study file.

use crate::case::CaseError;
use crate::{FileError, UnknownName};

/// Error from loading a study.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyFileError {
    /// The name is neither a built-in study nor a file.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// Cannot read the file.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is not TOML, or has unknown or missing keys.
    #[error("{name}: {message}")]
    Text {
        /// Name of the file or study.
        name: String,
        /// The problem, its line and column, and a similar key if there is one.
        message: String,
    },
    /// Invalid entry.
    #[error("{name}:{line}: {message}")]
    Line {
        /// Name of the file or study.
        name: String,
        /// Line of the entry, from 1.
        line: u64,
        /// The problem, and the allowed values.
        message: String,
    },
    /// Invalid case of a sweep.
    #[error("{name}:{line}: sweep {sweep}{at}: {source}")]
    Case {
        /// Name of the file or study.
        name: String,
        /// Line of the sweep.
        line: u64,
        /// Name of the sweep.
        sweep: String,
        /// The case's values as text, such as ` at speed_km_h 120`; empty if no parameter varies.
        at: String,
        /// The problem.
        source: Box<CaseError>,
    },
}
