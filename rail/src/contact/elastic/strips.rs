//! The strips of a wheel on which the elastic contact is computed.

use crate::contact::pair::Pair;
use crate::contact::silhouette::Turn;

/// Contact angle, as a slope, beyond which patches may be narrow and strips are fine.
const STEEP: f64 = 0.1;
/// Width of fine, medium and coarse strips on flat and on steep parts of a wheel, in samples of its profile.
const SAMPLES: [[usize; 2]; 3] = [[5, 2], [8, 3], [14, 5]];

/// How finely a wheel is divided. Small loads have small patches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fineness {
    /// For normal loads of up to about 20 kN.
    Fine,
    /// For normal loads of about 10 to 100 kN.
    Medium,
    /// For normal loads of about 50 kN or more.
    Coarse,
}

/// One strip of a turned wheel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strip {
    /// Position along the wheel's surface, m.
    pub arc_m: f64,
    pub width_m: f64,
    /// Lateral position on the wheel, m from the tread datum.
    pub wheel_y_m: f64,
    /// Lateral position and depth relative to the tread datum in track axes, m.
    pub y_m: f64,
    pub z_m: f64,
    pub slope: f64,
    /// Cosine of the angle whose tangent is the slope.
    pub cos: f64,
    /// Radius of curvature in the rolling direction, m.
    pub radius_m: f64,
}

/// The strips of a wheel that is rotated by its roll and yaw. They are fixed to the wheel, so the gaps between them and
/// the rail are continuous functions of the pose.
#[derive(Debug, Clone)]
pub struct TurnedStrips<'a> {
    pub(super) pair: &'a Pair,
    pub(super) strips: Vec<Strip>,
}

impl<'a> TurnedStrips<'a> {
    /// Divides the wheel of `pair` into strips and rotates it by `roll_rad` and `yaw_rad`.
    pub fn new(pair: &'a Pair, roll_rad: f64, yaw_rad: f64, fineness: Fineness) -> Self {
        let points = pair.wheel().points();
        let turn = Turn::new(roll_rad, yaw_rad, pair.installation().wheel_radius_m);
        let middle = |i: usize, j: usize| {
            0.5 * libm::hypot(points[j].y_m - points[i].y_m, points[j].z_m - points[i].z_m)
        };
        let mut samples = Vec::new();
        let mut next = 0;
        while next < points.len() {
            samples.push(next);
            let steep = pair.wheel_slopes[next].abs() > STEEP;
            next += SAMPLES[fineness as usize][usize::from(steep)];
        }
        let mut strips = Vec::with_capacity(samples.len());
        let mut arc_m = 0.0;
        for (k, &i) in samples.iter().enumerate() {
            let before = k.checked_sub(1).map_or(0.0, |k| middle(samples[k], i));
            let after = samples.get(k + 1).map_or(0.0, |&j| middle(i, j));
            let (point, turned) = (&points[i], turn.point(&points[i], pair.wheel_slopes[i]));
            arc_m += 2.0 * before;
            let rolling = libm::cos(libm::atan(turned.slope) - roll_rad).max(0.01);
            strips.push(Strip {
                arc_m,
                width_m: before + after,
                wheel_y_m: point.y_m,
                y_m: turned.y,
                z_m: turned.z,
                slope: turned.slope,
                cos: turned.cos,
                radius_m: (pair.installation().wheel_radius_m + point.z_m) / rolling,
            });
        }
        Self { pair, strips }
    }

    /// The pair that the wheel belongs to.
    pub fn pair(&self) -> &'a Pair {
        self.pair
    }
}

#[cfg(test)]
impl Strip {
    /// A strip on a flat wheel.
    pub fn flat(arc_m: f64, width_m: f64, radius_m: f64) -> Self {
        Self {
            arc_m,
            width_m,
            wheel_y_m: arc_m,
            y_m: arc_m,
            z_m: 0.0,
            slope: 0.0,
            cos: 1.0,
            radius_m,
        }
    }
}
