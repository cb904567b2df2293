//! Names that a constant may have.

use crate::error::{Failure, Outcome};

/// A capital first, then capitals, digits and `_`: no keyword of Rust, C or C++ is written so.
pub(super) fn check(name: &str) -> Outcome<()> {
    let valid = name.starts_with(|first: char| first.is_ascii_uppercase())
        && name
            .chars()
            .all(|letter| letter.is_ascii_uppercase() || letter.is_ascii_digit() || letter == '_');
    if valid {
        Ok(())
    } else {
        Err(Failure::wrong_use(format!(
            "--name {name}: no name of a constant, allowed: A to Z first, then A to Z, 0 to 9 and _"
        )))
    }
}

/// What the macros of `dashpot.h` and the guards of exported headers start with.
pub(super) const C_LIBRARY_PREFIX: &str = "DASHPOT_";

/// As [`check`], and no macro of `dashpot.h` or of the headers an exported C source includes.
pub(super) fn check_c(name: &str) -> Outcome<()> {
    check(name)?;
    let taken = ["_MAX", "_MIN", "_C", "_WIDTH"];
    if name == "NULL"
        || name.starts_with(C_LIBRARY_PREFIX)
        || taken.iter().any(|end| name.ends_with(end))
    {
        return Err(Failure::wrong_use(format!(
            "--name {name}: the C headers may define it, allowed: not NULL, no start with {C_LIBRARY_PREFIX}, \
             no end in {}",
            taken.join(", ")
        )));
    }
    Ok(())
}
