//! What went wrong, told to a person: what, where, what is allowed.

use std::fmt;
use std::path::Path;

/// A failure with a message that names the place and what is allowed there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure(String);

/// Result of everything on the host that can fail.
pub type Outcome<T> = Result<T, Failure>;

impl Failure {
    /// A failure told by `message`.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }

    /// A failure of the file at `path`: `path: message`.
    pub fn in_file(path: &Path, message: impl fmt::Display) -> Self {
        Self(format!("{}: {message}", path.display()))
    }

    /// A failure of one cell: `path:line: column NAME: message`.
    pub fn in_cell(path: &Path, line: u64, column: &str, message: impl fmt::Display) -> Self {
        Self(format!(
            "{}:{line}: column {column}: {message}",
            path.display()
        ))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Failure {}

impl From<dashpot_core::BuildError> for Failure {
    fn from(error: dashpot_core::BuildError) -> Self {
        Self(error.to_string())
    }
}
