//! Why there is no case, and where in its file.

use std::collections::BTreeMap;
use std::path::PathBuf;

use dashpot_rail::vehicle::VehicleError;

use crate::track::TrackFileError;
use crate::vehicle::VehicleFileError;
use crate::{FileError, UnknownName};

/// Why a name, a file or options are no case.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CaseError {
    /// The name is neither a shipped case's nor a file's.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// The file cannot be read, or a line of it is not as it must be.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is no TOML, or has unknown or missing keys; with line, column and the nearest key.
    #[error("{name}: {message}")]
    Text {
        /// The file or case.
        name: String,
        /// What is wrong, and where.
        message: String,
    },
    /// A number is out of bounds.
    #[error("{key} {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Its key.
        key: &'static str,
        /// Its value.
        value: f64,
        /// Smallest and greatest allowed value.
        allowed: [f64; 2],
    },
    /// There is no such vehicle.
    #[error(transparent)]
    Vehicle(#[from] VehicleFileError),
    /// There is no such track.
    #[error(transparent)]
    Track(#[from] TrackFileError),
    /// Rails cannot give way as they shall.
    #[error(transparent)]
    Rails(VehicleError),
    /// A fault cannot be.
    #[error("fault {number}: {reason}")]
    Fault {
        /// Its number, from 1.
        number: usize,
        /// What is wrong with it, and what is allowed.
        reason: String,
    },
}

/// Where in its file each value of a case stands.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Origin {
    pub file: PathBuf,
    /// Lines of the keys, of the dampers replaced (`dampers=damper`), and of the overrides by their texts.
    pub lines: BTreeMap<String, u64>,
    /// Lines of the faults.
    pub faults: Vec<u64>,
}

impl Origin {
    /// The error with file and line, if what is wrong is from the file.
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
            _ => String::new(),
        };
        let line = match error {
            CaseError::Fault { number, .. } => self.faults.get(number.wrapping_sub(1)),
            _ => self.lines.get(&key),
        };
        match line {
            Some(line) => FileError::in_line(&self.file, *line, error).into(),
            None => error,
        }
    }
}
