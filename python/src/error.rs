//! Errors of calls, and their conversion to Python exceptions with the library's messages.

use std::fmt::Display;
use std::path::PathBuf;

use dashpot_calibration::CalibrationError;
use dashpot_core::{BuildError, ClearanceError, SavedStateError};
use dashpot_files::FileError;
use dashpot_files::case::CaseError;
use dashpot_files::damper::DamperError;
use dashpot_files::profile::NamedProfileError;
use dashpot_files::sheet::SheetFileError;
use dashpot_files::study::StudyFileError;
use dashpot_files::track::TrackFileError;
use dashpot_files::vehicle::VehicleFileError;
use dashpot_rail::contact::{GeometryError, PairError};
use dashpot_rail::creep::KalkerError;
use dashpot_rail::indices::RollingRadiusError;
use dashpot_study::loaded_wheelset::LoadedWheelsetError;
use dashpot_study::sweep::RunError;
use dashpot_testbench::TestbenchError;
use dashpot_vehicle_run::VehicleRunError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

use crate::remedy::with_remedy;

/// Reasons for which a call fails.
#[derive(Debug)]
pub enum Refusal {
    /// An invalid argument, or a computation without a result.
    Value(String),
    /// A mapping lacks a key.
    Key(String),
    /// A file cannot be read or written.
    File(Unusable),
    /// An exception raised by Python itself, including an interruption.
    Python(PyErr),
}

/// A file that cannot be read or written.
#[derive(Debug)]
pub struct Unusable {
    words: String,
    /// The system's error number, if it provided one.
    errno: Option<i32>,
    path: PathBuf,
}

impl Unusable {
    fn new(words: String, path: PathBuf, source: &std::io::Error) -> Self {
        // On other platforms the system's error numbers are not C's errno.
        let errno = source.raw_os_error().filter(|_| cfg!(unix));
        Self { words, errno, path }
    }
}

/// Result of a call.
pub type Outcome<T> = Result<T, Refusal>;

/// Returns an error with this message.
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
        let words = with_remedy(error.to_string(), dashpot_recording::remedy(&error));
        match error {
            FileError::Read { path, source }
            | FileError::Write { path, source }
            | FileError::Folder { path, source } => Self::File(Unusable::new(words, path, &source)),
            _ => Self::Value(words),
        }
    }
}

/// Converts errors that have a variant for file errors; the macro takes that variant.
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
    SheetFileError::File,
    TestbenchError::Recording,
    TrackFileError::File,
    VehicleRunError::Track,
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
            other => Self::Value(crate::calibration_words::message(&other)),
        }
    }
}

impl From<VehicleFileError> for Refusal {
    fn from(error: VehicleFileError) -> Self {
        let words = error.to_string();
        match error {
            VehicleFileError::File(error) => error.into(),
            VehicleFileError::Damper { source, .. } => Self::from(*source).worded(words),
            _ => Self::Value(words),
        }
    }
}

impl From<StudyFileError> for Refusal {
    fn from(error: StudyFileError) -> Self {
        let words = error.to_string();
        match error {
            StudyFileError::File(error) => error.into(),
            StudyFileError::Case { source, .. } => Self::from(*source).worded(words),
            _ => Self::Value(words),
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
    /// Error in the case with this name.
    pub fn of_case(name: &str, error: VehicleRunError) -> Self {
        let words = format!("{name}: {error}");
        Self::from(error).worded(words)
    }

    /// The same error with another message.
    fn worded(self, words: String) -> Self {
        match self {
            Self::Value(_) => Self::Value(words),
            Self::Key(_) => Self::Key(words),
            Self::File(file) => Self::File(Unusable { words, ..file }),
            python => python,
        }
    }
}

/// Converts errors that cannot be file errors.
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
    GeometryError,
    KalkerError,
    LoadedWheelsetError,
    PairError,
    RollingRadiusError,
    SavedStateError,
);

static VALUE: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static KEY: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static FILE: PyOnceLock<Py<PyType>> = PyOnceLock::new();

impl From<Refusal> for PyErr {
    fn from(refusal: Refusal) -> Self {
        // The exceptions are defined in Python because PyO3 cannot create exceptions with two base classes.
        Python::attach(|py| {
            let exception = |kept: &PyOnceLock<Py<PyType>>, name| {
                let exception = kept.import(py, "dashpot._errors", name);
                exception.cloned()
            };
            let raised = match refusal {
                Refusal::Python(error) => return error,
                Refusal::Value(words) => exception(&VALUE, "DashpotError")
                    .map(|exception| PyErr::from_type(exception, words)),
                Refusal::Key(words) => exception(&KEY, "DashpotKeyError")
                    .map(|exception| PyErr::from_type(exception, words)),
                Refusal::File(Unusable { words, errno, path }) => {
                    exception(&FILE, "DashpotFileError").map(|exception| {
                        PyErr::from_type(exception, (words, errno, path.into_os_string()))
                    })
                }
            };
            raised.unwrap_or_else(|error| error)
        })
    }
}
