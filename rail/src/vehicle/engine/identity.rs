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
                rails.lateral_mass_kg,
                rails.vertical_mass_kg,
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
            Law::Friction {
                direction,
                stiffness_n_per_m,
                friction_n,
                load,
            } => {
                self.direction(*direction);
                self.numbers(&[*stiffness_n_per_m, *friction_n]);
                self.count(usize::from(load.is_some()));
                if let Some(load) = load {
                    self.numbers(&[load.coefficient]);
                    self.text(&load.spring);
                }
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

#[cfg(test)]
mod tests {
    use dashpot_core::DamperParameters;
    use dashpot_core::parameters::Mount;

    use super::*;
    use crate::vehicle::body::Wheelset;
    use crate::vehicle::element::End;
    use crate::vehicle::friction::FrictionLoad;

    fn damper(damping: f64, direction: Direction) -> Law {
        Law::Damper {
            direction,
            parameters: Box::new(DamperParameters::reduced(damping, 1.0, Mount::new(4e6))),
        }
    }

    fn stop(direction: Direction) -> Law {
        Law::BumpStop {
            direction,
            points: vec![[0.01, 0.0], [0.02, 3e3]],
        }
    }

    fn friction(friction_n: f64, load: Option<(f64, &str)>) -> Law {
        Law::Friction {
            direction: Direction::Lateral,
            stiffness_n_per_m: 1e6,
            friction_n,
            load: load.map(|(coefficient, spring)| FrictionLoad::new(coefficient, spring)),
        }
    }

    /// Two bodies with the names `b` and `ab` over a wheelset, with one element.
    fn vehicle(name: &str, on: &str, law: Law) -> VehicleParameters {
        let body = |name: &str| Body::new(name, 20e3, [20e3, 200e3, 200e3], 1.5);
        VehicleParameters::new("vehicle")
            .with_bodies([body("b"), body("ab")])
            .with_wheelsets([Wheelset::new("w", 1e3, [500.0, 50.0, 500.0], 0.46)])
            .with_elements([Element::new(
                name,
                [End::body(on, [0.0; 3]), End::track([0.0; 3])],
                law,
            )])
    }

    fn identity(parameters: &VehicleParameters) -> Identity {
        Identity::new(parameters, 1e-3, None)
    }

    #[test]
    fn every_part_of_a_vehicle_is_part_of_its_identity() {
        let rods = [1e6, 2e6].map(|stiffness_n_per_m| Law::TractionRod {
            stiffness_n_per_m,
            damping_n_s_per_m: 0.0,
        });
        let [rod, stiffer_rod] = rods;
        let usual = vehicle("e", "b", stop(Direction::Lateral));
        let mut heavier = usual.clone();
        heavier.bodies[1].mass_kg += 1.0;
        let mut wider = usual.clone();
        wider.elements[0].ends[0].at_m[1] = 1e-3;
        let mut larger = usual.clone();
        larger.wheelsets[0].radius_m = 0.5;
        let mut renamed = usual.clone();
        renamed.bodies[0].name = "c".to_owned();
        let mut without = usual.clone();
        without.elements.clear();
        let vehicles = [
            usual,
            heavier,
            wider,
            larger,
            renamed,
            without,
            vehicle("other", "b", stop(Direction::Lateral)),
            vehicle("e", "ab", stop(Direction::Lateral)),
            vehicle("e", "b", stop(Direction::Vertical)),
            vehicle("e", "b", damper(10e3, Direction::Lateral)),
            vehicle("e", "b", damper(10e3, Direction::Vertical)),
            vehicle("e", "b", friction(1e3, None)),
            vehicle("e", "b", friction(2e3, None)),
            vehicle("e", "b", friction(1e3, Some((0.1, "s")))),
            vehicle("e", "b", friction(1e3, Some((0.2, "s")))),
            vehicle("e", "b", friction(1e3, Some((0.1, "t")))),
            vehicle("e", "b", rod),
            vehicle("e", "b", stiffer_rod),
        ];
        for (number, vehicle) in vehicles.iter().enumerate() {
            for other in &vehicles[..number] {
                assert_ne!(identity(vehicle), identity(other), "{vehicle:?} {other:?}");
            }
        }
        let rails = RailSupport::new(60.0);
        let stiffer = rails.with_vertical(80e6, 0.0);
        let on =
            |step_s: f64, rails: Option<&RailSupport>| Identity::new(&vehicles[0], step_s, rails);
        let others = [
            on(1e-3, Some(&rails)),
            on(1e-3, Some(&stiffer)),
            on(2e-3, None),
        ];
        assert_ne!(others[0], others[1]);
        assert!(!others.contains(&identity(&vehicles[0])));
    }

    /// An element `ea` on the body `b` is not an element `e` on the body `ab`, although the texts in a row are equal.
    #[test]
    fn names_are_told_apart_by_their_lengths() {
        let law = || stop(Direction::Lateral);
        assert_ne!(
            identity(&vehicle("ea", "b", law())),
            identity(&vehicle("e", "ab", law()))
        );
    }

    #[test]
    fn dampers_may_change_in_motion() {
        assert_eq!(
            identity(&vehicle("e", "b", damper(10e3, Direction::Lateral))),
            identity(&vehicle("e", "b", damper(20e3, Direction::Lateral)))
        );
    }
}
