//! Where on a body the ride is told of.

use super::body::{Body, VehicleParameters};
use super::error::VehicleError;

/// A point of a body where an accelerometer stands.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RidePoint {
    /// Name.
    pub name: String,
    /// The body.
    pub on: String,
    /// Place: x forward from the middle of the vehicle, y right, height above the rails' top, m.
    pub at_m: [f64; 3],
}

/// Allowed x, y and height, m.
const PLACES_M: [(&str, [f64; 2]); 3] = [
    ("x_m", [-100.0, 100.0]),
    ("y_m", [-10.0, 10.0]),
    ("height_m", [0.0, 10.0]),
];

impl RidePoint {
    /// Acceleration to the right and down of the point, m/s^2, of that of its body's coordinates: `lateral - roll z + yaw x` and
    /// `vertical + roll y - pitch x`, with `(x, y, z)` from the centre of gravity, z down.
    ///
    /// ```
    /// use dashpot_rail::vehicle::{Body, RidePoint};
    /// let body = Body {
    ///     name: "body".into(),
    ///     mass_kg: 30e3,
    ///     inertia_kg_m2: [40e3, 900e3, 900e3],
    ///     x_m: 1.0,
    ///     height_m: 1.5,
    /// };
    /// let seat = RidePoint { name: "seat".into(), on: "body".into(), at_m: [5.0, 0.5, 2.0] };
    /// // 4 m ahead of the centre of gravity, 0.5 m right of it and above it.
    /// let right_side_down = seat.acceleration(&body, [0.0, 0.0, 1.0, 0.0, 0.0]);
    /// assert_eq!(right_side_down, [0.5, 0.5]);
    /// let nose_up_and_right = seat.acceleration(&body, [0.0, 0.0, 0.0, 1.0, 1.0]);
    /// assert_eq!(nose_up_and_right, [4.0, -4.0]);
    /// ```
    #[inline]
    pub fn acceleration(&self, body: &Body, of_body: [f64; 5]) -> [f64; 2] {
        let [lateral, vertical, roll, pitch, yaw] = of_body;
        let [x, y, height] = self.at_m;
        let (ahead, above) = (x - body.x_m, height - body.height_m);
        [
            lateral + roll * above + yaw * ahead,
            vertical + roll * y - pitch * ahead,
        ]
    }

    pub(super) fn check(&self, vehicle: &VehicleParameters) -> Result<(), VehicleError> {
        for ((name, allowed), value) in PLACES_M.into_iter().zip(self.at_m) {
            VehicleError::check(&self.name, name, value, allowed)?;
        }
        if vehicle.bodies.iter().any(|body| body.name == self.on) {
            return Ok(());
        }
        let names = vehicle.bodies.iter().map(|body| body.name.clone());
        Err(VehicleError::NoSuchBody {
            point: self.name.clone(),
            on: self.on.clone(),
            names: names.collect(),
        })
    }
}
