//! Energy of a vehicle on straight level track.

use fearless_simd::dispatch;

use super::Vehicle;
use super::block::Vector;
use super::state::VehicleState;
use super::tangent::ContactPlace;
use crate::contact::PatchSource;
use crate::creep::CreepLaw;
use crate::vehicle::error::VehicleError;

/// Energy of a vehicle beyond that of its standing on straight level track at the same speed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energy {
    /// Of all bodies in motion across the track, and of the wheels' rotation beyond rolling freely, J.
    pub kinetic_j: f64,
    /// Of springs and weight, J; what dampers store in their mounts is not in it.
    pub potential_j: f64,
    /// Of the patches, `2/5 N penetration` each after Hertz, J.
    pub contact_j: f64,
    /// Power that the dashpots beside the springs dissipate, W.
    pub dissipation_w: f64,
}

impl Energy {
    /// All that is stored, J.
    pub fn total_j(&self) -> f64 {
        self.kinetic_j + self.potential_j + self.contact_j
    }
}

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// Energy of a state on straight level track.
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
        for (constants, contact) in self.wheelsets.iter().zip(&state.contacts) {
            let free = state.speed_m_per_s / constants.carried.rolling_radius_m;
            // Rolling forward is nose down: (free - rate)^2 - free^2 beyond the square above.
            let rate = state.velocities[constants.place.wheelset][3];
            energy.kinetic_j -= constants.spin_inertia_kg_m2 * free * rate;
            let ContactPlace { wheelset, rails } = constants.place;
            energy.potential_j -= constants.axle_load_n * state.coordinates[wheelset][1];
            if let Some((rails, _)) = rails {
                // What the standing wheelset pushes them with, they are held against.
                let pairs = constants.standing_n.iter().zip(&state.coordinates[rails]);
                energy.potential_j += pairs.map(|(force, q)| force * q).sum::<f64>();
            }
            let patches = contact
                .wheels
                .iter()
                .flat_map(|wheel| wheel.loaded_patches());
            energy.contact_j += patches
                .map(|patch| 0.4 * patch.load_n * patch.penetration_m)
                .sum::<f64>();
            energy.contact_j -= constants.carried.contact_j;
        }
        Ok(energy)
    }
}
