//! Profiles of wheels and rails, built in or from files.

mod tilt;

use std::path::Path;

pub use tilt::{RailTilt, TiltBasis, rail_tilt};

use dashpot_rail::profile::measured::{self, Options, ProfileError, Reading};
use dashpot_rail::profile::{Body, Profile, s1002, uic60};

use super::{FileError, input};

/// Error from loading a profile.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NamedProfileError {
    /// Smoothing wavelength (m) out of range.
    #[error("smoothing_m: {0}, allowed: 0 to 0.05 m")]
    Smoothing(f64),
    /// A format or mirror was given for a built-in profile.
    #[error("{known} is built in; a format or mirror is allowed for profile files only")]
    BuiltIn {
        /// Name of the profile.
        known: &'static str,
    },
    /// The name is neither the built-in profile nor a file.
    #[error("{name}: no such profile, allowed: {known} or a profile file")]
    Unknown {
        /// The unknown name.
        name: String,
        /// Name of the built-in profile.
        known: &'static str,
    },
    /// Cannot use the file.
    #[error(transparent)]
    File(#[from] FileError),
}

/// Loads the profile of `body` called `name`: built in (`s1002`, `uic60`) or a file. For a file, it also returns a
/// report on how the file was read.
///
/// # Errors
/// Returns an error for an unknown profile or options that do not apply to it; for a file, also the errors of [`read`].
///
/// ```
/// use dashpot_files::profile;
/// use dashpot_rail::profile::{Body, measured::Options};
/// let (wheel, reading) = profile::load("s1002", Body::Wheel, &Options::default())?;
/// assert!(reading.is_none());
/// assert!(profile::load("uic60", Body::Wheel, &Options::default()).is_err());
/// # Ok::<(), profile::NamedProfileError>(())
/// ```
pub fn load(
    name: &str,
    body: Body,
    options: &Options,
) -> Result<(Profile, Option<Reading>), NamedProfileError> {
    let (known, built_in) = match body {
        Body::Wheel => ("s1002", s1002::profile as fn() -> Profile),
        Body::Rail => ("uic60", uic60::profile as fn() -> Profile),
    };
    if !(0.0..=0.05).contains(&options.smoothing_m) {
        return Err(NamedProfileError::Smoothing(options.smoothing_m));
    }
    if name.eq_ignore_ascii_case(known) {
        return match options.format.is_some() || options.mirror.is_some() {
            true => Err(NamedProfileError::BuiltIn { known }),
            false => Ok((built_in(), None)),
        };
    }
    let path = Path::new(name);
    if input::is_file_name(path) || path.exists() {
        let (profile, reading) = read(path, body, options)?;
        return Ok((profile, Some(reading)));
    }
    let name = name.to_owned();
    Err(NamedProfileError::Unknown { name, known })
}

/// Reads the profile of `body` at `path` (`-` for standard input) with [`measured::parse`].
///
/// Bytes that are not UTF-8 are replaced, because comments may be in the encoding of the profile gauge's computer.
///
/// # Errors
/// Returns an error if the file cannot be read, and the errors of [`measured::parse`] with file, line and column.
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
