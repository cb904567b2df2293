//! Isolated defects: dip, alignment bump and kink, twist.

use std::f64::consts::TAU;

use super::error::{Place, TrackError, within};
use super::rails::{Channels, RailDeviation};

/// Rails affected by a defect.
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
    /// Left and right deviation, with `deviation` on these rails.
    fn with(self, deviation: RailDeviation) -> [RailDeviation; 2] {
        let none = RailDeviation::default();
        match self {
            Self::Left => [deviation, none],
            Self::Right => [none, deviation],
            Self::Both => [deviation, deviation],
        }
    }
}

/// An isolated defect, added to layout and irregularity. It is zero outside its length.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Defect {
    /// Vertical deviation `depth_m (1 - cos(2 pi t / length_m)) / 2` at the distance `t` from the start.
    CosineDip {
        /// Affected rails.
        rails: Rails,
        /// Distance at which the defect starts, m.
        start_m: f64,
        /// Length, m.
        length_m: f64,
        /// Maximum depth, positive downward, m.
        depth_m: f64,
    },
    /// Lateral deviation `offset_m (1 - cos(2 pi t / length_m)) / 2` at the distance `t` from the start.
    AlignmentBump {
        /// Affected rails.
        rails: Rails,
        /// Distance at which the defect starts, m.
        start_m: f64,
        /// Length, m.
        length_m: f64,
        /// Maximum offset, positive to the right, m.
        offset_m: f64,
    },
    /// Lateral triangle of two straight lines with rounded corners.
    ///
    /// The direction changes by `4 offset_m / length_m` in the middle and by half as much at each end. Each corner is a
    /// parabola of the length `rounding_m`, which reduces the maximum offset by `offset_m rounding_m / (2 length_m)`.
    /// The deviation starts `rounding_m / 2` before the first corner and ends `rounding_m / 2` after the last.
    AlignmentKink {
        /// Affected rails.
        rails: Rails,
        /// First corner of the triangle, m.
        start_m: f64,
        /// Distance from the first corner to the last, m.
        length_m: f64,
        /// Offset of the middle corner, positive to the right, m.
        offset_m: f64,
        /// Length of each rounding, m.
        rounding_m: f64,
    },
    /// Cross level that rises linearly over `base_m`, stays constant over `plateau_m` and falls over `base_m`. Each
    /// rail is displaced by half of it. Each corner is a parabola of the length `rounding_m`. The twist is
    /// `cross_level_m / base_m`.
    Twist {
        /// First corner, m.
        start_m: f64,
        /// Length of each ramp, m.
        base_m: f64,
        /// Length between the ramps, m.
        plateau_m: f64,
        /// Height of the left rail above the right rail on the plateau, m.
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
    /// Returns the deviations of the left and the right rail at a distance.
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
                RailDeviation::left_and_right(&deviation, &change)
            }
        }
    }

    /// Checks the bounds of all values.
    pub(super) fn check(&self, place: Place) -> Result<(), TrackError> {
        // A rounding must not be longer than the straight line it joins: the roundings at the two ends of the line each
        // take up to half of it.
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

/// `(1 - cos(2 pi t / length)) / 2` and its slope; zero outside 0 to `length`.
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

/// Value and slope at `t` of a polyline with rounded corners. At each corner `(position, change)` the slope changes
/// linearly by `change` over `rounding`. The changes and their moments must add up to zero.
fn rounded(t: f64, rounding: f64, corners: &[(f64, f64)]) -> [f64; 2] {
    let half = 0.5 * rounding;
    let last = corners.last().map_or(0.0, |corner| corner.0);
    if t <= -half || t >= last + half {
        return [0.0; 2];
    }
    corners
        .iter()
        .fold([0.0; 2], |[value, slope], (position, change)| {
            let behind = t - position;
            let along = (behind + half).clamp(0.0, rounding);
            // A parabola up to the end of the rounding, then the straight line from the corner.
            let rise = if behind < half {
                0.5 * along * along / rounding
            } else {
                behind
            };
            [value + change * rise, slope + change * along / rounding]
        })
}
