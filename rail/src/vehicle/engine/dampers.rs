//! Steps of dampers, stops and friction elements, once per tick.

use std::array::from_fn;

use dashpot_core::{DamperState, step_bank_with};

use super::Vehicle;
use super::across::{Across, DamperElement};
use super::block::{N, Vector};
use super::state::VehicleState;
use crate::contact::PatchSource;
use crate::creep::CreepLaw;
use crate::track::Track;

/// Number of dampers that are stepped together. The last damper also fills the unused lanes.
const BANK: usize = 8;

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// States of the dampers with the bodies at rest at `coordinates`, padded to whole banks.
    pub(super) fn dampers_at_rest(&self, coordinates: &[Vector]) -> Vec<DamperState<f64>> {
        let at_rest = |element: &DamperElement| {
            let displacement = element.across.displacement(|body| coordinates[body]);
            element.damper.at_rest(displacement)
        };
        let mut states: Vec<_> = self.dampers.iter().map(at_rest).collect();
        if let Some(last) = states.last().copied() {
            states.resize(states.len().next_multiple_of(BANK), last);
        }
        states
    }

    /// Computes the forces of dampers, stops and friction elements at the end of the tick from the predicted positions
    /// of the bodies.
    #[inline(always)]
    pub(super) fn step_dampers(&self, state: &mut VehicleState, track: &Track) {
        let h = self.step_s;
        let speed = state.speed_m_per_s;
        let distance = state.distance_m + h * speed;
        let work = &mut state.work;
        let guidance = &mut work.guidance;
        guidance.update(track.layout(), distance, speed, &self.positions);
        let moved = state
            .coordinates
            .as_flattened()
            .iter()
            .zip(state.velocities.as_flattened())
            .zip(state.accelerations.as_flattened())
            .zip(guidance.pose.as_flattened())
            .zip(state.pose.as_flattened())
            .zip(guidance.relative.as_flattened());
        let targets = work
            .residual
            .as_flattened_mut()
            .iter_mut()
            .zip(work.in_middle.as_flattened_mut());
        for ((predicted, in_middle), (((((q, v), a), pose), last_pose), relative)) in
            targets.zip(moved)
        {
            *predicted = q + h * (v + 0.5 * h * a) - (pose - last_pose);
            *in_middle = *predicted + relative;
        }
        let (on_track, in_middle) = (&work.residual, &work.in_middle);
        let displacement = |across: &Across| {
            let from = if across.is_on_track() {
                on_track
            } else {
                in_middle
            };
            across.displacement(|body| from[body])
        };
        let displacements = &mut state.damper_displacements_m;
        let velocities = &mut state.damper_velocities_m_per_s;
        let motions = displacements.iter_mut().zip(velocities);
        for (element, (number, velocity)) in self.dampers.iter().zip(motions) {
            let new = displacement(&element.across);
            *velocity = (new - *number) / h;
            *number = new;
        }
        let (banks, _) = state.dampers.as_chunks_mut::<BANK>();
        let elements = self.dampers.chunks(BANK).zip(displacements.chunks(BANK));
        let forces = work.target_damper_forces_n.chunks_mut(BANK);
        for ((states, (elements, displacements)), forces) in
            banks.iter_mut().zip(elements).zip(forces)
        {
            let last = elements.len() - 1;
            let dampers: [_; BANK] = from_fn(|lane| &elements[lane.min(last)].damper);
            let displacements: [_; BANK] = from_fn(|lane| displacements[lane.min(last)]);
            let mut own = [0.0; BANK];
            step_bank_with(self.width, &dampers, states, &displacements, &mut own);
            forces.copy_from_slice(&own[..=last]);
        }
        // A damper with an external force is stepped too, so that its model can take over again.
        let outside = state.outside_forces_n.iter();
        for (force, outside) in work.target_damper_forces_n.iter_mut().zip(outside) {
            *force = outside.unwrap_or(*force);
        }
        for (element, force) in self.stops.iter().zip(&mut work.target_stop_forces_n) {
            *force = element.force(displacement(&element.across));
        }
        let sliders = state.sliders_m.iter_mut();
        let targets = sliders.zip(&mut work.target_friction_forces_n);
        for (element, (slider, force)) in self.frictions.iter().zip(targets) {
            let limit = element.limit_n(displacement);
            *force = element.force(displacement(&element.across), limit, slider);
        }
        self.pull(state);
        state.add_applied();
    }

    /// Sums the forces of dampers, stops and friction elements on the bodies at the start of the tick, and their change
    /// during the tick.
    #[inline(always)]
    fn pull(&self, state: &mut VehicleState) {
        let work = &mut state.work;
        work.tick_forces.fill([0.0; N]);
        work.tick_changes.fill([0.0; N]);
        let dampers = self.dampers.iter().map(|element| &element.across);
        let stops = self.stops.iter().map(|element| &element.across);
        let frictions = self.frictions.iter().map(|element| &element.across);
        let before = state
            .damper_forces_n
            .iter()
            .chain(&state.stop_forces_n)
            .chain(&state.friction_forces_n);
        let after = work
            .target_damper_forces_n
            .iter()
            .chain(&work.target_stop_forces_n)
            .chain(&work.target_friction_forces_n);
        let all = dampers.chain(stops).chain(frictions);
        for (across, (before, after)) in all.zip(before.zip(after)) {
            across.pull(*before, &mut work.tick_forces);
            across.pull(after - before, &mut work.tick_changes);
        }
    }
}
