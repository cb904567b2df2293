//! Case errors and their positions in the file.

use std::collections::BTreeMap;
use std::path::PathBuf;

use dashpot_rail::vehicle::VehicleError;

use crate::contact::{ContactError, TABLE};
use crate::track::TrackFileError;
use crate::vehicle::VehicleFileError;
use crate::{FileError, UnknownName};

/// Error from loading a case.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CaseError {
    /// The name is neither a built-in case nor a file.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// Cannot read the file, or a line of it is invalid.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is not TOML, or has unknown or missing keys.
    #[error("{name}: {message}")]
    Text {
        /// Name of the file or case.
        name: String,
        /// The problem, its line and column, and a similar key if there is one.
        message: String,
    },
    /// A number is out of bounds.
    #[error("{key} {value}, allowed: {min} to {max}")]
    OutOfBounds {
        /// Key of the number.
        key: &'static str,
        /// The value.
        value: f64,
        /// Minimum allowed value.
        min: f64,
        /// Maximum allowed value.
        max: f64,
    },
    /// Invalid vehicle.
    #[error(transparent)]
    Vehicle(#[from] VehicleFileError),
    /// Invalid track.
    #[error(transparent)]
    Track(#[from] TrackFileError),
    /// Invalid override of contact or rails; the form is `contact.key=value` or `rails.key=value`.
    #[error("override {assignment}: {reason}")]
    Override {
        /// The override.
        assignment: String,
        /// The problem.
        reason: String,
    },
    /// Invalid wheels, rails or friction.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// Invalid rail support.
    #[error(transparent)]
    Rails(VehicleError),
    /// Invalid event entry.
    #[error("event {number}: {reason}")]
    Event {
        /// Number of the entry in the file, from 1.
        number: usize,
        /// The problem, and the allowed values.
        reason: String,
    },
    /// Invalid fault entry.
    #[error("fault {number}: {reason}")]
    Fault {
        /// Number of the entry in the file, from 1.
        number: usize,
        /// The problem, and the allowed values.
        reason: String,
    },
}

/// Lines of a case's values in its file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Origin {
    pub file: PathBuf,
    /// Lines by key, by replacement (`WHICH=DAMPER`) and by override text.
    pub lines: BTreeMap<String, u64>,
    /// Line of each fault.
    pub faults: Vec<u64>,
    /// Line of each event.
    pub events: Vec<u64>,
}

impl Origin {
    /// Adds file and line to an error whose cause is in the file.
    pub fn locate(&self, error: CaseError) -> CaseError {
        let key = match &error {
            CaseError::OutOfBounds { key, .. } => (*key).to_owned(),
            CaseError::Vehicle(VehicleFileError::Override { assignment, .. }) => assignment.clone(),
            CaseError::Vehicle(VehicleFileError::Replacement { replacement, .. }) => {
                replacement.to_string()
            }
            CaseError::Vehicle(_) => "vehicle".into(),
            CaseError::Track(_) => "track".into(),
            CaseError::Rails(_) => "rails".into(),
            CaseError::Override { assignment, .. } => assignment.clone(),
            CaseError::Contact(error) => format!("{TABLE}.{}", error.key),
            _ => String::new(),
        };
        let line = match error {
            CaseError::Fault { number, .. } => self.faults.get(number.wrapping_sub(1)),
            CaseError::Event { number, .. } => self.events.get(number.wrapping_sub(1)),
            _ => self.lines.get(&key),
        };
        match line {
            Some(line) => FileError::in_line(&self.file, *line, error).into(),
            None => error,
        }
    }
}
