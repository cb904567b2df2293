//! Why a case is not run.

use dashpot_rail::contact::{CacheError, GeometryError, PairError, SurfaceError};
use dashpot_rail::vehicle::VehicleError;
use dashpot_reference::ReferenceError;

use crate::files::FileError;

/// Why a case is not run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VehicleStudyError {
    /// The vehicle is refused.
    #[error(transparent)]
    Vehicle(#[from] VehicleError),
    /// The track's irregularity is refused.
    #[error(transparent)]
    Track(#[from] FileError),
    /// The wheels do not fit the rails.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// There is no contact under the wheel load.
    #[error("contact of wheel and rail: {0}")]
    Geometry(#[from] GeometryError),
    /// Friction or damping of the surfaces is refused.
    #[error("contact of wheel and rail: {0}")]
    Surface(#[from] SurfaceError),
    /// The tables of the contact cannot be made or kept.
    #[error("tables of the contact: {0}")]
    Tables(#[from] CacheError),
    /// The reference has no solution.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
}
