//! Parameters of a vehicle: its bodies and wheelsets.

use super::element::{Element, Law};
use super::error::VehicleError;
use super::ride_point::RidePoint;

/// A vehicle: rigid bodies and wheelsets, connected by elements.
///
/// ```
/// use dashpot_rail::vehicle::{Body, VehicleParameters};
/// let body = Body::new("body", 30e3, [40e3, 900e3, 900e3], 1.5);
/// let vehicle = VehicleParameters::new("wagon").with_bodies([body]);
/// assert_eq!(vehicle.bodies[0].mass_kg, 30e3);
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct VehicleParameters {
    /// Name.
    pub name: String,
    /// Rigid bodies: the car body, bogie frames and others.
    pub bodies: Vec<Body>,
    /// Wheelsets.
    pub wheelsets: Vec<Wheelset>,
    /// Elements that connect bodies, wheelsets and the track.
    pub elements: Vec<Element>,
    /// Points at which ride accelerations are measured. They do not affect the motion.
    pub ride_points: Vec<RidePoint>,
}

/// A rigid body.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Body {
    /// Name, by which elements refer to the body.
    pub name: String,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Moments of inertia about the centre of gravity: roll, pitch, yaw, kg m^2.
    pub inertia_kg_m2: [f64; 3],
    /// Longitudinal position of the centre of gravity from the middle of the vehicle, positive forward, m.
    pub x_m: f64,
    /// Height of the centre of gravity above the top of the rails, m.
    pub height_m: f64,
}

/// A wheelset.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Wheelset {
    /// Name, by which elements refer to the wheelset.
    pub name: String,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Moments of inertia about the centre: roll, spin, yaw, kg m^2.
    pub inertia_kg_m2: [f64; 3],
    /// Longitudinal position from the middle of the vehicle, positive forward, m.
    pub x_m: f64,
    /// Radius of the wheels, which is also the height of the centre, m.
    pub radius_m: f64,
}

/// A coordinate of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinate {
    /// Positive to the right, m.
    Lateral,
    /// Positive downward, m.
    Vertical,
    /// Positive with the right side down, rad.
    Roll,
    /// Positive with the nose up, rad.
    Pitch,
    /// Positive with the nose to the right, rad.
    Yaw,
}

impl Coordinate {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Lateral => "lateral",
            Self::Vertical => "vertical",
            Self::Roll => "roll",
            Self::Pitch => "pitch",
            Self::Yaw => "yaw",
        }
    }
}

/// Coordinates of a body, in the order used by all arrays.
pub const COORDINATES: [Coordinate; 5] = [
    Coordinate::Lateral,
    Coordinate::Vertical,
    Coordinate::Roll,
    Coordinate::Pitch,
    Coordinate::Yaw,
];

impl VehicleParameters {
    /// Returns a vehicle without bodies, wheelsets or elements.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            bodies: Vec::new(),
            wheelsets: Vec::new(),
            elements: Vec::new(),
            ride_points: Vec::new(),
        }
    }

    /// Adds rigid bodies.
    #[must_use]
    pub fn with_bodies(mut self, bodies: impl IntoIterator<Item = Body>) -> Self {
        self.bodies.extend(bodies);
        self
    }

    /// Adds wheelsets.
    #[must_use]
    pub fn with_wheelsets(mut self, wheelsets: impl IntoIterator<Item = Wheelset>) -> Self {
        self.wheelsets.extend(wheelsets);
        self
    }

    /// Adds elements.
    #[must_use]
    pub fn with_elements(mut self, elements: impl IntoIterator<Item = Element>) -> Self {
        self.elements.extend(elements);
        self
    }

    /// Adds ride points.
    #[must_use]
    pub fn with_ride_points(mut self, points: impl IntoIterator<Item = RidePoint>) -> Self {
        self.ride_points.extend(points);
        self
    }

    /// Returns the hydraulic dampers, in the order in which a [`Vehicle`](super::Vehicle) numbers them.
    pub fn dampers(&self) -> impl Iterator<Item = &Element> {
        let elements = self.elements.iter();
        elements.filter(|element| matches!(element.law, Law::Damper { .. }))
    }
}

impl Body {
    /// Returns a body in the middle of the vehicle; moments of inertia are roll, pitch and yaw.
    pub fn new(
        name: impl Into<String>,
        mass_kg: f64,
        inertia_kg_m2: [f64; 3],
        height_m: f64,
    ) -> Self {
        Self {
            name: name.into(),
            mass_kg,
            inertia_kg_m2,
            x_m: 0.0,
            height_m,
        }
    }

    /// Sets the longitudinal position of the centre of gravity from the middle of the vehicle, positive forward, m.
    #[must_use]
    pub fn with_x_m(mut self, x_m: f64) -> Self {
        self.x_m = x_m;
        self
    }

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

    /// Centre of gravity: x, y, z, m.
    pub(super) fn centre_m(&self) -> [f64; 3] {
        [self.x_m, 0.0, -self.height_m]
    }
}

impl Wheelset {
    /// Returns a wheelset in the middle of the vehicle; moments of inertia are roll, spin and yaw.
    pub fn new(
        name: impl Into<String>,
        mass_kg: f64,
        inertia_kg_m2: [f64; 3],
        radius_m: f64,
    ) -> Self {
        Self {
            name: name.into(),
            mass_kg,
            inertia_kg_m2,
            x_m: 0.0,
            radius_m,
        }
    }

    /// Sets the longitudinal position from the middle of the vehicle, positive forward, m.
    #[must_use]
    pub fn with_x_m(mut self, x_m: f64) -> Self {
        self.x_m = x_m;
        self
    }

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
