//! Deviations of the track and of its two rails.

use std::ops::{Add, AddAssign};

use crate::contact::RailDisplacement;

/// Deviations of a track from its layout, or their slopes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Channels {
    /// Vertical profile: mean of both rails, positive downward, m.
    pub vertical: f64,
    /// Alignment: mean of both rails, positive to the right, m.
    pub lateral: f64,
    /// Cross level: height of the left rail above the right rail in excess of the cant, m.
    pub cross_level: f64,
    /// Gauge deviation: distance between the rails in excess of the nominal gauge, m.
    pub gauge: f64,
}

impl Channels {
    /// Returns the channels from an array in the order vertical, lateral, cross level, gauge.
    pub(super) fn from_array([vertical, lateral, cross_level, gauge]: [f64; 4]) -> Self {
        Self {
            vertical,
            lateral,
            cross_level,
            gauge,
        }
    }
}

/// Displacement of one rail from the layout, and its slope.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct RailDeviation {
    /// Lateral displacement, positive to the right, m.
    pub lateral_m: f64,
    /// Vertical displacement, positive downward, m.
    pub vertical_m: f64,
    /// Change of `lateral_m` per distance, dimensionless.
    pub lateral_slope: f64,
    /// Change of `vertical_m` per distance, dimensionless.
    pub vertical_slope: f64,
}

impl RailDeviation {
    /// Returns the deviations of the left and the right rail from those of the track and their slopes:
    ///
    /// - vertical: `vertical - cross_level / 2` left, `vertical + cross_level / 2` right (positive downward);
    /// - lateral: `lateral - gauge / 2` left, `lateral + gauge / 2` right.
    #[inline]
    pub fn left_and_right(deviations: &Channels, slopes: &Channels) -> [Self; 2] {
        [-0.5, 0.5].map(|half| Self {
            lateral_m: deviations.lateral + half * deviations.gauge,
            vertical_m: deviations.vertical + half * deviations.cross_level,
            lateral_slope: slopes.lateral + half * slopes.gauge,
            vertical_slope: slopes.vertical + half * slopes.cross_level,
        })
    }

    /// Returns the displacement of the rail under a wheel that moves along it. Velocities are the speed times the
    /// slopes; the lateral slope also turns the rail, which itself rests.
    #[inline]
    pub fn displacement(&self, speed_m_per_s: f64) -> RailDisplacement {
        RailDisplacement {
            lateral_m: self.lateral_m,
            vertical_m: self.vertical_m,
            lateral_velocity_m_per_s: speed_m_per_s * self.lateral_slope,
            vertical_velocity_m_per_s: speed_m_per_s * self.vertical_slope,
            yaw_rad: self.lateral_slope,
            ..RailDisplacement::default()
        }
    }
}

impl Add for RailDeviation {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self {
            lateral_m: self.lateral_m + other.lateral_m,
            vertical_m: self.vertical_m + other.vertical_m,
            lateral_slope: self.lateral_slope + other.lateral_slope,
            vertical_slope: self.vertical_slope + other.vertical_slope,
        }
    }
}

impl AddAssign for RailDeviation {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
