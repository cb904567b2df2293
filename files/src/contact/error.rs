//! Errors in a table `[contact]`.

use dashpot_rail::contact::{InstallationError, PairError};
use dashpot_rail::creep::FrictionError;
use dashpot_rail::track::TrackError;

use crate::profile::NamedProfileError;

/// Invalid value in a table `[contact]`.
#[derive(Debug, thiserror::Error)]
#[error("contact.{key}: {reason}")]
#[non_exhaustive]
pub struct ContactError {
    /// Key of the value in the table.
    pub key: &'static str,
    /// The problem.
    pub reason: ContactReason,
}

/// Problem with a value in a table `[contact]`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ContactReason {
    /// A profile cannot be loaded.
    #[error(transparent)]
    Profile(#[from] NamedProfileError),
    /// A dimension is out of bounds.
    #[error(transparent)]
    Installation(#[from] InstallationError),
    /// The wheel does not fit the rail.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// The friction is out of bounds.
    #[error(transparent)]
    Friction(#[from] FrictionError),
    /// A point of the gauge or of the friction over the distance is out of bounds.
    #[error(transparent)]
    Track(#[from] TrackError),
    /// Another problem, with the allowed values.
    #[error("{0}")]
    Other(String),
}

impl ContactError {
    /// The value of `key` is invalid.
    pub(super) fn new(key: &'static str, reason: impl Into<ContactReason>) -> Self {
        Self {
            key,
            reason: reason.into(),
        }
    }

    /// The value of `key` is invalid, because of a reason that ends with the allowed values.
    pub(super) fn other(key: &'static str, reason: impl Into<String>) -> Self {
        Self::new(key, ContactReason::Other(reason.into()))
    }

    /// Adds the key to an error of the dimensions.
    pub(super) fn of_installation(error: InstallationError) -> Self {
        let key = match &error {
            InstallationError::OutOfBounds { name, .. } => match *name {
                "back-to-back distance" => "back_to_back_m",
                "back of the flange to tread datum" => "back_to_datum_m",
                "gauge depth" => "gauge_depth_m",
                "rail inclination" => "rail_inclination",
                _ => "gauge_m",
            },
            _ => "gauge_m",
        };
        Self::new(key, error)
    }

    /// Adds the key to an error of the falling friction.
    pub(super) fn of_friction(error: FrictionError) -> Self {
        let key = match &error {
            FrictionError::OutOfBounds { name, .. } => match *name {
                "residual friction ratio" => "residual_friction_ratio",
                "friction decay speed" => "friction_decay_speed_m_per_s",
                _ => "friction",
            },
            _ => "friction",
        };
        Self::new(key, error)
    }
}
