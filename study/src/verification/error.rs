//! Errors from checking a run against the reference.

use dashpot_reference::ReferenceError;
use dashpot_vehicle_run::VehicleRunError;

/// Why a run cannot be checked against the reference.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VerificationError {
    /// The case cannot run.
    #[error(transparent)]
    Run(#[from] VehicleRunError),
    /// The reference solver failed.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
}
