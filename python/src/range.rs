//! Ranges of arguments.

use dashpot_core::parameters::STEP_RANGE_S;
use dashpot_testbench::TestbenchError;

use crate::error::{Outcome, refuse};

/// Checks that an argument is within its range.
pub fn within(name: &str, value: f64, [min, max]: [f64; 2]) -> Outcome<f64> {
    if (min..=max).contains(&value) {
        return Ok(value);
    }
    refuse(format!("{name}: {value}, allowed: {min} to {max}"))
}

/// Checks a step (s) of the core.
pub fn check_step(step_s: f64) -> Outcome<()> {
    match STEP_RANGE_S.contains(&step_s) {
        true => Ok(()),
        false => Err(TestbenchError::Step { step_s }.into()),
    }
}
