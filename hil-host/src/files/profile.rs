//! Measured profiles of wheels and rails: two columns in mm.

use std::path::Path;

use dashpot_rail::profile::measured::{self, ProfileError};
use dashpot_rail::profile::{Body, Profile};

use super::input;
use crate::error::{Failure, Outcome};

/// Reads the profile of `body` at `path`, where `-` is standard input; format and `smoothing_m` are those of
/// [`measured::parse`].
///
/// # Errors
/// The file cannot be read, or the errors of [`measured::parse`] with file, line and column.
pub fn read(path: &Path, body: Body, smoothing_m: f64) -> Outcome<Profile> {
    let text = input::read_text(path)?;
    let path = &*input::name(path);
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    measured::parse(name, &text, body, smoothing_m).map_err(|error| in_file(path, &error))
}

fn in_file(path: &Path, error: &ProfileError) -> Failure {
    match error.cell() {
        Some((line, column)) => Failure::in_cell(path, line, column, error),
        None => Failure::in_file(path, error),
    }
}
