//! Why a call has no result, and the exception that tells it: the words are the library's.

use std::fmt::Display;

use dashpot_core::{BuildError, ClearanceError, SavedStateError};
use dashpot_hil::files::FileError;
use dashpot_hil::files::case::CaseError;
use dashpot_hil::files::damper::DamperError;
use dashpot_hil::files::profile::NamedProfileError;
use dashpot_hil::files::study::StudyFileError;
use dashpot_hil::files::track::TrackFileError;
use dashpot_hil::files::vehicle::VehicleFileError;
use dashpot_hil::study::StudyError;
use dashpot_hil::study::calibration::CalibrationError;
use dashpot_hil::study::sweep::RunError;
use dashpot_hil::study::vehicle::VehicleStudyError;
use dashpot_rail::contact::PairError;
use dashpot_rail::creep::KalkerError;
use dashpot_rail::indices::RollingRadiusError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// Why a call has no result.
#[derive(Debug)]
pub enum Refusal {
    /// Something that is asked for is not allowed, or there is no result.
    Value(String),
    /// A file cannot be read or written.
    File(String),
    /// What Python raised itself, an interruption among it.
    Python(PyErr),
}

/// Result of a call.
pub type Outcome<T> = Result<T, Refusal>;

/// Refuses in these words.
pub fn refuse<T>(words: impl Display) -> Outcome<T> {
    Err(Refusal::Value(words.to_string()))
}

impl From<PyErr> for Refusal {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

impl From<FileError> for Refusal {
    fn from(error: FileError) -> Self {
        match error {
            FileError::Read { .. } | FileError::Write { .. } | FileError::Folder { .. } => {
                Self::File(error.to_string())
            }
            other => Self::Value(other.to_string()),
        }
    }
}

/// Errors that a file's may be behind, in this variant.
macro_rules! with_file {
    ($($error:ident :: $file:ident),* $(,)?) => {$(
        impl From<$error> for Refusal {
            fn from(error: $error) -> Self {
                match error {
                    $error::$file(error) => error.into(),
                    other => Self::Value(other.to_string()),
                }
            }
        }
    )*};
}

with_file!(
    DamperError::File,
    NamedProfileError::File,
    StudyError::Recording,
    VehicleFileError::File,
    TrackFileError::File,
    VehicleStudyError::Track,
);

impl From<CaseError> for Refusal {
    fn from(error: CaseError) -> Self {
        match error {
            CaseError::File(error) => error.into(),
            CaseError::Vehicle(error) => error.into(),
            CaseError::Track(error) => error.into(),
            other => Self::Value(other.to_string()),
        }
    }
}

impl From<CalibrationError> for Refusal {
    fn from(error: CalibrationError) -> Self {
        match error {
            CalibrationError::Damper(error) => error.into(),
            CalibrationError::Study(error) => error.into(),
            other => Self::Value(other.to_string()),
        }
    }
}

impl From<StudyFileError> for Refusal {
    fn from(error: StudyFileError) -> Self {
        match error {
            StudyFileError::File(error) => error.into(),
            other => Self::Value(other.to_string()),
        }
    }
}

impl From<RunError> for Refusal {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Case(error) => (*error).into(),
            other => Self::Value(other.to_string()),
        }
    }
}

impl Refusal {
    /// What a case of this name is refused for.
    pub fn of_case(name: &str, error: VehicleStudyError) -> Self {
        let named = |words: String| format!("{name}: {words}");
        match Self::from(error) {
            Self::Value(words) => Self::Value(named(words)),
            Self::File(words) => Self::File(named(words)),
            python => python,
        }
    }
}

/// Errors that are of no file.
macro_rules! without_file {
    ($($error:ty),* $(,)?) => {$(
        impl From<$error> for Refusal {
            fn from(error: $error) -> Self {
                Self::Value(error.to_string())
            }
        }
    )*};
}

without_file!(
    BuildError,
    ClearanceError,
    KalkerError,
    PairError,
    RollingRadiusError,
    SavedStateError,
);

static VALUE: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static FILE: PyOnceLock<Py<PyType>> = PyOnceLock::new();

impl From<Refusal> for PyErr {
    fn from(refusal: Refusal) -> Self {
        let (kept, name, words) = match refusal {
            Refusal::Python(error) => return error,
            Refusal::Value(words) => (&VALUE, "DashpotError", words),
            Refusal::File(words) => (&FILE, "DashpotFileError", words),
        };
        // Written in Python, for Rust makes no exception of two bases.
        Python::attach(|py| match kept.import(py, "dashpot._errors", name) {
            Ok(exception) => PyErr::from_type(exception.clone(), words),
            Err(error) => error,
        })
    }
}
