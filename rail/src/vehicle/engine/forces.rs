//! Forces on the bodies at their current positions.

use std::sync::Arc;

use fearless_simd::Simd;

use super::block::Vector;
use super::rails::{displace, push};
use super::state::VehicleState;
use super::{ContactBodies, Vehicle, WheelsetConstants};
use crate::contact::{Motion, PatchSource, RailDisplacement};
use crate::creep::CreepLaw;
use crate::track::Track;

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// Adds the forces of springs and dashpots, gravity, track curvature and rails at the current positions.
    #[inline(always)]
    pub(super) fn act<V: Simd>(
        &self,
        simd: V,
        state: &mut VehicleState,
        track: &Track,
        distance_m: f64,
        forces: &mut [Vector],
    ) {
        let work = &mut state.work;
        let guidance = &work.guidance;
        let positions = work
            .in_middle
            .as_flattened_mut()
            .iter_mut()
            .zip(state.coordinates.as_flattened())
            .zip(guidance.relative.as_flattened());
        for ((in_middle, q), relative) in positions {
            *in_middle = q + relative;
        }
        let rates = work
            .rates_in_middle
            .as_flattened_mut()
            .iter_mut()
            .zip(state.velocities.as_flattened())
            .zip(guidance.pose_rate.as_flattened())
            .zip(guidance.relative_rate.as_flattened());
        for (((in_middle, v), pose_rate), relative_rate) in rates {
            *in_middle = v - pose_rate + relative_rate;
        }
        let accelerations = self
            .inertia
            .as_flattened()
            .iter()
            .zip(guidance.acceleration.as_flattened());
        for (force, (inertia, acceleration)) in
            forces.as_flattened_mut().iter_mut().zip(accelerations)
        {
            *force += inertia * acceleration;
        }
        let (displacements, rates) = (&work.in_middle, &work.rates_in_middle);
        self.springs.add(simd, -1.0, displacements, rates, forces);
        if let Some(on_track) = &self.on_track {
            let (relative, rate) = (&guidance.relative, &guidance.relative_rate);
            on_track.add(simd, 1.0, relative, rate, forces);
        }
        self.update_contacts(state, track, distance_m);
        for (number, constants) in self.wheelsets.iter().enumerate() {
            self.act_on_wheelset(state, number, constants, forces);
        }
    }

    /// Updates the contacts at the current positions: two wheelsets at a time if they share the constants of their
    /// contact, which is faster.
    #[inline(always)]
    fn update_contacts(&self, state: &mut VehicleState, track: &Track, distance_m: f64) {
        let mut number = 0;
        while let Some(constants) = self.wheelsets.get(number) {
            let contact = &self.contacts[number];
            let motion = self.wheelset_motion(state, constants);
            let rails = self.rails_under(state, track, distance_m, constants);
            let next = self.wheelsets.get(number + 1);
            let next = next.filter(|_| Arc::ptr_eq(contact, &self.contacts[number + 1]));
            if let Some(next) = next {
                let motions = [motion, self.wheelset_motion(state, next)];
                let rails = [rails, self.rails_under(state, track, distance_m, next)];
                if let Some(forces) = state.contacts[number..].first_chunk_mut() {
                    contact.update_two(&motions, &rails, forces);
                }
                number += 2;
            } else {
                contact.update(&motion, &rails, &mut state.contacts[number]);
                number += 1;
            }
        }
    }

    /// Motion of a wheelset over its track.
    #[inline(always)]
    pub(super) fn wheelset_motion(
        &self,
        state: &VehicleState,
        constants: &WheelsetConstants,
    ) -> Motion {
        let body = constants.bodies.wheelset;
        let pose_rate = &state.work.guidance.pose_rate[body];
        let [lateral, vertical, roll, _, yaw] = state.coordinates[body];
        let v = state.velocities[body];
        let free = constants.carried.motion(state.speed_m_per_s);
        Motion {
            lateral_m: lateral,
            vertical_m: free.vertical_m + vertical,
            roll_rad: roll,
            yaw_rad: yaw,
            lateral_velocity_m_per_s: v[0] - pose_rate[0],
            vertical_velocity_m_per_s: v[1],
            roll_rate_rad_per_s: v[2] - pose_rate[2],
            rotation_rad_per_s: free.rotation_rad_per_s - v[3],
            yaw_rate_rad_per_s: v[4],
            ..free
        }
    }

    /// Displacements of the rails under a wheelset.
    #[inline(always)]
    fn rails_under(
        &self,
        state: &VehicleState,
        track: &Track,
        distance_m: f64,
        constants: &WheelsetConstants,
    ) -> [RailDisplacement; 2] {
        let ContactBodies { wheelset, rails } = constants.bodies;
        let from_middle_m = self.positions[wheelset].x_m;
        let mut under = track.displacements(distance_m + from_middle_m, state.speed_m_per_s);
        if let Some(rail) = rails {
            displace(
                &mut under,
                &state.coordinates[rail],
                &state.velocities[rail],
            );
        }
        for rail in &mut under {
            rail.friction_ratio *= state.friction_factor;
        }
        under
    }

    /// Adds the forces of a contact to those on the wheelset and its rails.
    #[inline(always)]
    fn act_on_wheelset(
        &self,
        state: &mut VehicleState,
        number: usize,
        constants: &WheelsetConstants,
        forces: &mut [Vector],
    ) {
        let WheelsetConstants {
            bodies:
                ContactBodies {
                    wheelset: body,
                    rails: on_rails,
                },
            standing_n,
            carried,
            axle_load_n,
            spin_inertia_kg_m2,
            ..
        } = constants;
        let contact = &state.contacts[number];
        state.work.extremes[number].add(contact);
        let [_, fy, fz] = contact.force_n;
        let [mx, my, mz] = contact.moment_n_m;
        let turned = state.work.guidance.relative[*body][2];
        let [_, _, roll, _, yaw] = state.coordinates[*body];
        let v = &state.velocities[*body];
        let momentum = spin_inertia_kg_m2 * carried.motion(state.speed_m_per_s).rotation_rad_per_s;
        let sums = &mut forces[*body];
        sums[0] += fy - turned * fz;
        sums[1] += fz + turned * fy + axle_load_n;
        sums[2] += mx - momentum * v[4];
        // Moment about the axle, which is yawed and rolled.
        sums[3] += my - yaw * mx + roll * mz;
        sums[4] += mz + momentum * v[2];
        if let Some(rail) = on_rails {
            push(contact, standing_n, &mut forces[*rail]);
        }
    }
}
