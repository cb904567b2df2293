//! Single defects: dip, alignment bump and kink, twist.

use std::f64::consts::TAU;

use super::error::{Place, TrackError, within};
use super::rails::{Channels, RailDeviation};

/// Rails that have a defect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Rails {
    /// The left rail.
    Left,
    /// The right rail.
    Right,
    /// Both rails.
    Both,
}

impl Rails {
    /// `deviation` on these rails, left and right.
    fn with(self, deviation: RailDeviation) -> [RailDeviation; 2] {
        let none = RailDeviation::default();
        match self {
            Self::Left => [deviation, none],
            Self::Right => [none, deviation],
            Self::Both => [deviation, deviation],
        }
    }
}

/// A defect at one place, added to layout and irregularity; zero outside of its length.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Defect {
    /// Vertical `depth_m (1 - cos(2 pi t / length_m)) / 2`, `t` from its start: `depth_m` in the middle, level ends.
    CosineDip {
        /// Rails that have it.
        rails: Rails,
        /// Distance at which it begins, m.
        start_m: f64,
        /// Length, m.
        length_m: f64,
        /// Greatest depth, down positive, m.
        depth_m: f64,
    },
    /// Lateral `offset_m (1 - cos(2 pi t / length_m)) / 2`.
    AlignmentBump {
        /// Rails that have it.
        rails: Rails,
        /// Distance at which it begins, m.
        start_m: f64,
        /// Length, m.
        length_m: f64,
        /// Greatest offset, right positive, m.
        offset_m: f64,
    },
    /// Lateral triangle of two straights: the direction changes by `4 offset_m / length_m` in the middle and by half of it at each end,
    /// over a parabola of the length `rounding_m`, which takes `offset_m rounding_m / (2 length_m)` from the greatest offset.
    ///
    /// With its rounding it begins `rounding_m / 2` before `start_m` and ends as much behind.
    AlignmentKink {
        /// Rails that have it.
        rails: Rails,
        /// First corner of the triangle, m.
        start_m: f64,
        /// Distance from the first corner to the last, m.
        length_m: f64,
        /// Offset of the middle corner, right positive, m.
        offset_m: f64,
        /// Length of each rounding, m.
        rounding_m: f64,
    },
    /// Cross level that rises linearly over `base_m`, stays over `plateau_m` and falls over `base_m`, half on each rail; each corner is a parabola
    /// of the length `rounding_m`. The twist is `cross_level_m / base_m`.
    Twist {
        /// First corner, m.
        start_m: f64,
        /// Length of each ramp, m.
        base_m: f64,
        /// Length between the ramps, m.
        plateau_m: f64,
        /// Height of the left rail over the right one on the plateau, m.
        cross_level_m: f64,
        /// Length of each rounding, m.
        rounding_m: f64,
    },
}

/// Bounds of a length, m.
const LENGTH_M: [f64; 2] = [0.05, 1000.0];
/// Bounds of a displacement, m.
const DISPLACEMENT_M: [f64; 2] = [-0.2, 0.2];
/// Bounds of a distance, m.
const DISTANCE_M: [f64; 2] = [-1e7, 1e7];

