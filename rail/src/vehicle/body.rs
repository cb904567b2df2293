//! What a vehicle consists of.

use super::element::{Element, Law};
use super::error::VehicleError;
use super::ride_point::RidePoint;

/// A vehicle: rigid bodies and wheelsets, connected by elements.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VehicleParameters {
    /// Name.
    pub name: String,
    /// Car body, bogie frames, and what else is rigid.
    pub bodies: Vec<Body>,
    /// Wheelsets.
    pub wheelsets: Vec<Wheelset>,
    /// What connects them.
    pub elements: Vec<Element>,
    /// Where the ride is told of; nothing moves otherwise for them.
    pub ride_points: Vec<RidePoint>,
}

/// A rigid body.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Body {
    /// Name, by which elements are attached to it.
    pub name: String,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Moments of inertia about the centre of gravity: roll, pitch, yaw, kg m^2.
    pub inertia_kg_m2: [f64; 3],
    /// Longitudinal position of the centre of gravity from the middle of the vehicle, forward positive, m.
    pub x_m: f64,
    /// Height of the centre of gravity above the rails' top, m.
    pub height_m: f64,
}

/// A wheelset.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Wheelset {
    /// Name, by which elements are attached to it.
    pub name: String,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Moments of inertia about the centre: roll, spin, yaw, kg m^2.
    pub inertia_kg_m2: [f64; 3],
    /// Longitudinal position from the middle of the vehicle, forward positive, m.
    pub x_m: f64,
    /// Radius of the wheels and height of the centre, m.
    pub radius_m: f64,
}

/// A coordinate of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinate {
    /// To the right, m.
    Lateral,
    /// Down, m.
    Vertical,
    /// Right side down, rad.
    Roll,
    /// Nose up, rad.
    Pitch,
    /// Nose to the right, rad.
    Yaw,
}

impl Coordinate {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Lateral => "lateral",
            Self::Vertical => "vertical",
            Self::Roll => "roll",
            Self::Pitch => "pitch",
            Self::Yaw => "yaw",
        }
    }
}

/// The coordinates of a body in their order.
pub const COORDINATES: [Coordinate; 5] = [
    Coordinate::Lateral,
    Coordinate::Vertical,
    Coordinate::Roll,
    Coordinate::Pitch,
    Coordinate::Yaw,
];

impl VehicleParameters {
    /// The hydraulic dampers, in the order in which a [`Vehicle`](super::Vehicle) counts them.
    pub fn dampers(&self) -> impl Iterator<Item = &Element> {
        let elements = self.elements.iter();
        elements.filter(|element| matches!(element.law, Law::Damper { .. }))
    }
}

impl Body {
    pub(super) fn check(&self) -> Result<(), VehicleError> {
        let owner = &self.name;
        VehicleError::check(owner, "mass_kg", self.mass_kg, [1.0, 1e6])?;
        for (name, value) in ["roll", "pitch", "yaw"].into_iter().zip(self.inertia_kg_m2) {
            VehicleError::check(owner, name, value, [1e-3, 1e9])?;
        }
        VehicleError::check(owner, "x_m", self.x_m, [-100.0, 100.0])?;
        VehicleError::check(owner, "height_m", self.height_m, [0.0, 10.0])
    }

    /// Mass or moment of inertia of each coordinate, kg or kg m^2.
    pub(super) fn inertia(&self) -> [f64; COORDINATES.len()] {
        let [roll, pitch, yaw] = self.inertia_kg_m2;
        [self.mass_kg, self.mass_kg, roll, pitch, yaw]
    }

    /// The centre of gravity: x, y, z.
    pub(super) fn centre_m(&self) -> [f64; 3] {
        [self.x_m, 0.0, -self.height_m]
    }
}

impl Wheelset {
    /// The wheelset as a body.
    pub(super) fn body(&self) -> Body {
        Body {
            name: self.name.clone(),
            mass_kg: self.mass_kg,
            inertia_kg_m2: self.inertia_kg_m2,
            x_m: self.x_m,
            height_m: self.radius_m,
        }
    }
}
