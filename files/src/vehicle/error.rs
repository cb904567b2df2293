//! Why there is no vehicle.

use dashpot_rail::vehicle::VehicleError;

use super::Replacement;
use crate::damper::DamperError;
use crate::{FileError, UnknownName};

/// Why a name, a file and its overrides are no vehicle.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VehicleFileError {
    /// The name is neither a shipped vehicle's nor a file's.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// An override is not of the form `part.key=value`.
    #[error("override {assignment}: {reason}; the form is {FORM}")]
    Override {
        /// The override.
        assignment: String,
        /// What is wrong with it.
        reason: String,
    },
    /// Dampers cannot be replaced.
    #[error("dampers {replacement}: {reason}")]
    Replacement {
        /// Which by what.
        replacement: Replacement,
        /// What is wrong with it.
        reason: String,
    },
    /// The text is no TOML, or has unknown or missing keys; with line, column and the nearest key.
    #[error("{name}: {message}")]
    Text {
        /// The file or vehicle.
        name: String,
        /// What is wrong, and where.
        message: String,
    },
    /// The file is good, but not with the overrides.
    #[error("{name}: with the overrides: {message}")]
    Overridden {
        /// The file or vehicle.
        name: String,
        /// What is wrong with both together.
        message: String,
    },
    /// A damper of the vehicle cannot be had.
    #[error("{name}: {element}: {source}")]
    Damper {
        /// The file or vehicle.
        name: String,
        /// The element.
        element: String,
        /// What is wrong with its damper.
        source: Box<DamperError>,
    },
    /// The parts are no vehicle.
    #[error("{name}: {source}")]
    Vehicle {
        /// The file or vehicle.
        name: String,
        /// What is wrong with them.
        source: VehicleError,
    },
}

/// The form of an override.
pub const FORM: &str = "part.key=value with a TOML value, such as body.mass_kg=70e3, or dampers.table.key=value, such as vertical.mount.clearance_m=2e-3";
