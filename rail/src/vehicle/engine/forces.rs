//! Forces on the bodies at their current positions.

use std::sync::Arc;

use fearless_simd::Simd;

use super::block::Vector;
use super::elementwise::{Formula, for_all};
use super::rails::{displace, push};
use super::state::VehicleState;
use super::{ContactBodies, Vehicle, WheelsetConstants};
use crate::contact::{Motion, PatchSource, RailDisplacement};
use crate::creep::CreepLaw;
use crate::math::number::Number;
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
        let positions = [&state.coordinates[..], &guidance.relative];
        for_all(simd, &InMiddle, positions, [&mut work.in_middle]);
        let rates = [
            &state.velocities[..],
            &guidance.pose_rate,
            &guidance.relative_rate,
        ];
        for_all(simd, &RelativeRate, rates, [&mut work.rates_in_middle]);
        let weights = [&self.inertia[..], &guidance.acceleration];
        for_all(simd, &Weight, weights, [&mut *forces]);
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
    /// contact, which is faster. Wheelsets with a second patch on a wheel take twice as long, so they are paired with
    /// each other.
    #[inline(always)]
    fn update_contacts(&self, state: &mut VehicleState, track: &Track, distance_m: f64) {
        let mut waiting = [None; 2];
        for number in 0..self.wheelsets.len() {
            let kind = usize::from(state.contacts[number].has_second_patch());
            waiting[kind] = match waiting[kind] {
                Some(other) => self.update_pair(state, track, distance_m, [other, number]),
                None => Some(number),
            };
        }
        let alone = match waiting {
            [Some(one), Some(other)] => self.update_pair(state, track, distance_m, [one, other]),
            [one, other] => one.or(other),
        };
        if let Some(number) = alone {
            self.update_one(state, track, distance_m, number);
        }
    }

    /// Updates two contacts. If they do not share their constants, only the first is updated, and the second is
    /// returned.
    #[inline]
    fn update_pair(
        &self,
        state: &mut VehicleState,
        track: &Track,
        distance_m: f64,
        numbers: [usize; 2],
    ) -> Option<usize> {
        let [first, second] = numbers;
        let contact = &self.contacts[first];
        if !Arc::ptr_eq(contact, &self.contacts[second]) {
            self.update_one(state, track, distance_m, first);
            return Some(second);
        }
        let (motion, rails) = self.motion_on_rails(state, track, distance_m, first);
        let (next_motion, next_rails) = self.motion_on_rails(state, track, distance_m, second);
        if let Ok(forces) = state.contacts.get_disjoint_mut(numbers) {
            contact.update_two(&[motion, next_motion], &[rails, next_rails], forces);
        }
        None
    }

    fn update_one(&self, state: &mut VehicleState, track: &Track, distance_m: f64, number: usize) {
        let (motion, rails) = self.motion_on_rails(state, track, distance_m, number);
        self.contacts[number].update(&motion, &rails, &mut state.contacts[number]);
    }

    /// Motion of a wheelset, and displacements of the rails under it.
    #[inline(always)]
    fn motion_on_rails(
        &self,
        state: &VehicleState,
        track: &Track,
        distance_m: f64,
        number: usize,
    ) -> (Motion, [RailDisplacement; 2]) {
        let constants = &self.wheelsets[number];
        let rails = self.rails_under(state, track, distance_m, constants);
        (self.wheelset_motion(state, constants), rails)
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
        let extremes = &mut state.work.extremes[number];
        extremes.add(contact);
        state.last_loads[number].add(contact, extremes);
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

/// Coordinate in the frame at the middle of the vehicle.
struct InMiddle;

impl Formula<2, 1> for InMiddle {
    #[inline(always)]
    fn at<T: Number>(&self, [q, relative]: [T; 2], _: [T; 1]) -> [T; 1] {
        [q + relative]
    }
}

/// Its rate.
struct RelativeRate;

impl Formula<3, 1> for RelativeRate {
    #[inline(always)]
    fn at<T: Number>(&self, [v, pose_rate, relative_rate]: [T; 3], _: [T; 1]) -> [T; 1] {
        [v - pose_rate + relative_rate]
    }
}

/// Gravity and centrifugal force.
struct Weight;

impl Formula<2, 1> for Weight {
    #[inline(always)]
    fn at<T: Number>(&self, [inertia, acceleration]: [T; 2], [force]: [T; 1]) -> [T; 1] {
        [force + inertia * acceleration]
    }
}
