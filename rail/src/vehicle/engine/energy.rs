//! Energy of a vehicle on straight level track.

use super::block::Vector;
use super::rails::displace;
use super::state::VehicleState;
use super::{ContactBodies, Vehicle};
use crate::contact::{PatchSource, RailDisplacement};
use crate::creep::CreepLaw;
use crate::math::dispatch::dispatch;
use crate::vehicle::error::VehicleError;

/// Energy of a vehicle relative to its equilibrium on straight level track at the same speed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Energy {
    /// Kinetic energy of the bodies' motion relative to the track frame, including wheel rotation beyond free rolling,
    /// J.
    pub kinetic_j: f64,
    /// Potential energy of springs and weight, J. The mounts of dampers and the springs of
    /// friction elements are not included.
    pub potential_j: f64,
    /// Elastic energy of the contact, J.
    pub contact_j: f64,
    /// Power dissipated by the dashpots parallel to springs, W.
    pub dissipation_w: f64,
}

impl Energy {
    /// Returns the total stored energy, J.
    pub fn total_j(&self) -> f64 {
        self.kinetic_j + self.potential_j + self.contact_j
    }
}

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// Returns the energy of a state on straight level track.
    ///
    /// # Errors
    /// A state of another vehicle.
    pub fn energy(&self, state: &VehicleState) -> Result<Energy, VehicleError> {
        self.check_state(state)?;
        let zeros = vec![Vector::default(); self.inertia.len()];
        let power = |q: &[Vector], v: &[Vector], along: &[Vector]| {
            let mut forces = zeros.clone();
            dispatch!(self.level, simd => self.springs.add(simd, 1.0, q, v, &mut forces));
            let pairs = forces.iter().flatten().zip(along.iter().flatten());
            pairs.map(|(force, along)| force * along).sum::<f64>()
        };
        let mut energy = Energy {
            potential_j: 0.5 * power(&state.coordinates, &zeros, &state.coordinates),
            dissipation_w: power(&zeros, &state.velocities, &state.velocities),
            ..Energy::default()
        };
        for (inertia, velocity) in self.inertia.iter().zip(&state.velocities) {
            for (inertia, velocity) in inertia.iter().zip(velocity) {
                energy.kinetic_j += 0.5 * inertia * velocity * velocity;
            }
        }
        for (constants, contact) in self.wheelsets.iter().zip(&self.contacts) {
            let free = state.speed_m_per_s / constants.carried.rolling_radius_m;
            // Rolling forward is a rotation nose down. The energy of the rotation is proportional to (free - rate)^2 -
            // free^2. The sum above already contains rate^2.
            let rate = state.velocities[constants.bodies.wheelset][3];
            energy.kinetic_j -= constants.spin_inertia_kg_m2 * free * rate;
            let ContactBodies { wheelset, rails } = constants.bodies;
            energy.potential_j -= constants.axle_load_n * state.coordinates[wheelset][1];
            if let Some(rails) = rails {
                // The rail supports balance the force of the wheelset at standstill.
                let pairs = constants.standing_n.iter().zip(&state.coordinates[rails]);
                energy.potential_j += pairs.map(|(force, q)| force * q).sum::<f64>();
            }
            let motion = self.wheelset_motion(state, constants);
            let mut displacements = [RailDisplacement::default(); 2];
            if let Some(rails) = rails {
                let (displaced, rates) = (&state.coordinates[rails], &state.velocities[rails]);
                displace(&mut displacements, displaced, rates);
            }
            let contact_j = contact.elastic_energy_j(&motion, &displacements);
            energy.contact_j += contact_j.iter().sum::<f64>();
            energy.contact_j -= constants.carried.contact_j;
        }
        Ok(energy)
    }
}
