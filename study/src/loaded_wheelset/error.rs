//! Errors of a wheelset under load.

use dashpot_rail::contact::SurfaceError;

/// Errors from the description of a wheelset under load.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LoadedWheelsetError {
    /// A quantity is out of bounds.
    #[error("{key}: {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Name of the quantity, with its SI unit.
        key: &'static str,
        /// Its value.
        value: f64,
        /// Minimum and maximum allowed value.
        allowed: [f64; 2],
    },
    /// The friction is out of bounds.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
}
