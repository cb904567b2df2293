//! Why a case is not run.

use dashpot_rail::contact::{CacheError, GeometryError, PairError, SurfaceError};
use dashpot_rail::vehicle::VehicleError;

use super::OutsideError;
use dashpot_files::FileError;

/// Why a case is not run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VehicleRunError {
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
    /// A damper that cannot be outside.
    #[error("`{name}` outside: {source}")]
    Outside {
        /// Its name.
        name: String,
        /// Why.
        source: OutsideError,
    },
    /// Two bodies or dampers that have one name in signals, where all but letters and digits of ASCII is an underscore.
    #[error(
        "two signals are called {name}, allowed: names that differ in letters A to Z and digits"
    )]
    SameName {
        /// The name.
        name: String,
    },
    /// A case that another version has written.
    #[error("a case written by Dashpot {version}, allowed: {}", env!("CARGO_PKG_VERSION"))]
    Version {
        /// The version.
        version: String,
    },
    /// A variable of a coupled vehicle that is not the force of a damper outside.
    #[error("variable {variable}: allowed: the force of a damper outside")]
    NotAForce {
        /// The variable's place.
        variable: usize,
    },
    /// A signal that the vehicle has not.
    #[error("no signal `{name}`{near}")]
    NoSignal {
        /// Its name.
        name: String,
        /// The nearest one, in words.
        near: String,
    },
    /// A history does not fit into memory.
    #[error(
        "{signals} signals of {ticks} ticks: no memory, allowed: fewer signals or a shorter run"
    )]
    Memory {
        /// Ticks of the run.
        ticks: u64,
        /// Signals.
        signals: usize,
    },
}
