//! Why there is no damper.

use dashpot_core::BuildError;

use crate::{FileError, UnknownName};

/// Why a name, a file and its overrides are no damper.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DamperError {
    /// The name is neither a preset's nor a file's.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// An override is not of the form `table.key=value`.
    #[error("override {assignment}: {reason}; the form is {FORM}")]
    Override {
        /// The override.
        assignment: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A key that has no number in this damper.
    #[error("{name}: no number at `{key}`{near}")]
    NoNumber {
        /// The file or preset.
        name: String,
        /// The key.
        key: String,
        /// The nearest key, in words.
        near: String,
    },
    /// The file is not as it must be, whatever is overridden.
    #[error("{name}: {source}")]
    Content {
        /// The file or preset.
        name: String,
        /// What is wrong with it.
        source: ContentError,
    },
    /// The file is good, but not with the overrides.
    #[error("{name}: {source}")]
    Overridden {
        /// The file or preset.
        name: String,
        /// What is wrong with both together.
        source: ContentError,
    },
}

/// The form of an override.
pub const FORM: &str = "table.key=value with a TOML value, such as mount.clearance_m=1e-3";

/// What is wrong with the tables of a damper.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ContentError {
    /// The text is no TOML, or has unknown or missing keys; with line, column and the nearest key.
    #[error("{0}")]
    Text(String),
    /// With the overrides there are unknown or missing keys.
    #[error("with the overrides: {0}")]
    Tables(String),
    /// A table that only a physical damper has.
    #[error(
        "[{table}] beside [reduced]: a reduced damper has [reduced], [mount] and [limits] only"
    )]
    BesideReduced {
        /// The table.
        table: &'static str,
    },
    /// A table that a physical damper needs.
    #[error(
        "table [{table}] is missing: a physical damper needs [geometry], [orifice], [valves.*], [oil] and \
         [mount]; a reduced one [reduced] and [mount]"
    )]
    Missing {
        /// The table.
        table: &'static str,
    },
    /// A value outside its range.
    #[error(transparent)]
    Value(#[from] BuildError),
}
