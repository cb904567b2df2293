//! Errors from reading and writing files.

use std::error::Error;
use std::io;
use std::path::{Path, PathBuf};

/// Error from reading or writing a file. It names the file, the position in it and the allowed values.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// Cannot read the file or standard input.
    #[error("{}: cannot read: {source}", path.display())]
    Read {
        /// The file, or the name of the standard stream.
        path: PathBuf,
        /// Error from the operating system.
        source: io::Error,
    },
    /// Cannot write the file or standard output.
    #[error("{}: cannot write: {source}", path.display())]
    Write {
        /// The file, or the name of the standard stream.
        path: PathBuf,
        /// Error from the operating system.
        source: io::Error,
    },
    /// Cannot create a directory.
    #[error("{}: cannot create the directory: {source}", path.display())]
    Folder {
        /// The directory.
        path: PathBuf,
        /// Error from the operating system.
        source: io::Error,
    },
    /// Invalid file content.
    #[error("{}: {source}", path.display())]
    Content {
        /// The file, or the name of the standard stream.
        path: PathBuf,
        /// The problem, and the allowed values.
        source: Box<dyn Error + Send + Sync>,
    },
    /// Invalid line.
    #[error("{}:{line}: {source}", path.display())]
    Line {
        /// The file, or the name of the standard stream.
        path: PathBuf,
        /// Line of the file, from 1.
        line: u64,
        /// The problem, and the allowed values.
        source: Box<dyn Error + Send + Sync>,
    },
    /// Invalid cell of a text table.
    #[error("{}:{line}: column {column}: {source}", path.display())]
    Cell {
        /// The file, or the name of the standard stream.
        path: PathBuf,
        /// Line of the file, from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// The problem, and the allowed values.
        source: Box<dyn Error + Send + Sync>,
    },
    /// Invalid value of a table in a binary file, which has rows but no lines.
    #[error("{}: row {row}: column {column}: {source}", path.display())]
    Row {
        /// The file.
        path: PathBuf,
        /// Row of the table, from 1.
        row: u64,
        /// Name of the column.
        column: String,
        /// The problem, and the allowed values.
        source: Box<dyn Error + Send + Sync>,
    },
}

impl FileError {
    /// Error for a file that cannot be read.
    pub fn read(path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        Self::Read { path, source }
    }

    /// Error for invalid content of the file at `path`.
    pub fn in_file(path: &Path, source: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self::Content {
            path: path.to_owned(),
            source: source.into(),
        }
    }

    /// Error for an invalid line of the file at `path`; lines count from 1.
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

    /// Error for an invalid cell of the file at `path`; lines count from 1.
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

    /// Error for an invalid table value in a binary file at `path`; rows count from 1.
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

    /// True if the output was a pipe and its reader has closed it, which is not a failure.
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, Self::Write { source, .. } if source.kind() == io::ErrorKind::BrokenPipe)
    }
}
