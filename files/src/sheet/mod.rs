//! Acceptance sheets: the tests of a bench, in order, with limits for their indices.
//!
//! All limits, and the clauses they cite, come from the file; Dashpot itself defines none.

mod error;
mod index;
mod tables;

pub use error::SheetFileError;
pub use index::{DisplayUnit, Index};
use tables::SheetTables;

use crate::harmonic::Harmonic;
use crate::overrides::explain;
use crate::shipped::{Found, Shipped};

/// Built-in sheets: name and text.
pub const SHEETS: [(&str, &str); 1] = [("example", include_str!("../../data/sheets/example.toml"))];

const SHIPPED: Shipped = Shipped {
    kind: "sheet",
    built_in: "sheet",
    texts: &SHEETS,
};

/// Acceptance sheet as read from its file.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetParameters {
    /// Title of the sheet.
    pub title: String,
    /// Fields of the header, in order.
    pub fields: Vec<Field>,
    /// The tests, in order.
    pub tests: Vec<Test>,
    /// How far a measured motion and temperature may be from those of a test.
    pub tolerance: Tolerance,
    /// Name of the file in error messages.
    pub file: String,
}

/// How far a measured motion and temperature may be from those of a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Difference of amplitude and of frequency (%).
    pub motion_percent: f64,
    /// Difference of the oil temperature (K).
    pub temperature_k: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self {
            motion_percent: 5.0,
            temperature_k: 5.0,
        }
    }
}

/// Field in the header of a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Name.
    pub name: String,
    /// Text.
    pub text: String,
}

/// Bench test.
#[derive(Debug, Clone, PartialEq)]
pub struct Test {
    /// Name, unique in the sheet.
    pub name: String,
    /// The motion.
    pub motion: Harmonic,
    /// Oil temperature (degC); `None` uses the damper's own.
    pub temperature_c: Option<f64>,
    /// Limits of the indices.
    pub limits: Vec<Limit>,
    /// Line in the file.
    pub line: u64,
}

/// Allowed interval of an index.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// The index.
    pub index: Index,
    /// Minimum, in the unit of the index's key; `None` if unlimited.
    pub min: Option<f64>,
    /// Maximum, in the unit of the index's key; `None` if unlimited.
    pub max: Option<f64>,
    /// Nominal value, from which minimum and maximum were computed; `None` if they were given.
    pub nominal: Option<f64>,
    /// Clause of the standard or contract that sets the limit.
    pub clause: Option<String>,
}

impl Limit {
    /// True if the value is within the limit; false for `None`.
    pub fn is_kept(&self, value: Option<f64>) -> bool {
        value.is_some_and(|value| {
            self.min.is_none_or(|min| value >= min) && self.max.is_none_or(|max| value <= max)
        })
    }
}

impl SheetParameters {
    /// Loads the sheet called `name`: a built-in one, or the TOML file at that path (`-` for standard input).
    ///
    /// # Errors
    /// Returns an error with file and line if there is no such sheet or readable file, if the text is not TOML, for
    /// unknown or missing keys, a motion out of range, contradictory limits, or a duplicate name.
    ///
    /// ```
    /// let sheet = dashpot_files::sheet::SheetParameters::load("example")?;
    /// assert!(sheet.tests.iter().any(|test| test.temperature_c == Some(-20.0)));
    /// # Ok::<(), dashpot_files::sheet::SheetFileError>(())
    /// ```
    pub fn load(name: &str) -> Result<Self, SheetFileError> {
        Self::parse_in(&SHIPPED.find::<SheetFileError>(name)?)
    }

    /// Parses the sheet in `text`; error messages call it `name`.
    ///
    /// # Errors
    /// Same errors as [`Self::load`].
    pub fn parse(name: &str, text: &str) -> Result<Self, SheetFileError> {
        Self::parse_in(&Found {
            name: name.to_owned(),
            text: text.to_owned().into(),
            folder: std::path::PathBuf::new(),
        })
    }

    fn parse_in(found: &Found) -> Result<Self, SheetFileError> {
        let tables: SheetTables =
            toml::from_str(&found.text).map_err(|error| SheetFileError::Text {
                name: found.name.clone(),
                message: explain(&error),
            })?;
        tables.parameters(found)
    }

    /// Error about a test, with the position of the test in the file.
    pub fn test_error(&self, test: &Test, message: impl std::fmt::Display) -> SheetFileError {
        SheetFileError::Line {
            name: self.file.clone(),
            line: test.line,
            message: format!("test `{}`: {message}", test.name),
        }
    }
}
