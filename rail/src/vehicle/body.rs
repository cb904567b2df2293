//! Rigid bodies and wheelsets of a vehicle.

use super::error::VehicleError;

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
    /// Returns the name in lower case.
    pub fn name(self) -> &'static str {
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
