//! Measured profiles of wheels and rails: two columns in mm.

use std::path::Path;

use dashpot_rail::profile::measured::{self, ProfileError};
use dashpot_rail::profile::{Body, Profile};

use super::{FileError, input};

/// Reads the profile of `body` at `path`, where `-` is standard input; format and `smoothing_m` are those of
/// [`measured::parse`].
///
/// # Errors
/// The file cannot be read, or the errors of [`measured::parse`] with file, line and column.
pub fn read(path: &Path, body: Body, smoothing_m: f64) -> Result<Profile, FileError> {
    let text = input::read_text(path)?;
    let path = &*input::name(path);
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    measured::parse(name, &text, body, smoothing_m).map_err(|error| in_file(path, error))
}

fn in_file(path: &Path, error: ProfileError) -> FileError {
    match error.cell() {
        Some((line, column)) => FileError::in_cell(path, line, column, error),
        None => FileError::in_file(path, error),
    }
}
