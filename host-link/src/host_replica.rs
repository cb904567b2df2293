//! Replica of the dampers of a target on the host.

use dashpot_core::link::Forces;
use dashpot_core::{Damper, DamperState};

use super::SessionError;
use super::report::{Measured, Mismatch, Target};

/// Replica of the dampers of a target, at the last tick that both sides confirmed or that the target did not answer.
pub(super) struct HostReplica {
    /// One damper per slot.
    pub(super) dampers: Vec<Damper<f32>>,
    pub(super) tick: u32,
    states: Vec<DamperState<f32>>,
    forces_n: Vec<f32>,
}

impl HostReplica {
    /// Creates a replica at rest at `start_m` (m), from one damper for all slots of `target` or one per slot.
    ///
    /// # Errors
    /// The number of dampers is neither 1 nor the number of slots, or a damper is built for a different step than the
    /// target.
    pub(super) fn at_rest(
        dampers: &[Damper<f32>],
        target: &Target,
        start_m: f32,
    ) -> Result<Self, SessionError> {
        let slots = target.dampers;
        let dampers = match dampers {
            [one] => vec![*one; slots],
            each if each.len() == slots => each.to_vec(),
            other => {
                let dampers = other.len();
                return Err(SessionError::DamperCount { dampers, slots });
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
            forces_n: vec![0.0; slots],
            dampers,
        })
    }

    /// Returns the states as bytes.
    pub(super) fn saved(&self) -> Vec<u8> {
        self.states.iter().flat_map(|s| s.to_bytes()).collect()
    }

    /// Clears status bits and rejected inputs.
    pub(super) fn clear_status(&mut self) {
        for state in &mut self.states {
            state.clear_status();
        }
    }

    /// Forces of the last tick (N).
    pub(super) fn forces_n(&self) -> &[f32] {
        &self.forces_n
    }

    /// Steps the replica by one tick that the target has not answered.
    pub(super) fn step_alone(&mut self, displacements_m: &[f32]) {
        self.tick = self.tick.wrapping_add(1);
        for (slot, state) in self.states.iter_mut().enumerate() {
            self.forces_n[slot] = self.dampers[slot].step(state, displacements_m[slot]);
        }
    }

    /// Steps the replica to the tick of `forces` and compares its forces and status words with those of the target.
    pub(super) fn step(
        &mut self,
        displacements_m: &[f32],
        forces: &Forces,
        measured: &mut Measured,
    ) {
        self.tick = forces.tick;
        for (slot, state) in self.states.iter_mut().enumerate() {
            let host_force_n = self.dampers[slot].step(state, displacements_m[slot]);
            let host_status = state.status().bits();
            let (target_force_n, target_status) = (forces.forces_n[slot], forces.status[slot]);
            self.forces_n[slot] = host_force_n;
            if host_force_n.to_bits() != target_force_n.to_bits() || host_status != target_status {
                measured.mismatch(Mismatch {
                    tick: self.tick,
                    damper: slot,
                    target_force_n,
                    host_force_n,
                    target_status,
                    host_status,
                });
            }
        }
    }
}
