//! Sheet files: the tests of a bench, in order, and the limits that each index must keep.
//!
//! Limits are those of whoever writes the file, with the clause that they cite; the program has none of its own.

mod error;
mod index;
mod tables;

pub use error::SheetFileError;
pub use index::Index;
use tables::SheetTables;

use crate::harmonic::Harmonic;
use crate::overrides::explain;
use crate::shipped::{Found, Shipped};

/// Sheets that ship with the program: name and file.
pub const SHEETS: [(&str, &str); 1] = [("example", include_str!("../../data/sheets/example.toml"))];

const SHIPPED: Shipped = Shipped {
    what: "sheet",
    one: "sheet",
    texts: &SHEETS,
};

/// A sheet as its file gives it.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetParameters {
    /// What the sheet is called.
    pub title: String,
    /// What stands in its head, name and text, in order.
    pub fields: Vec<(String, String)>,
    /// The tests, in order.
    pub tests: Vec<Test>,
    /// What stands for the file in errors.
    pub file: String,
}

/// A test.
#[derive(Debug, Clone, PartialEq)]
pub struct Test {
    /// Name, which no other test of the sheet has.
    pub name: String,
    /// The motion.
    pub motion: Harmonic,
    /// Temperature of the oil (degC); the damper's own where there is none.
    pub temperature_c: Option<f64>,
    /// What indices must keep.
    pub limits: Vec<Limit>,
    /// Line in the file.
    pub line: u64,
}

/// What an index must keep.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// The index.
    pub index: Index,
    /// The least that it may be, in the unit of its key.
    pub least: Option<f64>,
    /// The most that it may be.
    pub most: Option<f64>,
    /// Where the limit is from.
    pub clause: Option<String>,
}

impl Limit {
    /// Whether a value is within; one that there is not is none.
    pub fn is_kept(&self, value: Option<f64>) -> bool {
        value.is_some_and(|value| {
            self.least.is_none_or(|least| value >= least)
                && self.most.is_none_or(|most| value <= most)
        })
    }
}

impl SheetParameters {
    /// The sheet called `name`: a shipped one, or the TOML file at that path, `-` being standard input.
    ///
    /// # Errors
    /// Neither sheet nor readable file; text that is no TOML; unknown or missing keys; a motion outside the bench's range, limits that
    /// nothing keeps, names that there are twice; with file and line.
    ///
    /// ```
    /// let sheet = dashpot_files::sheet::SheetParameters::load("example")?;
    /// assert!(sheet.tests.iter().any(|test| test.temperature_c == Some(-20.0)));
    /// # Ok::<(), dashpot_files::sheet::SheetFileError>(())
    /// ```
    pub fn load(name: &str) -> Result<Self, SheetFileError> {
        Self::parse_in(&SHIPPED.find::<SheetFileError>(name)?)
    }

    /// The sheet written in `text`; `name` stands for it in errors.
    ///
    /// # Errors
    /// As [`Self::load`].
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

    /// The error `message` of a test, with its place.
    pub fn wrong(&self, test: &Test, message: impl std::fmt::Display) -> SheetFileError {
        SheetFileError::Line {
            name: self.file.clone(),
            line: test.line,
            message: format!("test `{}`: {message}", test.name),
        }
    }
}
