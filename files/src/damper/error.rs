//! Damper errors.

use dashpot_core::BuildError;

use crate::{FileError, UnknownName};

/// Error from loading a damper.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DamperError {
    /// The name is neither a preset nor a file.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// Cannot read the file.
    #[error(transparent)]
    File(#[from] FileError),
    /// Invalid override; the form is `table.key=value`.
    #[error("override {assignment}: {reason}; the form is {FORM}")]
    Override {
        /// The override.
        assignment: String,
        /// The problem.
        reason: String,
    },
    /// The damper has no number at this key.
    #[error("{name}: no number at `{key}`{hint}")]
    NoNumber {
        /// Name of the file or preset.
        name: String,
        /// The key.
        key: String,
        /// Suggestion of a similar key; empty if none is similar.
        hint: String,
    },
    /// Invalid file content, independent of the overrides.
    #[error("{name}: {source}")]
    Content {
        /// Name of the file or preset.
        name: String,
        /// The problem.
        source: ContentError,
    },
    /// Valid file content that the overrides make invalid.
    #[error("{name}: {source}")]
    Overridden {
        /// Name of the file or preset.
        name: String,
        /// The problem.
        source: ContentError,
    },
}

/// Form of an override, for error messages.
pub const FORM: &str = "table.key=value with a TOML value, such as mount.clearance_m=1e-3";

/// Error in the tables of a damper file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ContentError {
    /// The text is not TOML, or has unknown or missing keys; the message gives the line, the column and a similar key.
    #[error("{0}")]
    Text(String),
    /// The overrides lead to unknown or missing keys.
    #[error("with the overrides: {0}")]
    Tables(String),
    /// A reduced damper has a table that only a physical damper may have.
    #[error(
        "[{table}] together with [reduced]: a reduced damper has [reduced], [mount] and [limits] only"
    )]
    BesideReduced {
        /// The table.
        table: &'static str,
    },
    /// A physical damper lacks a required table.
    #[error(
        "table [{table}] is missing: a physical damper needs [geometry], [orifice], [valves.*], [oil] and \
         [mount]; a reduced one [reduced] and [mount]"
    )]
    Missing {
        /// The table.
        table: &'static str,
    },
    /// Value out of range.
    #[error(transparent)]
    Value(#[from] BuildError),
}
