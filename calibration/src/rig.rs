//! The numbers of the rig: what the sensors do to a recording. They are found beside those of the damper, and no damper file has them.

use serde::Serialize;

use super::CalibrationError;
use super::loops::LoopTest;

/// Key of the time by which the force is recorded later than the displacement (s).
pub const SKEW: &str = "sensor_skew_s";

/// Key of what the force sensor shows at no force (N).
pub const FORCE_OFFSET: &str = "force_offset_n";

/// Key of what the displacement sensor shows at the middle of the motion (m). No force of a damper depends on it, so it is reported for each
/// test and never varied.
pub const DISPLACEMENT_OFFSET: &str = "displacement_offset_m";

/// The numbers of the rig that forces determine.
pub const RIG: [&str; 2] = [SKEW, FORCE_OFFSET];

/// Default bounds of the skew (s).
const SKEW_BOUNDS_S: [f64; 2] = [-0.02, 0.02];

/// Default bounds of the force offset, as a share of half of the way from the least to the greatest force.
const OFFSET_SHARE: f64 = 0.5;

/// The largest skew (s) and force offset (N) that bounds may include.
const LARGEST: [f64; 2] = [1.0, 1e7];

/// Values of the rig's numbers where they are not varied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct HeldRig {
    /// Time by which the force is recorded later (s).
    pub skew_s: f64,
    /// What the force sensor shows at no force (N).
    pub force_offset_n: f64,
}

/// Whether the number at `key` belongs to the rig.
pub fn is_of_rig(key: &str) -> bool {
    RIG.contains(&key)
}

/// The default bounds of the rig's number at `key` for these loops.
pub(super) fn default_bounds(key: &str, loops: &[LoopTest]) -> [f64; 2] {
    if key == SKEW {
        return SKEW_BOUNDS_S;
    }
    let half_ranges = loops.iter().map(|test| test.force_half_range_n);
    let most = OFFSET_SHARE * half_ranges.fold(0.0, f64::max);
    [-most, most]
}

/// The largest magnitude that the rig's number at `key` may have.
pub(super) fn largest(key: &str) -> f64 {
    LARGEST[usize::from(key == FORCE_OFFSET)]
}

/// # Errors
/// Bounds of the rig's number at `key` that are not in order or go beyond what a rig can have.
pub(super) fn check_bounds(
    key: &str,
    bounds: [f64; 2],
    default: [f64; 2],
) -> Result<(), CalibrationError> {
    let [least, greatest] = bounds;
    let most = largest(key);
    if least < greatest && -most <= least && greatest <= most {
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
