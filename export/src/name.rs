//! Names that a constant may have.

use super::ExportError;
use super::error::{C_LIBRARY_PREFIX, RESERVED_ENDS};

/// A capital first, then capitals, digits and `_`: no keyword of Rust, C or C++ is written so.
pub(super) fn check(name: &str) -> Result<(), ExportError> {
    let valid = name.starts_with(|first: char| first.is_ascii_uppercase())
        && name
            .chars()
            .all(|letter| letter.is_ascii_uppercase() || letter.is_ascii_digit() || letter == '_');
    if valid {
        Ok(())
    } else {
        Err(ExportError::Name { name: name.into() })
    }
}

/// As [`check`], and no macro of `dashpot.h` or of the headers an exported C source includes.
pub(super) fn check_c(name: &str) -> Result<(), ExportError> {
    check(name)?;
    if name == "NULL"
        || name.starts_with(C_LIBRARY_PREFIX)
        || RESERVED_ENDS.iter().any(|end| name.ends_with(end))
    {
        return Err(ExportError::ReservedName { name: name.into() });
    }
    Ok(())
}

/// A file's name that may stand between the quotation marks of an `#include`.
pub(super) fn checked_include(file: &str) -> Result<&str, ExportError> {
    let unfit = |letter: char| {
        letter.is_control() || ['"', '\\', char::REPLACEMENT_CHARACTER].contains(&letter)
    };
    if file.is_empty() || file.contains(unfit) {
        return Err(ExportError::Include { file: file.into() });
    }
    Ok(file)
}
