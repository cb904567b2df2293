//! What went wrong, told to a person: what, where, what is allowed.

use std::fmt;
use std::io;
use std::path::Path;

use dashpot_rail::contact::PairError;

/// A failure with a message that names the place and what is allowed there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    kind: Kind,
    message: String,
}

/// What a failure means for the command; the exit code follows from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A file, the system or a result is not as it must be.
    Failed,
    /// The caller asked for something that is not allowed: an option's value, or options together.
    WrongUse,
    /// Whoever read the output has left: nothing is wrong, nobody is to be told.
    ReaderGone,
}

/// Result of everything on the host that can fail.
pub type Outcome<T> = Result<T, Failure>;

impl Failure {
    /// A failure told by `message`.
    pub fn new(message: impl Into<String>) -> Self {
        Self {
            kind: Kind::Failed,
            message: message.into(),
        }
    }

    /// Something asked for that is not allowed; `message` names the option and what is allowed.
    pub fn wrong_use(message: impl Into<String>) -> Self {
        Self {
            kind: Kind::WrongUse,
            message: message.into(),
        }
    }

    /// A failure of the file at `path`: `path: message`.
    pub fn in_file(path: &Path, message: impl fmt::Display) -> Self {
        Self::new(format!("{}: {message}", path.display()))
    }

    /// A failure of one cell: `path:line: column NAME: message`.
    pub fn in_cell(path: &Path, line: u64, column: &str, message: impl fmt::Display) -> Self {
        Self::new(format!(
            "{}:{line}: column {column}: {message}",
            path.display()
        ))
    }

    /// A failure to write the file at `path`; a pipe that nobody reads any more is [`Kind::ReaderGone`].
    pub fn in_writing(path: &Path, error: impl Into<io::Error>) -> Self {
        let error = error.into();
        let kind = match error.kind() {
            io::ErrorKind::BrokenPipe => Kind::ReaderGone,
            _ => Kind::Failed,
        };
        Self {
            kind,
            ..Self::in_file(path, format!("cannot write: {error}"))
        }
    }

    /// What the failure means for the command.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The same message as wrong use: the place that failed came from the command line.
    #[must_use]
    pub fn into_wrong_use(self) -> Self {
        Self::wrong_use(self.message)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

impl From<dashpot_core::BuildError> for Failure {
    fn from(error: dashpot_core::BuildError) -> Self {
        Self::new(error.to_string())
    }
}

impl From<dashpot_reference::ReferenceError> for Failure {
    fn from(error: dashpot_reference::ReferenceError) -> Self {
        Self::new(error.to_string())
    }
}

impl From<PairError> for Failure {
    fn from(error: PairError) -> Self {
        match error {
            PairError::Installation(_) => Self::wrong_use(error.to_string()),
            _ => Self::new(error.to_string()),
        }
    }
}
