//! Profile files of wheels and rails.

use std::path::Path;

use dashpot_rail::profile::measured::{self, Options, ProfileError, Reading};
use dashpot_rail::profile::{Body, Profile};

use super::{FileError, input};

/// Reads the profile of `body` at `path`, where `-` is standard input, as [`measured::parse`] does.
///
/// Letters that are not UTF-8 are replaced: they stand in comments, in whatever encoding a gauge's computer had.
///
/// # Errors
/// The file cannot be read, or the errors of [`measured::parse`] with file, line and column.
pub fn read(path: &Path, body: Body, options: &Options) -> Result<(Profile, Reading), FileError> {
    let bytes = input::read(path)?;
    let path = &*input::name(path);
    let text = String::from_utf8_lossy(&bytes);
    measured::parse(&path.to_string_lossy(), &text, body, options)
        .map_err(|error| in_file(path, error))
}

fn in_file(path: &Path, error: ProfileError) -> FileError {
    match (error.line(), error.column()) {
        (Some(line), Some(column)) => FileError::in_cell(path, line, column, error),
        (Some(line), None) => FileError::in_line(path, line, error),
        (None, _) => FileError::in_file(path, error),
    }
}
