//! Rig parameters: skew and offset of the sensors. They are calibrated together with the damper and are not part of a
//! damper file.

use serde::Serialize;

use super::CalibrationError;
use super::keys::{FORCE_OFFSET, RIG, SKEW};
use super::loops::LoopTest;

/// Default bounds of the skew (s).
const SKEW_BOUNDS_S: [f64; 2] = [-0.02, 0.02];

/// Default bounds of the force offset, as a share of half the range of the force.
const OFFSET_SHARE: f64 = 0.5;

/// Maximum magnitude of the skew (s).
const MAX_SKEW_S: f64 = 1.0;

/// Maximum magnitude of the force offset (N).
const MAX_FORCE_OFFSET_N: f64 = 1e7;

/// Values of the rig parameters that are not varied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct HeldRig {
    /// Delay of the recorded force relative to the displacement (s).
    pub skew_s: f64,
    /// Reading of the force sensor at zero force (N).
    pub force_offset_n: f64,
}

/// True if `key` is a rig parameter.
pub fn is_rig_parameter(key: &str) -> bool {
    RIG.contains(&key)
}

/// Returns the default bounds of a rig parameter for these loops.
pub(super) fn default_bounds(key: &str, loops: &[LoopTest]) -> [f64; 2] {
    if key == SKEW {
        return SKEW_BOUNDS_S;
    }
    let half_ranges = loops.iter().map(|test| test.force_half_range_n);
    let max = OFFSET_SHARE * half_ranges.fold(0.0, f64::max);
    [-max, max]
}

/// Returns the maximum magnitude of a rig parameter.
pub(super) fn max_magnitude(key: &str) -> f64 {
    if key == FORCE_OFFSET {
        MAX_FORCE_OFFSET_N
    } else {
        MAX_SKEW_S
    }
}

/// Checks the bounds of a rig parameter; `default` are its default bounds.
///
/// # Errors
/// Returns an error if the bounds are not in order or are out of range.
pub(super) fn check_bounds(
    key: &str,
    bounds: [f64; 2],
    default: [f64; 2],
) -> Result<(), CalibrationError> {
    let [lower, upper] = bounds;
    let max = max_magnitude(key);
    if lower < upper && -max <= lower && upper <= max {
        return Ok(());
    }
    Err(CalibrationError::Bounds {
        key: key.into(),
        bounds,
        allowed: if key == SKEW {
            "-1 to 1 s"
        } else {
            "-1e7 to 1e7 N"
        },
        plausible: default,
    })
}
