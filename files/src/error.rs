//! Why a file cannot be used.

use std::error::Error;
use std::io;
use std::path::{Path, PathBuf};

/// Why a file cannot be used: which one, where in it, and what is allowed there.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file or standard input cannot be read.
    #[error("{}: cannot read: {source}", path.display())]
    Read {
        /// The file, or the name of the stream.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The file or standard output cannot be written.
    #[error("{}: cannot write: {source}", path.display())]
    Write {
        /// The file, or the name of the stream.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A folder for files cannot be made.
    #[error("{}: cannot make the folder: {source}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// What the file holds is not as it must be.
    #[error("{}: {source}", path.display())]
    Content {
        /// The file, or the name of the stream.
        path: PathBuf,
        /// What is wrong, and what is allowed.
        source: Box<dyn Error + Send + Sync>,
    },
    /// One line of the file is not as it must be.
    #[error("{}:{line}: {source}", path.display())]
    Line {
        /// The file, or the name of the stream.
        path: PathBuf,
        /// Line of the file, from 1.
        line: u64,
        /// What is wrong, and what is allowed.
        source: Box<dyn Error + Send + Sync>,
    },
    /// One cell of a table in the file is not as it must be.
    #[error("{}:{line}: column {column}: {source}", path.display())]
    Cell {
        /// The file, or the name of the stream.
        path: PathBuf,
        /// Line of the file, from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// What is wrong, and what is allowed.
        source: Box<dyn Error + Send + Sync>,
    },
    /// One value of a table in the file, which has no lines, is not as it must be.
    #[error("{}: row {row}: column {column}: {source}", path.display())]
    Row {
        /// The file.
        path: PathBuf,
        /// Row of the table, from 1.
        row: u64,
        /// Name of the column.
        column: String,
        /// What is wrong, and what is allowed.
        source: Box<dyn Error + Send + Sync>,
    },
}

impl FileError {
    /// The file at `path` cannot be read.
    pub fn read(path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        Self::Read { path, source }
    }

    /// What the file at `path` holds is not as it must be.
    pub fn in_file(path: &Path, source: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self::Content {
            path: path.to_owned(),
            source: source.into(),
        }
    }

    /// A line of the file at `path` is not as it must be.
    pub fn in_line(
        path: &Path,
        line: u64,
        source: impl Into<Box<dyn Error + Send + Sync>>,
    ) -> Self {
        Self::Line {
            path: path.to_owned(),
            line,
            source: source.into(),
        }
    }

    /// A cell of the file at `path` is not as it must be.
    pub fn in_cell(
        path: &Path,
        line: u64,
        column: impl Into<String>,
        source: impl Into<Box<dyn Error + Send + Sync>>,
    ) -> Self {
        Self::Cell {
            path: path.to_owned(),
            line,
            column: column.into(),
            source: source.into(),
        }
    }

    /// A value of the table in the file at `path`, which has no lines, is not as it must be.
    pub fn in_row(
        path: &Path,
        row: u64,
        column: impl Into<String>,
        source: impl Into<Box<dyn Error + Send + Sync>>,
    ) -> Self {
        Self::Row {
            path: path.to_owned(),
            row,
            column: column.into(),
            source: source.into(),
        }
    }

    /// Whether the file was a pipe whose reader has left: nothing is wrong with it.
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, Self::Write { source, .. } if source.kind() == io::ErrorKind::BrokenPipe)
    }
}
