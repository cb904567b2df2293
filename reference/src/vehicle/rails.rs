//! Flexible rails: under each wheel a mass on a spring and a dashpot, laterally and vertically.

use dashpot_rail::contact::{RailDisplacement, WheelsetForces};
use dashpot_rail::vehicle::RailSupport;

/// Motions of the rails under a wheelset: lateral and vertical of the left rail, then of the right rail.
const RAILS: usize = 4;

/// Flexible rails under all wheelsets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flexible {
    support: RailSupport,
    wheelsets: usize,
    /// Index of the first displacement in the state.
    first: usize,
}

impl Flexible {
    pub(super) fn new(support: RailSupport, wheelsets: usize, first: usize) -> Self {
        Self {
            support,
            wheelsets,
            first,
        }
    }

    /// Numbers of the state that belong to the rails.
    pub(super) fn size(&self) -> usize {
        2 * RAILS * self.wheelsets
    }

    /// Indices in the state of the displacement and of the velocity of a rail. `direction` is 0 for lateral, 1 for
    /// vertical motion.
    pub(super) fn places(&self, wheelset: usize, side: usize, direction: usize) -> [usize; 2] {
        let displacement = self.first + RAILS * wheelset + 2 * side + direction;
        [displacement, displacement + RAILS * self.wheelsets]
    }

    /// True if a number of the state is the velocity of a rail.
    pub(super) fn is_velocity(&self, place: usize) -> bool {
        (self.first + RAILS * self.wheelsets..self.first + self.size()).contains(&place)
    }

    /// Adds the motion of the rails under a wheelset to their irregularity.
    pub(super) fn displace(
        &self,
        state: &[f64],
        wheelset: usize,
        rails: &mut [RailDisplacement; 2],
    ) {
        for (side, rail) in rails.iter_mut().enumerate() {
            let [[y, v], [z, w]] = [0, 1].map(|direction| {
                self.places(wheelset, side, direction)
                    .map(|place| state[place])
            });
            rail.lateral_m += y;
            rail.lateral_velocity_m_per_s += v;
            rail.vertical_m += z;
            rail.vertical_velocity_m_per_s += w;
        }
    }

    /// Mass, stiffness and damping in a direction.
    pub(super) fn mass_on_spring(&self, direction: usize) -> [f64; 3] {
        let RailSupport {
            lateral_mass_kg,
            lateral_stiffness_n_per_m,
            lateral_damping_n_s_per_m,
            vertical_mass_kg,
            vertical_stiffness_n_per_m,
            vertical_damping_n_s_per_m,
            ..
        } = self.support;
        match direction {
            0 => [
                lateral_mass_kg,
                lateral_stiffness_n_per_m,
                lateral_damping_n_s_per_m,
            ],
            _ => [
                vertical_mass_kg,
                vertical_stiffness_n_per_m,
                vertical_damping_n_s_per_m,
            ],
        }
    }

    /// Writes the rates of the rails under a wheelset with the forces `contact`; `standing` are the forces of the
    /// rails on the wheels at rest, which the supports carry without displacement.
    pub(super) fn write_rates(
        &self,
        state: &[f64],
        wheelset: usize,
        contact: &WheelsetForces,
        standing: &[[f64; 3]; 2],
        rates: &mut [f64],
    ) {
        for (side, (wheel, standing)) in contact.wheels.iter().zip(standing).enumerate() {
            for direction in 0..2 {
                let [mass, stiffness, damping] = self.mass_on_spring(direction);
                let [at, moving] = self.places(wheelset, side, direction);
                let (q, v) = (state[at], state[moving]);
                let axis = 1 + direction;
                let pushed = standing[axis] - wheel.force_n[axis];
                rates[at] = v;
                rates[moving] = (pushed - stiffness * q - damping * v) / mass;
            }
        }
    }
}
