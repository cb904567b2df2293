//! Parameters of a vehicle.

use super::body::{Body, Wheelset};
use super::element::{Element, Law};
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
