//! Radial pressure profile.

use serde::Serialize;

use super::PlateError;
use super::limits::{check_exponent, invalid};

/// Pressure as a function of the radius, divided by the full pressure: 1 from `full_m[0]` to `full_m[1]`, decaying to
/// zero at `ends_m` as `((r - end)/(full - end))^n`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Profile {
    /// Inner and outer radius of the area under full pressure (m).
    pub full_m: [f64; 2],
    /// Radii at which the pressure has decayed to zero (m); equal to `full_m` for no decay.
    pub ends_m: [f64; 2],
    /// Exponent n of the decay (1): 1 linear, 2 quadratic.
    pub exponent: f64,
}

impl Profile {
    /// Returns a profile with full pressure between two radii (m) and no pressure outside.
    pub fn full(inner_m: f64, outer_m: f64) -> Self {
        let radii = [inner_m, outer_m];
        Self {
            full_m: radii,
            ends_m: radii,
            exponent: 2.0,
        }
    }

    /// Returns the pressure at a radius (m), divided by the full pressure.
    pub fn at(&self, radius_m: f64) -> f64 {
        let ([inner, outer], [start, end]) = (self.full_m, self.ends_m);
        if (inner..=outer).contains(&radius_m) {
            1.0
        } else if start < radius_m && radius_m < inner {
            ((radius_m - start) / (inner - start)).powf(self.exponent)
        } else if outer < radius_m && radius_m < end {
            ((end - radius_m) / (end - outer)).powf(self.exponent)
        } else {
            0.0
        }
    }

    pub(super) fn check(&self, clamp_m: f64, free_m: f64) -> Result<(), PlateError> {
        let ([inner, outer], [start, end]) = (self.full_m, self.ends_m);
        let listed = |radii: [f64; 2]| format!("{} to {} m", radii[0], radii[1]);
        // The slack absorbs rounding, so that a radius given as 0.029 counts as equal to a free radius of 0.029.
        let (clamp, free) = (clamp_m * (1.0 - 1e-12), free_m * (1.0 + 1e-12));
        if !(clamp <= inner && inner < outer && outer <= free) {
            return Err(invalid(
                "loaded_radii_m",
                listed(self.full_m),
                format!("rising, within the free part of the disc, {clamp_m} to {free_m} m"),
            ));
        }
        if !(clamp <= start && start <= inner && outer <= end && end <= free) {
            return Err(invalid(
                "decay_radii_m",
                listed(self.ends_m),
                format!("around the loaded radii, within {clamp_m} to {free_m} m"),
            ));
        }
        check_exponent(self.exponent)
    }
}
