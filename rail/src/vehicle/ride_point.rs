//! Points at which ride accelerations are measured.

use super::body::Body;
use super::error::VehicleError;

/// An accelerometer position on a body.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct RidePoint {
    /// Name.
    pub name: String,
    /// Name of the body.
    pub on: String,
    /// Position: x forward from the middle of the vehicle, y to the right, height above the top of the rails, m.
    pub at_m: [f64; 3],
}

/// Allowed x, y and height, m.
const POSITION_BOUNDS_M: [(&str, [f64; 2]); 3] = [
    ("x_m", [-100.0, 100.0]),
    ("y_m", [-10.0, 10.0]),
    ("height_m", [0.0, 10.0]),
];

impl RidePoint {
    /// Returns a point on the body called `on`, at x forward, y right and height above the top of the rails, m.
    pub fn new(name: impl Into<String>, on: impl Into<String>, at_m: [f64; 3]) -> Self {
        Self {
            name: name.into(),
            on: on.into(),
            at_m,
        }
    }

    /// Returns the acceleration of the point to the right and down, m/s^2, from the accelerations of its body's
    /// coordinates.
    ///
    /// They are `lateral - roll z + yaw x` and `vertical + roll y - pitch x`, with `(x, y, z)` from the centre of
    /// gravity and z downward.
    ///
    /// ```
    /// use dashpot_rail::vehicle::{Body, RidePoint};
    /// let body = Body::new("body", 30e3, [40e3, 900e3, 900e3], 1.5).with_x_m(1.0);
    /// let seat = RidePoint::new("seat", "body", [5.0, 0.5, 2.0]);
    /// // 4 m ahead of the centre of gravity, 0.5 m to its right and 0.5 m above it.
    /// let right_side_down = seat.acceleration(&body, [0.0, 0.0, 1.0, 0.0, 0.0]);
    /// assert_eq!(right_side_down, [0.5, 0.5]);
    /// let nose_up_and_right = seat.acceleration(&body, [0.0, 0.0, 0.0, 1.0, 1.0]);
    /// assert_eq!(nose_up_and_right, [4.0, -4.0]);
    /// ```
    #[inline]
    pub fn acceleration(&self, body: &Body, body_acceleration: [f64; 5]) -> [f64; 2] {
        let [lateral, vertical, roll, pitch, yaw] = body_acceleration;
        let [x, y, height] = self.at_m;
        let (ahead, above) = (x - body.x_m, height - body.height_m);
        [
            lateral + roll * above + yaw * ahead,
            vertical + roll * y - pitch * ahead,
        ]
    }

    pub(super) fn check(&self, bodies: &[Body]) -> Result<(), VehicleError> {
        for ((name, allowed), value) in POSITION_BOUNDS_M.into_iter().zip(self.at_m) {
            VehicleError::check(&self.name, name, value, allowed)?;
        }
        if bodies.iter().any(|body| body.name == self.on) {
            return Ok(());
        }
        let names = bodies.iter().map(|body| body.name.clone());
        Err(VehicleError::NoSuchBody {
            point: self.name.clone(),
            on: self.on.clone(),
            names: names.collect(),
        })
    }
}
