//! Identity of the vehicle that a state belongs to.

use sha2::{Digest, Sha256};

use super::rails::RailSupport;
use crate::vehicle::body::Body;
use crate::vehicle::element::{Direction, Element, Law};
use crate::vehicle::parameters::VehicleParameters;
use crate::vehicle::standstill::wheelset_bodies;

/// A digest of the parameters that a vehicle's state depends on: bodies, elements, rails and step.
///
/// Two things are left out: the parameters of dampers, because [`Vehicle::set_damper`](super::Vehicle::set_damper) may
/// change them in motion, and the wheel-rail contact, because a state stores only its results. Equal parameters give an
/// equal digest in every process and on every machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Identity(u64);

impl Identity {
    pub fn new(parameters: &VehicleParameters, step_s: f64, rails: Option<&RailSupport>) -> Self {
        let mut digest = Hasher(Sha256::new());
        digest.numbers(&[step_s]);
        match rails {
            Some(rails) => digest.numbers(&[
                rails.mass_kg,
                rails.lateral_stiffness_n_per_m,
                rails.lateral_damping_n_s_per_m,
                rails.vertical_stiffness_n_per_m,
                rails.vertical_damping_n_s_per_m,
            ]),
            None => digest.numbers(&[]),
        }
        digest.bodies(&parameters.bodies);
        digest.bodies(&wheelset_bodies(parameters));
        digest.count(parameters.elements.len());
        for element in &parameters.elements {
            digest.element(element);
        }
        let bytes: [u8; 32] = digest.0.finalize().into();
        let mut first = [0; 8];
        first.copy_from_slice(&bytes[..8]);
        Self(u64::from_le_bytes(first))
    }
}

/// Hashes texts and numbers, each after its length, so that no two vehicles give the same bytes.
struct Hasher(Sha256);

impl Hasher {
    fn count(&mut self, count: usize) {
        self.0.update((count as u64).to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.count(text.len());
        self.0.update(text);
    }

    fn numbers(&mut self, numbers: &[f64]) {
        self.count(numbers.len());
        for number in numbers {
            self.0.update(number.to_le_bytes());
        }
    }

    fn bodies(&mut self, bodies: &[Body]) {
        self.count(bodies.len());
        for body in bodies {
            self.text(&body.name);
            self.numbers(&[body.mass_kg, body.x_m, body.height_m]);
            self.numbers(&body.inertia_kg_m2);
        }
    }

    fn direction(&mut self, direction: Direction) {
        self.count(direction.axis());
    }

    fn element(&mut self, element: &Element) {
        self.text(&element.name);
        for end in &element.ends {
            self.count(usize::from(end.on.is_some()));
            self.text(end.on.as_deref().unwrap_or_default());
            self.numbers(&end.at_m);
        }
        self.text(element.law.name());
        match &element.law {
            Law::SpringDamper {
                stiffness_n_per_m,
                damping_n_s_per_m,
            } => {
                self.numbers(stiffness_n_per_m);
                self.numbers(damping_n_s_per_m);
            }
            Law::Bush {
                stiffness_n_per_m,
                damping_n_s_per_m,
                stiffness_n_m_per_rad,
                damping_n_m_s_per_rad,
            } => {
                self.numbers(stiffness_n_per_m);
                self.numbers(damping_n_s_per_m);
                self.numbers(stiffness_n_m_per_rad);
                self.numbers(damping_n_m_s_per_rad);
            }
            Law::Damper { direction, .. } => {
                self.direction(*direction);
            }
            Law::BumpStop { direction, points } => {
                self.direction(*direction);
                self.numbers(points.as_flattened());
            }
            Law::AntiRollBar {
                stiffness_n_m_per_rad,
            } => {
                self.numbers(&[*stiffness_n_m_per_rad]);
            }
            Law::TractionRod {
                stiffness_n_per_m,
                damping_n_s_per_m,
            } => {
                self.numbers(&[*stiffness_n_per_m, *damping_n_s_per_m]);
            }
        }
    }
}
