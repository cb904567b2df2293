//! Why there is no track.

use crate::{FileError, UnknownName};

/// Why a name and a file are no track.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TrackFileError {
    /// The name is neither a shipped track's nor a file's.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// A file cannot be read, or a line of it is not as it must be: the track's own, or the one of its measured irregularity.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is no TOML, or has unknown or missing keys; with line, column and the nearest key.
    #[error("{name}: {message}")]
    Text {
        /// The file or track.
        name: String,
        /// What is wrong, and where.
        message: String,
    },
}
