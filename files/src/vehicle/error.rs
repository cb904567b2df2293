//! Vehicle-file errors.

use dashpot_rail::vehicle::VehicleError;

use super::Replacement;
use crate::contact::ContactError;
use crate::damper::DamperError;
use crate::{FileError, UnknownName};

/// Error from loading a vehicle.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VehicleFileError {
    /// The name is neither a built-in vehicle nor a file.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// Cannot read the file.
    #[error(transparent)]
    File(#[from] FileError),
    /// Invalid override; the form is `part.key=value`.
    #[error("override {assignment}: {reason}; the form is {FORM}")]
    Override {
        /// The override.
        assignment: String,
        /// The problem.
        reason: String,
    },
    /// Invalid replacement of dampers.
    #[error("dampers {replacement}: {reason}")]
    Replacement {
        /// The replacement.
        replacement: Replacement,
        /// The problem.
        reason: String,
    },
    /// The text is not TOML, or has unknown or missing keys.
    #[error("{name}: {message}")]
    Text {
        /// Name of the file or vehicle.
        name: String,
        /// The problem, its line and column, and a similar key if there is one.
        message: String,
    },
    /// Valid file content that the overrides make invalid.
    #[error("{name}: with the overrides: {message}")]
    Overridden {
        /// Name of the file or vehicle.
        name: String,
        /// The problem.
        message: String,
    },
    /// Cannot load a damper of the vehicle.
    #[error("{name}: {element}: {source}")]
    Damper {
        /// Name of the file or vehicle.
        name: String,
        /// Name of the element.
        element: String,
        /// The problem with its damper.
        source: Box<DamperError>,
    },
    /// A friction element without friction, or with half of a load.
    #[error("{name}: {element}: {reason}")]
    Friction {
        /// Name of the file or vehicle.
        name: String,
        /// Name of the elements.
        element: String,
        /// The problem, and what is allowed.
        reason: &'static str,
    },
    /// Invalid wheels.
    #[error("{name}: {source}")]
    Contact {
        /// Name of the file or vehicle, with the line of the value.
        name: String,
        /// The problem.
        source: ContactError,
    },
    /// Invalid parts.
    #[error("{name}: {source}")]
    Vehicle {
        /// Name of the file or vehicle.
        name: String,
        /// The problem.
        source: VehicleError,
    },
}

/// Forms of an override, for error messages.
pub const FORM: &str = "part.key=value with a TOML value, such as body.mass_kg=70e3, or dampers.table.key=value, such \
                        as vertical.mount.clearance_m=2e-3";
