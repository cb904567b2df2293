//! Errors from checking a run against the reference.

use dashpot_reference::ReferenceError;
use dashpot_vehicle_run::VehicleRunError;

/// Error from checking a run against the reference.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VerificationError {
    /// The case cannot be run.
    #[error(transparent)]
    Run(#[from] VehicleRunError),
    /// The reference solver failed.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
}
