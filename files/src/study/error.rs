//! Why there is no study.

use crate::case::CaseError;
use crate::{FileError, UnknownName};

/// Why a name or a file is no study.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyFileError {
    /// The name is neither a shipped study's nor a file's.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is no TOML, or has unknown or missing keys; with line, column and the nearest key.
    #[error("{name}: {message}")]
    Text {
        /// The file or study.
        name: String,
        /// What is wrong, and where.
        message: String,
    },
    /// Something in it is not as it must be.
    #[error("{name}:{line}: {message}")]
    Line {
        /// The file or study.
        name: String,
        /// Line, from 1.
        line: u64,
        /// What is wrong, and what is allowed.
        message: String,
    },
    /// A case of a sweep is refused.
    #[error("{name}:{line}: sweep {sweep}{at}: {source}")]
    Case {
        /// The file or study.
        name: String,
        /// Line of the sweep.
        line: u64,
        /// The sweep.
        sweep: String,
        /// The values of the case, in words.
        at: String,
        /// What is wrong with it.
        source: Box<CaseError>,
    },
}
