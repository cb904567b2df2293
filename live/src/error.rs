//! Errors of a live run.

use dashpot_files::damper::DamperError;
use dashpot_vehicle_run::VehicleRunError;

use crate::ChoiceError;
use crate::unknown_name::UnknownName;

/// An action or message that cannot be done.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ActionError {
    /// A name that does not exist.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// A value out of range.
    #[error("{name}: {value}, allowed: {min} to {max}")]
    OutOfRange {
        /// Name of the value.
        name: &'static str,
        /// The value.
        value: f64,
        /// Smallest allowed value.
        min: f64,
        /// Largest allowed value.
        max: f64,
    },
    /// Parameters of a damper.
    #[error(transparent)]
    Damper(#[from] DamperError),
    /// The vehicle cannot run.
    #[error(transparent)]
    Vehicle(#[from] VehicleRunError),
    /// The choice of a case.
    #[error(transparent)]
    Choice(#[from] ChoiceError),
    /// A state that was saved by another version, or is damaged.
    #[error("{0}")]
    State(&'static str),
    /// A message that is not of the protocol.
    #[error("message: {0}")]
    Message(String),
}

/// Checks that a value is in its range.
///
/// # Errors
/// It is not; NaN never is.
pub fn within(name: &'static str, value: f64, [min, max]: [f64; 2]) -> Result<(), ActionError> {
    if (min..=max).contains(&value) {
        Ok(())
    } else {
        Err(ActionError::OutOfRange {
            name,
            value,
            min,
            max,
        })
    }
}
