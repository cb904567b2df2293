//! Ride measurement points of a vehicle.

use dashpot_rail::vehicle::{Body, RidePoint, VehicleParameters};

/// Accelerometer fixed to a body at a ride measurement point.
#[derive(Debug, Clone, PartialEq)]
pub struct Accelerometer {
    point: RidePoint,
    body: Body,
    body_index: usize,
}

impl Accelerometer {
    /// Returns an accelerometer for each ride point of the vehicle. A vehicle without ride points gets points on its
    /// first body, the car body, at the height of its centre of gravity: one in the middle and one above every other
    /// body.
    pub fn all(vehicle: &VehicleParameters) -> Vec<Self> {
        let points = if vehicle.ride_points.is_empty() {
            default_points(&vehicle.bodies)
        } else {
            vehicle.ride_points.clone()
        };
        let mount = |point: RidePoint| {
            let mut bodies = vehicle.bodies.iter();
            let body_index = bodies.position(|body| body.name == point.on)?;
            Some(Self {
                point,
                body: vehicle.bodies[body_index].clone(),
                body_index,
            })
        };
        points.into_iter().filter_map(mount).collect()
    }

    /// Name of the point.
    pub fn name(&self) -> &str {
        &self.point.name
    }

    /// Coordinates, m: x forward from the middle of the vehicle, y to the right, height above the top of the rails.
    pub fn at_m(&self) -> [f64; 3] {
        self.point.at_m
    }

    /// Returns the lateral (right positive) and vertical (down positive) acceleration, m/s^2. `body_acceleration` gives
    /// the accelerations of a body, in the order of its coordinates.
    #[inline]
    pub fn acceleration(&self, body_acceleration: impl Fn(usize) -> [f64; 5]) -> [f64; 2] {
        self.point
            .acceleration(&self.body, body_acceleration(self.body_index))
    }
}

fn default_points(bodies: &[Body]) -> Vec<RidePoint> {
    let Some((body, others)) = bodies.split_first() else {
        return Vec::new();
    };
    let point = |name: String, x_m: f64| {
        RidePoint::new(name, body.name.as_str(), [x_m, 0.0, body.height_m])
    };
    let middle = point(format!("{}, middle", body.name), body.x_m);
    let over = |other: &Body| point(format!("{}, over the {}", body.name, other.name), other.x_m);
    std::iter::once(middle)
        .chain(others.iter().map(over))
        .collect()
}
