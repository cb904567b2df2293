//! Errors from building or stepping a run.

use dashpot_rail::contact::{GeometryError, NotTheseTables, PairError, SurfaceError};
use dashpot_rail::vehicle::VehicleError;

use super::OutsideError;
use dashpot_files::FileError;

/// Error from building or stepping a run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VehicleRunError {
    /// Invalid vehicle parameters.
    #[error(transparent)]
    Vehicle(#[from] VehicleError),
    /// Invalid or unreadable track irregularity.
    #[error(transparent)]
    Track(#[from] FileError),
    /// The wheel profiles do not fit the rail profiles.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// The steel is out of bounds.
    #[error("wheel-rail contact: {0}")]
    Geometry(#[from] GeometryError),
    /// Invalid friction coefficient or normal damping.
    #[error("wheel-rail contact: {0}")]
    Surface(#[from] SurfaceError),
    /// The bytes are not the contact tables of this vehicle.
    #[error("contact tables: {0}")]
    Tables(#[from] NotTheseTables),
    /// The number of tables or geometries is not that of the distinct pairs of wheel and rail.
    #[error(
        "contact tables: {sources}, allowed: {pairs}, one for each distinct pair of wheel and rail"
    )]
    Sources {
        /// Number of tables or geometries.
        sources: usize,
        /// Number of pairs.
        pairs: usize,
    },
    /// A damper cannot be external.
    #[error("external damper `{name}`: {source}")]
    Outside {
        /// Name of the damper.
        name: String,
        /// Reason.
        source: OutsideError,
    },
    /// Two bodies or dampers get the same signal name, because [`slug`](crate::signals::slug) replaces every character
    /// other than ASCII letters and digits.
    #[error(
        "two signals are called {name}; allowed: names that differ in letters A to Z and digits"
    )]
    SameName {
        /// Signal name.
        name: String,
    },
    /// The case was written by another version.
    #[error("the case was written by Dashpot {version}; allowed: {}", env!("CARGO_PKG_VERSION"))]
    Version {
        /// Version of Dashpot that wrote the case.
        version: String,
    },
    /// No damper of the vehicle has this name.
    #[error("no damper `{name}`{near}")]
    NoDamper {
        /// The name.
        name: String,
        /// Suggestion with the nearest name, or empty.
        near: String,
    },
    /// A variable cannot be set, because it is an output.
    #[error("variable {variable} cannot be set; allowed: inputs")]
    NotAnInput {
        /// Index of the variable.
        variable: usize,
    },
    /// Unknown signal.
    #[error("no signal `{name}`{near}")]
    NoSignal {
        /// Requested name.
        name: String,
        /// Suggestion with the nearest name, or empty.
        near: String,
    },
    /// The history does not fit into memory.
    #[error(
        "{signals} signals over {ticks} ticks do not fit into memory; allowed: fewer signals or a shorter run"
    )]
    Memory {
        /// Number of ticks in the run.
        ticks: u64,
        /// Number of signals.
        signals: usize,
    },
}
