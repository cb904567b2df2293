//! Errors of actuator files.

use super::bounds::Bound;
use crate::{FileError, UnknownName};

/// Error from loading an actuator.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ActuatorFileError {
    /// The name is neither a built-in actuator nor a file.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// Cannot read the file.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is not TOML, or has unknown or missing keys.
    #[error("{name}: {message}")]
    Text {
        /// Name of the file or actuator.
        name: String,
        /// The problem, its line and column, and a similar key if there is one.
        message: String,
    },
    /// A value is not allowed.
    #[error("{name}: {bound}")]
    Value {
        /// Name of the file or actuator.
        name: String,
        /// The value and its allowed range.
        bound: Bound,
    },
}
