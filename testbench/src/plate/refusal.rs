//! What numbers of a pressure area may be.

use super::PlateError;

/// Most bosses over the circumference.
const MOST_BOSSES: u32 = 36;
/// Largest exponent of a decay.
const LARGEST_EXPONENT: f64 = 10.0;

pub(super) fn check_count(count: u32) -> Result<(), PlateError> {
    if (1..=MOST_BOSSES).contains(&count) {
        return Ok(());
    }
    let allowed = format!("1 to {MOST_BOSSES}");
    Err(refused("bosses", count.to_string(), allowed))
}

pub(super) fn check_exponent(exponent: f64) -> Result<(), PlateError> {
    if 0.0 < exponent && exponent <= LARGEST_EXPONENT {
        return Ok(());
    }
    let allowed = format!("above 0 and at most {LARGEST_EXPONENT}");
    Err(refused("decay_exponent", exponent.to_string(), allowed))
}

pub(super) fn refused(key: &'static str, given: String, allowed: String) -> PlateError {
    PlateError::Area {
        key,
        given,
        allowed,
    }
}
