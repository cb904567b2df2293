//! Checks of constant names and include names.

use std::path::Path;

use super::error::{C_LIBRARY_PREFIX, RESERVED_SUFFIXES};
use super::{ExportError, NameError};
use dashpot_files::input::is_standard_stream;

/// Checks a constant name: a capital letter, then capitals, digits and `_`. No keyword of Rust, C or C++ has this form.
pub(super) fn check(name: &str) -> Result<(), ExportError> {
    let valid = name.starts_with(|first: char| first.is_ascii_uppercase())
        && name
            .chars()
            .all(|letter| letter.is_ascii_uppercase() || letter.is_ascii_digit() || letter == '_');
    if valid {
        Ok(())
    } else {
        Err(name_error(name, NameError::Invalid))
    }
}

/// Same as [`check`], but also rejects macros of `dashpot.h` and of the headers that exported C sources include.
pub(super) fn check_c(name: &str) -> Result<(), ExportError> {
    check(name)?;
    if name == "NULL"
        || name.starts_with(C_LIBRARY_PREFIX)
        || RESERVED_SUFFIXES
            .iter()
            .any(|suffix| name.ends_with(suffix))
    {
        return Err(name_error(name, NameError::Reserved));
    }
    Ok(())
}

/// Derives a constant name from a preset or a file: MY_DAMPER for `data/my-damper.toml`, DAMPER for standard input.
///
/// ```
/// assert_eq!(dashpot_export::constant_name("data/my-damper.toml"), "MY_DAMPER");
/// ```
pub fn constant_name(damper: &str) -> String {
    if is_standard_stream(Path::new(damper)) {
        return "DAMPER".into();
    }
    let stem = Path::new(damper)
        .file_stem()
        .map_or_else(|| damper.into(), |stem| stem.to_string_lossy());
    let name: String = stem
        .chars()
        .map(|letter| {
            if letter.is_ascii_alphanumeric() {
                letter.to_ascii_uppercase()
            } else {
                '_'
            }
        })
        .collect();
    if name.starts_with(|first: char| first.is_ascii_uppercase()) {
        name
    } else {
        format!("DAMPER_{name}")
    }
}

fn name_error(name: &str, reason: NameError) -> ExportError {
    let name = name.to_owned();
    ExportError::Name { name, reason }
}

/// Checks that a file name is valid between the quotation marks of an `#include`.
pub(super) fn checked_include(file: &str) -> Result<&str, ExportError> {
    let is_invalid = |letter: char| {
        letter.is_control() || ['"', '\\', char::REPLACEMENT_CHARACTER].contains(&letter)
    };
    if file.is_empty() || file.contains(is_invalid) {
        return Err(ExportError::Include { file: file.into() });
    }
    Ok(file)
}
