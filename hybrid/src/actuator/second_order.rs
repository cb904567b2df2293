//! A linear actuator of second order, which no force disturbs.

use dashpot_files::actuator::SecondOrder;
use nalgebra::{Matrix2, Vector1, Vector2};

use super::stopped;
use crate::linear::LinearSystem;

/// The actuator in motion.
#[derive(Clone, Debug)]
pub(super) struct MovingSecondOrder {
    /// Displacement (m) and velocity.
    system: LinearSystem<2, 1>,
}

impl MovingSecondOrder {
    pub(super) fn new(law: &SecondOrder, step_s: f64) -> Self {
        let w = std::f64::consts::TAU * law.frequency_hz;
        Self {
            system: of_second_order(w, law.damping_ratio, step_s),
        }
    }

    /// Takes a step between the ends of the stroke (m).
    pub(super) fn step(&mut self, command_m: f64, stroke_m: f64) {
        self.system.step(&Vector1::new(command_m));
        let state = &mut self.system.state;
        [state[0], state[1]] = stopped([state[0], state[1]], stroke_m);
    }

    pub(super) fn displacement_m(&self) -> f64 {
        self.system.state[0]
    }
}

/// `x'' = w^2 (u - x) - 2 z w x'`.
pub(super) fn of_second_order(w: f64, z: f64, step_s: f64) -> LinearSystem<2, 1> {
    let a = Matrix2::new(0.0, 1.0, -w * w, -2.0 * z * w);
    LinearSystem::new(&a, &Vector2::new(0.0, w * w), step_s)
}
