//! Where the ride of a vehicle is told of.

use dashpot_rail::vehicle::{Body, RidePoint, VehicleParameters};

/// A point of a body where the ride is told of.
#[derive(Debug, Clone, PartialEq)]
pub struct Accelerometer {
    point: RidePoint,
    body: Body,
    /// Number of the body.
    number: usize,
}

impl Accelerometer {
    /// Those at the ride points of a vehicle; where it gives none, at the height of the centre of gravity of its first body, which is the
    /// car body, in the middle and over every other body.
    pub fn all(vehicle: &VehicleParameters) -> Vec<Self> {
        let points = if vehicle.ride_points.is_empty() {
            usual_points(&vehicle.bodies)
        } else {
            vehicle.ride_points.clone()
        };
        let placed = |point: RidePoint| {
            let mut bodies = vehicle.bodies.iter();
            let number = bodies.position(|body| body.name == point.on)?;
            Some(Self {
                point,
                body: vehicle.bodies[number].clone(),
                number,
            })
        };
        points.into_iter().filter_map(placed).collect()
    }

    /// Name.
    pub fn name(&self) -> &str {
        &self.point.name
    }

    /// Place: x forward from the middle of the vehicle, y right, height above the rails' top, m.
    pub fn at_m(&self) -> [f64; 3] {
        self.point.at_m
    }

    /// Acceleration to the right and down, m/s^2, from that of bodies in the order of their coordinates.
    #[inline]
    pub fn acceleration(&self, of_body: impl Fn(usize) -> [f64; 5]) -> [f64; 2] {
        self.point.acceleration(&self.body, of_body(self.number))
    }
}

fn usual_points(bodies: &[Body]) -> Vec<RidePoint> {
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
