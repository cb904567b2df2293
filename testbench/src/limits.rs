//! Limits of tests.

use std::ops::RangeInclusive;

/// Allowed number of steps per cycle.
pub const STEPS_PER_CYCLE: RangeInclusive<f64> = 20.0..=2e7;

/// Maximum number of steps of a sweep: a few minutes of computing.
pub const MAX_SWEEP_STEPS: f64 = 2e9;
