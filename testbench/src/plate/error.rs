//! Why a plate has no solution.

use dashpot_core::BuildError;

/// Why a plate has no solution.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlateError {
    /// The stack is not one that plate theory holds for.
    #[error(transparent)]
    Stack(#[from] BuildError),
    /// A number of the pressure area is not allowed.
    #[error("{key}: {given}, allowed: {allowed}")]
    Area {
        /// Its name.
        key: &'static str,
        /// What was given.
        given: String,
        /// What is allowed.
        allowed: String,
    },
    /// No geometry of a kind has the correction factor asked for.
    #[error(
        "no {geometry} has a correction factor of {factor}, allowed: {least:.4} to {greatest:.4}"
    )]
    OutOfReach {
        /// What was to be fitted.
        geometry: &'static str,
        /// The correction factor (1).
        factor: f64,
        /// Least factor of the kind.
        least: f64,
        /// Greatest factor of the kind.
        greatest: f64,
    },
    /// The plate's equations have no solution: rounding makes the stiffness singular.
    #[error("the plate's equations have no solution between {clamp_m} and {free_m} m")]
    Singular {
        /// Clamping radius (m).
        clamp_m: f64,
        /// Free radius (m).
        free_m: f64,
    },
}
