//! The plant of the benchmark, slowed down by the force of its specimen.

use dashpot_files::actuator::Coupled;
use nalgebra::{SMatrix, Vector2};

use super::stopped;
use crate::linear::LinearSystem;

/// Forces are states in MN, so that all states have similar sizes.
const N_PER_MN: f64 = 1e6;

/// The actuator in motion.
#[derive(Clone, Debug)]
pub(super) struct MovingCoupled {
    /// Valve and its rate (MN/s and MN/s^2), force (MN), displacement (m) and velocity of the moving mass; the inputs
    /// are the command (m) and the force of the specimen (MN).
    system: LinearSystem<5, 2>,
    measured_gain: f64,
}

impl MovingCoupled {
    pub(super) fn new(law: &Coupled, step_s: f64) -> Self {
        let gain = law.valve_gain_n_per_m_s3 / N_PER_MN;
        let mass = law.moving_mass_kg;
        let mut a = SMatrix::<f64, 5, 5>::zeros();
        a[(0, 1)] = 1.0;
        a[(1, 0)] = -law.valve_stiffness_per_s2;
        a[(1, 1)] = -law.valve_damping_per_s;
        a[(1, 3)] = -gain;
        a[(2, 0)] = 1.0;
        a[(2, 2)] = -law.leakage_per_s;
        a[(2, 4)] = -law.interaction_n_per_m / N_PER_MN;
        a[(3, 4)] = 1.0;
        a[(4, 2)] = N_PER_MN / mass;
        a[(4, 3)] = -law.frame_stiffness_n_per_m / mass;
        a[(4, 4)] = -law.frame_damping_n_s_per_m / mass;
        let mut b = SMatrix::<f64, 5, 2>::zeros();
        b[(1, 0)] = gain;
        b[(4, 1)] = -N_PER_MN / mass;
        Self {
            system: LinearSystem::new(&a, &b, step_s),
            measured_gain: law.measured_gain,
        }
    }

    /// Takes a step between the ends of the stroke (m) with at most the largest force (N); returns true if the force
    /// was limited.
    pub(super) fn step(
        &mut self,
        command_m: f64,
        force_n: f64,
        [stroke_m, largest_n]: [f64; 2],
    ) -> bool {
        self.system
            .step(&Vector2::new(command_m, force_n / N_PER_MN));
        let most = largest_n / N_PER_MN;
        let force = &mut self.system.state[2];
        let is_limited = force.abs() > most;
        *force = force.clamp(-most, most);
        let state = &mut self.system.state;
        [state[3], state[4]] = stopped([state[3], state[4]], stroke_m);
        is_limited
    }

    pub(super) fn displacement_m(&self) -> f64 {
        self.system.state[3]
    }

    pub(super) fn measured_m(&self) -> f64 {
        self.measured_gain * self.displacement_m()
    }
}
