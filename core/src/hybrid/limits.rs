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
        false => Err(BuildError::new(section, field, f64::from(value), allowed)),
    }
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
