//! Limits on the values of a pressure area.

use super::PlateError;

/// Maximum number of bosses.
const MAX_BOSSES: u32 = 36;
/// Maximum exponent of a decay.
const MAX_EXPONENT: f64 = 10.0;

pub(super) fn check_count(count: u32) -> Result<(), PlateError> {
    if (1..=MAX_BOSSES).contains(&count) {
        return Ok(());
    }
    let allowed = format!("1 to {MAX_BOSSES}");
    Err(invalid("bosses", count.to_string(), allowed))
}

pub(super) fn check_exponent(exponent: f64) -> Result<(), PlateError> {
    if 0.0 < exponent && exponent <= MAX_EXPONENT {
        return Ok(());
    }
    let allowed = format!("above 0 and at most {MAX_EXPONENT}");
    Err(invalid("decay_exponent", exponent.to_string(), allowed))
}

pub(super) fn invalid(key: &'static str, given: String, allowed: String) -> PlateError {
    PlateError::Area {
        key,
        given,
        allowed,
    }
}
