//! Track-file errors.

use crate::{FileError, UnknownName};

/// Error from loading a track.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TrackFileError {
    /// The name is neither a built-in track nor a file.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// Cannot use the track file or the file of its measured irregularity.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is not TOML, or has unknown or missing keys.
    #[error("{name}: {message}")]
    Text {
        /// Name of the file or track.
        name: String,
        /// The problem, its line and column, and a similar key if there is one.
        message: String,
    },
}
