//! Profile files of wheels and rails.

use std::path::Path;

use dashpot_rail::profile::measured::{self, Options, ProfileError, Reading};
use dashpot_rail::profile::{Body, Profile, s1002, uic60};

use super::{FileError, input};

/// Why there is no profile.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NamedProfileError {
    /// A wavelength that no profile is smoothed by.
    #[error("smoothing_m: {0}, allowed: 0 to 0.05 m")]
    Smoothing(f64),
    /// A built-in profile is read in no format.
    #[error("{known} is built in; allowed with a format or mirror: a profile file")]
    BuiltIn {
        /// The profile.
        known: &'static str,
    },
    /// The name is neither the built-in profile's nor a file's.
    #[error("{name}: no such profile, allowed: {known} or a profile file")]
    Unknown {
        /// The name.
        name: String,
        /// The built-in profile.
        known: &'static str,
    },
    /// The file cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
}

/// The profile of `body` called `name`: the built-in one, `s1002` or `uic60`, or a file, with what was read of that.
///
/// # Errors
/// No such profile, options that there are not for it, or as [`read`].
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
