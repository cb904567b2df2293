//! Sheet errors.

use crate::{FileError, UnknownName};

/// Error from loading a sheet or from running one of its tests.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SheetFileError {
    /// The name is neither a built-in sheet nor a file.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// Cannot read the file.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is not TOML, or has unknown or missing keys.
    #[error("{name}: {message}")]
    Text {
        /// Name of the file or sheet.
        name: String,
        /// The problem, its line and column, and a similar key if there is one.
        message: String,
    },
    /// Invalid entry.
    #[error("{name}:{line}: {message}")]
    Line {
        /// Name of the file or sheet.
        name: String,
        /// Line of the entry, from 1.
        line: u64,
        /// The problem, and the allowed values.
        message: String,
    },
}
