//! Round bosses.

use std::f64::consts::PI;

use serde::Serialize;

use super::PlateError;
use super::limits::{check_count, check_exponent, invalid};
use super::quadrature::integral;

/// Equal, evenly spaced round bosses: full pressure over the hole, decaying to zero at the edge of the boss as
/// `((b - d)/(b - a))^n`, where d is the distance from the centre.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RoundBosses {
    /// Number of bosses N.
    pub count: u32,
    /// Radius of the pitch circle through the centres (m).
    pub pitch_radius_m: f64,
    /// Radius a of a hole (m); at most the radius of the boss.
    pub hole_radius_m: f64,
    /// Radius b of a boss (m).
    pub boss_radius_m: f64,
    /// Exponent n of the decay (1).
    pub exponent: f64,
}

impl RoundBosses {
    pub(super) fn at_distance(&self, distance_m: f64) -> f64 {
        let (hole, boss) = (self.hole_radius_m, self.boss_radius_m);
        if distance_m <= hole {
            1.0
        } else if distance_m < boss {
            ((boss - distance_m) / (boss - hole)).powf(self.exponent)
        } else {
            0.0
        }
    }

    pub(super) fn distance_m(&self, radius_m: f64, angle_rad: f64) -> f64 {
        let pitch = self.pitch_radius_m;
        let half = (0.5 * angle_rad).sin();
        let apart = radius_m - pitch;
        (apart * apart + 4.0 * radius_m * pitch * half * half).sqrt()
    }

    /// Returns half the angle (rad) that a circle around the centre of a boss covers at a radius.
    fn half_angle(&self, radius_m: f64, circle_radius_m: f64) -> f64 {
        let pitch = self.pitch_radius_m;
        let apart = radius_m - pitch;
        let square = (circle_radius_m * circle_radius_m - apart * apart) / (4.0 * radius_m * pitch);
        2.0 * square.max(0.0).sqrt().min(1.0).asin()
    }

    pub(super) fn harmonic(&self, k: u32, radius_m: f64) -> f64 {
        let order = f64::from(k * self.count);
        let full = self.half_angle(radius_m, self.hole_radius_m);
        let end = self.half_angle(radius_m, self.boss_radius_m);
        let within_hole = if k == 0 {
            full
        } else {
            (order * full).sin() / order
        };
        let split = 0.5 * (full + end);
        let decay =
            |angle: f64| self.at_distance(self.distance_m(radius_m, angle)) * (order * angle).cos();
        let around_hole = integral(full, split, decay) + integral(split, end, decay);
        let both_sides = if k == 0 { 1.0 } else { 2.0 };
        both_sides * f64::from(self.count) / PI * (within_hole + around_hole)
    }

    pub(super) fn check(&self, clamp_m: f64, free_m: f64) -> Result<(), PlateError> {
        check_count(self.count)?;
        check_exponent(self.exponent)?;
        let (pitch, boss) = (self.pitch_radius_m, self.boss_radius_m);
        if !(clamp_m < pitch && pitch < free_m) {
            return Err(invalid(
                "pitch_radius_m",
                format!("{pitch} m"),
                format!("between {clamp_m} and {free_m} m"),
            ));
        }
        let max_radius = self.max_radius_m(clamp_m, free_m);
        if !(0.0 < boss && boss <= max_radius * (1.0 + 1e-12)) {
            return Err(invalid(
                "boss_radius_m",
                format!("{boss} m"),
                format!(
                    "above 0 and at most {max_radius:.6} m, where a boss meets the clamp, the edge or its neighbour"
                ),
            ));
        }
        if !(0.0 <= self.hole_radius_m && self.hole_radius_m <= boss) {
            return Err(invalid(
                "hole_radius_m",
                format!("{} m", self.hole_radius_m),
                format!("0 to the boss radius, {boss} m"),
            ));
        }
        Ok(())
    }

    /// Returns the radius (m) at which a boss meets the clamp, the edge or its neighbour.
    pub(super) fn max_radius_m(&self, clamp_m: f64, free_m: f64) -> f64 {
        let pitch = self.pitch_radius_m;
        let apart = match self.count {
            1 => f64::INFINITY,
            count => pitch * (PI / f64::from(count)).sin(),
        };
        (pitch - clamp_m).min(free_m - pitch).min(apart)
    }
}
