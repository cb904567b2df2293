//! Work of a tick: dampers on a synthetic motion.

use std::hint::black_box;

use dashpot_core::{Damper, DamperState};

use dashpot_testbench::compiled::Compiled;
use dashpot_testbench::excitation::Excitation;

/// Dampers on a repeating motion: a ride that ends where it began, a decay, then rest.
pub(super) struct Bench<T> {
    damper: Damper<T>,
    states: Vec<DamperState<T>>,
    motion: Vec<T>,
    tick: usize,
}

impl<T: Compiled> Bench<T> {
    /// Creates `dampers` states of `damper`, which is built for `step_s` (s).
    pub(super) fn new(damper: Damper<T>, dampers: u32, step_s: f64) -> Self {
        let mut motion = Excitation::Ride.displacements_m(step_s);
        let last = motion.len() - 1;
        let end = motion[last];
        for (tick, x) in motion.iter_mut().enumerate() {
            *x -= end * tick as f64 / last as f64;
        }
        motion.extend(Excitation::Decay.displacements_m(step_s));
        motion.resize(motion.len() + (1.0 / step_s) as usize, 0.0);
        Self {
            states: vec![damper.at_rest(T::ZERO); dampers as usize],
            damper,
            motion: motion.into_iter().map(T::from_f64).collect(),
            tick: 0,
        }
    }

    /// Steps every damper once.
    pub(super) fn tick(&mut self) {
        let x = black_box(self.motion[self.tick]);
        for state in &mut self.states {
            black_box(T::compiled_step(&self.damper, state, x));
        }
        self.tick = (self.tick + 1) % self.motion.len();
    }
}
