//! Errors of plate calculations.

use dashpot_core::BuildError;

/// Errors of plate calculations.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlateError {
    /// Plate theory does not apply to the stack.
    #[error(transparent)]
    Stack(#[from] BuildError),
    /// Invalid value of the pressure area.
    #[error("{key}: {given}, allowed: {allowed}")]
    Area {
        /// Name of the value.
        key: &'static str,
        /// Given value.
        given: String,
        /// Allowed values.
        allowed: String,
    },
    /// No geometry of this kind has the requested correction factor.
    #[error("no {geometry} has a correction factor of {factor}, allowed: {min:.4} to {max:.4}")]
    OutOfReach {
        /// Fitted quantity.
        geometry: &'static str,
        /// Requested correction factor (1).
        factor: f64,
        /// Minimum factor of this kind of geometry.
        min: f64,
        /// Maximum factor of this kind of geometry.
        max: f64,
    },
    /// The equations have no solution, because rounding makes the stiffness matrix singular.
    #[error("the plate's equations have no solution between {clamp_m} and {free_m} m")]
    Singular {
        /// Clamping radius (m).
        clamp_m: f64,
        /// Free radius (m).
        free_m: f64,
    },
}
