//! Why there is no sheet.

use crate::{FileError, UnknownName};

/// Why a name or a file is no sheet, or a test of it cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SheetFileError {
    /// The name is neither a shipped sheet's nor a file's.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is no TOML, or has unknown or missing keys; with line, column and the nearest key.
    #[error("{name}: {message}")]
    Text {
        /// The file or sheet.
        name: String,
        /// What is wrong, and where.
        message: String,
    },
    /// Something in it is not as it must be.
    #[error("{name}:{line}: {message}")]
    Line {
        /// The file or sheet.
        name: String,
        /// Line, from 1.
        line: u64,
        /// What is wrong, and what is allowed.
        message: String,
    },
}
