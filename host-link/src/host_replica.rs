//! The target's dampers on the host.

use dashpot_core::link::Forces;
use dashpot_core::{Damper, DamperState};

use super::SessionError;
use super::report::{Measured, Mismatch, Target};

/// The same dampers on the host, at the last tick that both sides confirmed.
pub(super) struct HostReplica {
    /// One for each place.
    pub(super) dampers: Vec<Damper<f32>>,
    pub(super) tick: u32,
    states: Vec<DamperState<f32>>,
    forces_n: Vec<f32>,
}

impl HostReplica {
    /// At rest at `start_m` (m), `dampers` being one for all places of `target` or one for each.
    ///
    /// # Errors
    /// Another number of dampers, or one built for another step than the target's.
    pub(super) fn at_rest(
        dampers: &[Damper<f32>],
        target: &Target,
        start_m: f32,
    ) -> Result<Self, SessionError> {
        let places = target.dampers;
        let dampers = match dampers {
            [one] => vec![*one; places],
            each if each.len() == places => each.to_vec(),
            other => {
                let dampers = other.len();
                return Err(SessionError::Dampers { dampers, places });
            }
        };
        if let Some(other) = dampers.iter().find(|d| d.step_s() != target.step_s) {
            return Err(SessionError::Step {
                damper_s: other.step_s(),
                target_s: target.step_s,
            });
        }
        Ok(Self {
            tick: 0,
            states: dampers.iter().map(|d| d.at_rest(start_m)).collect(),
            forces_n: vec![0.0; places],
            dampers,
        })
    }

    /// The states as bytes.
    pub(super) fn saved(&self) -> Vec<u8> {
        self.states.iter().flat_map(|s| s.to_bytes()).collect()
    }

    /// Forces of the last tick (N).
    pub(super) fn forces_n(&self) -> &[f32] {
        &self.forces_n
    }

    /// The tick of `forces` on this side, compared with them.
    pub(super) fn step(
        &mut self,
        displacements_m: &[f32],
        forces: &Forces,
        measured: &mut Measured,
    ) {
        self.tick = forces.tick;
        for (place, state) in self.states.iter_mut().enumerate() {
            let host_force_n = self.dampers[place].step(state, displacements_m[place]);
            let host_status = state.status().bits();
            let (target_force_n, target_status) = (forces.forces_n[place], forces.status[place]);
            self.forces_n[place] = host_force_n;
            if host_force_n.to_bits() != target_force_n.to_bits() || host_status != target_status {
                measured.mismatch(Mismatch {
                    tick: self.tick,
                    damper: place,
                    target_force_n,
                    host_force_n,
                    target_status,
                    host_status,
                });
            }
        }
    }
}
