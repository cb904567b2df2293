//! One tick: dampers once, then the steps of the integration.

use std::array::from_fn;

use fearless_simd::Simd;

use super::Vehicle;
use super::block::N;
use super::elementwise::{Formula, for_all};
use super::extremes::{Extremes, LastLoads};
use super::state::VehicleState;
use crate::contact::PatchSource;
use crate::creep::CreepLaw;
use crate::math::dispatch::dispatch;
use crate::math::number::Number;
use crate::track::Track;

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// Advances the state by one tick along the track.
    ///
    /// Never fails, whatever the state contains, and does not allocate. The cost varies only with the number of loaded
    /// contact patches. A diverged state or a state of another vehicle is not stepped; [`VehicleState::stop`] reports
    /// the reason.
    pub fn step(&self, state: &mut VehicleState, track: &Track) {
        if !self.can_step(state) {
            state.met_other_vehicle = true;
            return;
        }
        dispatch!(self.level, simd => self.tick(simd, state, track));
    }

    #[inline(always)]
    fn tick<V: Simd>(&self, simd: V, state: &mut VehicleState, track: &Track) {
        if state.is_diverged() {
            return;
        }
        state.work.extremes.fill(Extremes::NONE);
        self.step_dampers(state, track);
        for substep in 1..=self.method.substeps {
            self.substep(simd, state, track, substep);
            if state.is_diverged {
                return;
            }
        }
        state
            .damper_forces_n
            .clone_from(&state.work.target_damper_forces_n);
        state
            .stop_forces_n
            .clone_from(&state.work.target_stop_forces_n);
        state
            .friction_forces_n
            .clone_from(&state.work.target_friction_forces_n);
        state.ticks = state.ticks.saturating_add(1);
    }

    /// Computes forces and accelerations before the first step.
    pub(super) fn begin(&self, state: &mut VehicleState, track: &Track) {
        let mut forces = vec![[0.0; N]; self.inertia.len()];
        let distance_m = state.distance_m;
        dispatch!(self.level, simd => self.act(simd, state, track, distance_m, &mut forces));
        state.forces = forces;
        for (body, forces) in state.forces.iter().enumerate() {
            state.accelerations[body] = from_fn(|i| forces[i] / self.inertia[body][i]);
        }
        state.last_accelerations.clone_from(&state.accelerations);
        for (last, contact) in state.last_loads.iter_mut().zip(&state.contacts) {
            *last = LastLoads::constant(contact);
        }
        self.relax_friction(state);
    }

    #[inline(always)]
    fn substep<V: Simd>(&self, simd: V, state: &mut VehicleState, track: &Track, substep: usize) {
        let distance = state.distance_m + self.method.step_s * state.speed_m_per_s;
        self.predict(state, track, distance);
        let mut forces = std::mem::take(&mut state.work.residual);
        let share = substep as f64 / self.method.substeps as f64;
        let pull = [&state.work.tick_forces[..], &state.work.tick_changes];
        for_all(simd, &Share(share), pull, [&mut forces]);
        self.act(simd, state, track, distance, &mut forces);
        if self.method.factorises(substep - 1, state.speed_m_per_s) {
            self.factorise(simd, state);
        }
        self.correct(simd, state, &mut forces);
        state.work.residual = forces;
        state.distance_m = distance;
    }
}

/// A force that changes linearly, at a share of its time.
struct Share(f64);

impl Formula<2, 1> for Share {
    #[inline(always)]
    fn at<T: Number>(&self, [before, change]: [T; 2], _: [T; 1]) -> [T; 1] {
        [before + change * self.0]
    }
}
