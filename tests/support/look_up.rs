//! The lower bound of the cost in the benches: a force-velocity table evaluated at the difference of two displacements,
//! without dynamics.

use dashpot_reference::damper::Reference;

/// Force at equally spaced velocities.
pub struct LookUp {
    forces_n: Vec<f32>,
    /// Table intervals per metre of displacement in a step (1/m).
    scale: f32,
    last: f32,
}

impl LookUp {
    const HALF: usize = 256;

    /// Tabulates the static curve of `reference` up to `velocity_m_per_s` in both directions, for a step (s).
    pub fn new(reference: &Reference, velocity_m_per_s: f64, step_s: f64) -> Self {
        let forces_n = (0..=2 * Self::HALF)
            .map(|index| {
                let fraction = index as f64 / Self::HALF as f64 - 1.0;
                reference.static_force(fraction * velocity_m_per_s) as f32
            })
            .collect();
        Self {
            forces_n,
            scale: (Self::HALF as f64 / (velocity_m_per_s * step_s)) as f32,
            last: 0.0,
        }
    }

    /// Force (N) at the displacement (m) of the tick, linear between entries, held beyond the ends.
    pub fn step(&mut self, x: f32) -> f32 {
        let position = (x - self.last) * self.scale + Self::HALF as f32;
        self.last = x;
        let position = position.clamp(0.0, 2.0 * Self::HALF as f32 - 1.0);
        let index = position as usize;
        let fraction = position - index as f32;
        self.forces_n[index] + fraction * (self.forces_n[index + 1] - self.forces_n[index])
    }
}
