//! Errors of a live run.

use dashpot_files::damper::DamperError;
use dashpot_files::did_you_mean;
use dashpot_vehicle_run::VehicleRunError;

use crate::ChoiceError;

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

/// A name that does not exist.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no {kind} `{name}`{near}; allowed: {allowed}")]
pub struct UnknownName {
    /// What is named.
    pub kind: &'static str,
    /// Name that was given.
    pub name: String,
    /// Suggestion with the nearest name, or empty.
    pub near: String,
    /// All names.
    pub allowed: String,
}

impl UnknownName {
    pub(crate) fn new<'a>(
        kind: &'static str,
        name: &str,
        names: impl Iterator<Item = &'a str> + Clone,
    ) -> Self {
        Self {
            kind,
            name: name.to_owned(),
            near: did_you_mean(name, names.clone()),
            allowed: names.collect::<Vec<_>>().join(", "),
        }
    }
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
