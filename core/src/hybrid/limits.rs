//! Checks of settings.

use crate::BuildError;

/// Checks that `value` lies from `least` to `most`.
///
/// # Errors
/// `value` is outside, or is not a number.
pub(super) fn within(
    (section, field): (&'static str, &'static str),
    value: f32,
    (least, most): (f32, f32),
    allowed: &'static str,
) -> Result<(), BuildError> {
    match value >= least && value <= most {
        true => Ok(()),
        false => Err(refused((section, field), value, allowed)),
    }
}

/// The error for `value`.
pub(super) fn refused(
    (section, field): (&'static str, &'static str),
    value: f32,
    allowed: &'static str,
) -> BuildError {
    BuildError::new(section, field, widened(value), allowed)
}

/// `value` in double precision; a subnormal number counts as 0. A processor for single precision converts by a function
/// of double precision in software, and the C library promises to contain none.
fn widened(value: f32) -> f64 {
    let bits = u64::from(value.to_bits());
    let (sign, fraction) = (bits >> 31 << 63, bits & 0x7f_ffff);
    let exponent = match bits >> 23 & 0xff {
        0 => return f64::from_bits(sign),
        0xff => 0x7ff,
        exponent => exponent + (1023 - 127),
    };
    f64::from_bits(sign | exponent << 52 | fraction << 29)
}

/// Checks the step of a test (s).
pub(super) fn step(section: &'static str, step_s: f32) -> Result<(), BuildError> {
    within((section, "step_s"), step_s, (1e-5, 0.02), "1e-5 to 0.02")
}

/// Share of the past that fades in a step, for an exponential window of `window_s`.
pub(super) fn fading(step_s: f32, window_s: f32) -> f32 {
    1.0 - libm::expf(-step_s / window_s)
}

/// `value` limited to `most` in either direction; `most` if it is not a number.
#[inline]
pub(super) fn clamped(value: f32, most: f32) -> f32 {
    if value < most {
        if value > -most { value } else { -most }
    } else {
        most
    }
}

/// `value` if its magnitude is at most `most`, else 0: a number that no sensor delivers must not spoil sums.
#[inline]
pub(super) fn credible(value: f32, most: f32) -> f32 {
    if value.abs() <= most { value } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::widened;

    #[test]
    fn a_number_is_the_same_in_double_precision() {
        for value in [
            0.0,
            -0.0,
            1.0,
            -0.1,
            f32::MAX,
            f32::MIN_POSITIVE,
            f32::INFINITY,
            f32::NEG_INFINITY,
        ] {
            assert_eq!(widened(value).to_bits(), f64::from(value).to_bits());
        }
        assert!(widened(f32::NAN).is_nan());
        assert_eq!(widened(f32::from_bits(1)), 0.0);
    }
}
