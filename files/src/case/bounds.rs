//! Bounds of a case's numbers.

use dashpot_rail::contact::MAX_NORMAL_DAMPING_S_PER_M;
use dashpot_rail::vehicle::{SPEED_M_PER_S, STEP_S};

use super::{CaseError, CaseOptions};

/// Maximum initial lateral offset, m; flange contact begins at about 6 mm.
const MAX_PUSH_M: f64 = 0.02;

/// Checks all numbers; `friction` is the coefficient after the overrides.
pub(super) fn check(options: &CaseOptions, friction: f64) -> Result<(), CaseError> {
    let steps_us = STEP_S.map(|step_s| (step_s * 1e6).round());
    let numbers = [
        (
            "speed_km_h",
            options.speed_km_h,
            SPEED_M_PER_S.map(|speed| 3.6 * speed),
        ),
        ("duration_s", options.duration_s, [1e-3, 36e3]),
        ("start_m", options.start_m, [-1e6, 1e6]),
        ("friction", friction, [0.0, 2.0]),
        (
            "normal_damping_s_per_m",
            options.normal_damping_s_per_m,
            [0.0, MAX_NORMAL_DAMPING_S_PER_M],
        ),
        ("step_us", options.step_us, steps_us),
        ("push_m", options.push_m, [-MAX_PUSH_M, MAX_PUSH_M]),
    ];
    for (key, value, allowed) in numbers {
        check_bounds(key, value, allowed)?;
    }
    Ok(())
}

/// Checks one number; NaN is out of bounds.
pub(super) fn check_bounds(
    key: &'static str,
    value: f64,
    [min, max]: [f64; 2],
) -> Result<(), CaseError> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(CaseError::OutOfBounds {
        key,
        value,
        min,
        max,
    })
}