impl Defect {
    /// Deviations of the left and of the right rail at a distance.
    pub fn at(&self, distance_m: f64) -> [RailDeviation; 2] {
        match *self {
            Self::CosineDip {
                rails,
                start_m,
                length_m,
                depth_m,
            } => {
                let [value, slope] = bump(distance_m - start_m, length_m);
                rails.with(RailDeviation {
                    vertical_m: depth_m * value,
                    vertical_slope: depth_m * slope,
                    ..RailDeviation::default()
                })
            }
            Self::AlignmentBump {
                rails,
                start_m,
                length_m,
                offset_m,
            } => {
                let [value, slope] = bump(distance_m - start_m, length_m);
                rails.with(RailDeviation {
                    lateral_m: offset_m * value,
                    lateral_slope: offset_m * slope,
                    ..RailDeviation::default()
                })
            }
            Self::AlignmentKink {
                rails,
                start_m,
                length_m,
                offset_m,
                rounding_m,
            } => {
                let corners = [(0.0, 2.0), (0.5 * length_m, -4.0), (length_m, 2.0)];
                let [value, slope] = rounded(distance_m - start_m, rounding_m, &corners);
                rails.with(RailDeviation {
                    lateral_m: offset_m / length_m * value,
                    lateral_slope: offset_m / length_m * slope,
                    ..RailDeviation::default()
                })
            }
            Self::Twist {
                start_m,
                base_m,
                plateau_m,
                cross_level_m,
                rounding_m,
            } => {
                let corners = [
                    (0.0, 1.0),
                    (base_m, -1.0),
                    (base_m + plateau_m, -1.0),
                    (2.0 * base_m + plateau_m, 1.0),
                ];
                let twist = cross_level_m / base_m;
                let [deviation, change] =
                    rounded(distance_m - start_m, rounding_m, &corners).map(|cross_level| {
                        Channels {
                            cross_level: twist * cross_level,
                            ..Channels::default()
                        }
                    });
                RailDeviation::of_rails(&deviation, &change)
            }
        }
    }

    /// Checks that every quantity is in its bounds.
    pub(super) fn check(&self, place: Place) -> Result<(), TrackError> {
        // Not longer than a straight: the roundings at its ends take half of it each.
        let rounding = |value: f64, straight_m: f64| {
            within(place, "rounding_m", value, [1e-3, straight_m.max(1e-3)])
        };
        let (Self::CosineDip { start_m, .. }
        | Self::AlignmentBump { start_m, .. }
        | Self::AlignmentKink { start_m, .. }
        | Self::Twist { start_m, .. }) = *self;
        within(place, "start_m", start_m, DISTANCE_M)?;
        match *self {
            Self::CosineDip {
                length_m, depth_m, ..
            } => {
                within(place, "length_m", length_m, LENGTH_M)?;
                within(place, "depth_m", depth_m, DISPLACEMENT_M)
            }
            Self::AlignmentBump {
                length_m, offset_m, ..
            } => {
                within(place, "length_m", length_m, LENGTH_M)?;
                within(place, "offset_m", offset_m, DISPLACEMENT_M)
            }
            Self::AlignmentKink {
                length_m,
                offset_m,
                rounding_m,
                ..
            } => {
                within(place, "length_m", length_m, LENGTH_M)?;
                within(place, "offset_m", offset_m, DISPLACEMENT_M)?;
                rounding(rounding_m, 0.5 * length_m)
            }
            Self::Twist {
                base_m,
                plateau_m,
                cross_level_m,
                rounding_m,
                ..
            } => {
                within(place, "base_m", base_m, LENGTH_M)?;
                within(place, "plateau_m", plateau_m, LENGTH_M)?;
                within(place, "cross_level_m", cross_level_m, DISPLACEMENT_M)?;
                rounding(rounding_m, base_m.min(plateau_m))
            }
        }
    }
}

/// `(1 - cos(2 pi t / length)) / 2` and its slope, zero outside of 0 to `length`.
fn bump(t: f64, length: f64) -> [f64; 2] {
    if t <= 0.0 || t >= length {
        return [0.0; 2];
    }
    let angle = TAU * t / length;
    [
        0.5 - 0.5 * libm::cos(angle),
        0.5 * TAU / length * libm::sin(angle),
    ]
}

/// Value and slope at `t` of a line of straights: the slope changes at each corner `(place, change)` linearly over `rounding`.
/// The changes and their moments add up to zero.
fn rounded(t: f64, rounding: f64, corners: &[(f64, f64)]) -> [f64; 2] {
    let half = 0.5 * rounding;
    let last = corners.last().map_or(0.0, |corner| corner.0);
    if t <= -half || t >= last + half {
        return [0.0; 2];
    }
    corners
        .iter()
        .fold([0.0; 2], |[value, slope], (place, change)| {
            let behind = t - place;
            let along = (behind + half).clamp(0.0, rounding);
            // Up to the end of the rounding a parabola, behind it the straight from the corner.
            let rise = if behind < half {
                0.5 * along * along / rounding
            } else {
                behind
            };
            [value + change * rise, slope + change * along / rounding]
        })
}
