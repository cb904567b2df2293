//! One tick: the linearly implicit generalised-alpha method.

use std::array::from_fn;

use fearless_simd::{Simd, dispatch};

use super::block::{N, Vector};
use super::extremes::Extremes;
use super::method::Method;
use super::rails::{displace, push};
use super::state::VehicleState;
use super::tangent::{ContactBlocks, Weights, add_contact};
use super::{Vehicle, WheelsetConstants};
use crate::contact::{Motion, PatchSource};
use crate::creep::CreepLaw;
use crate::track::Track;

/// A larger displacement or rotation counts as divergence, m or rad.
pub(super) const MAX_DISPLACEMENT: f64 = 10.0;

/// A larger acceleration counts as divergence, m/s^2 or rad/s^2.
const MAX_ACCELERATION: f64 = 1e6;

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
        self.relax_friction(state);
    }

    #[inline(always)]
    fn substep<V: Simd>(&self, simd: V, state: &mut VehicleState, track: &Track, substep: usize) {
        let distance = state.distance_m + self.method.step_s * state.speed_m_per_s;
        self.predict(state, track, distance);
        let mut forces = std::mem::take(&mut state.work.residual);
        let share = substep as f64 / self.method.substeps as f64;
        let pull = state.work.tick_forces.iter().zip(&state.work.tick_changes);
        for (force, (before, change)) in forces.iter_mut().zip(pull) {
            for i in 0..N {
                force[i] = before[i] + share * change[i];
            }
        }
        self.act(simd, state, track, distance, &mut forces);
        // Impacts last longer than two steps, so two consecutive steps share one factorisation.
        if substep % 2 == 1 {
            self.factorise(simd, state);
        }
        self.correct(simd, state, &mut forces);
        state.work.residual = forces;
        state.distance_m = distance;
    }

    /// Computes coordinates and velocities at the end of a step with the predicted accelerations.
    #[inline(always)]
    fn predict(&self, state: &mut VehicleState, track: &Track, distance_m: f64) {
        let Method {
            step_s: h,
            to_velocity,
            to_displacement,
            ..
        } = self.method;
        let speed = state.speed_m_per_s;
        let guidance = &mut state.work.guidance;
        guidance.update(track.layout(), distance_m, speed, &self.positions);
        let bodies = state.coordinates.iter_mut().zip(&mut state.velocities);
        let accelerations = state
            .accelerations
            .iter_mut()
            .zip(&mut state.last_accelerations);
        let poses = state.pose.iter_mut().zip(&guidance.pose);
        for (((coordinates, velocity), (acceleration, last)), (pose, new_pose)) in
            bodies.zip(accelerations).zip(poses)
        {
            // Reading everything before writing lets the compiler vectorise the five coordinates.
            let (q, v, a) = (*coordinates, *velocity, *acceleration);
            let predicted: Vector = from_fn(|i| self.method.predicted(a[i], last[i]));
            let change: Vector = from_fn(|i| predicted[i] - a[i]);
            let moved: Vector = from_fn(|i| new_pose[i] - pose[i]);
            *coordinates = from_fn(|i| {
                q[i] + h * (v[i] + 0.5 * h * a[i]) + to_displacement * change[i] - moved[i]
            });
            *velocity = from_fn(|i| v[i] + h * a[i] + to_velocity * change[i]);
            *acceleration = predicted;
            *last = a;
            *pose = *new_pose;
        }
    }

    /// Adds the contact's tangent at the predicted positions to the system and factorises it.
    #[inline(always)]
    fn factorise<V: Simd>(&self, simd: V, state: &mut VehicleState) {
        let method = &self.method;
        let weights = Weights {
            stiffness: method.stiffness_weight(),
            damping: method.damping_weight(),
        };
        let system = &mut state.work.system;
        system.set(&self.system);
        for (constants, forces) in self.wheelsets.iter().zip(&state.contacts) {
            let (blocks, surface) = (&constants.blocks, constants.surface);
            let speed = state.speed_m_per_s;
            add_contact(simd, system, blocks, forces, surface, speed, weights);
        }
        state.is_diverged |= !self.structure.factorise(simd, system);
    }

    /// Applies one Newton correction with the forces at the predicted positions.
    #[inline(always)]
    fn correct<V: Simd>(&self, simd: V, state: &mut VehicleState, forces: &mut [Vector]) {
        let method = &self.method;
        let motion = state
            .accelerations
            .as_flattened()
            .iter()
            .zip(state.last_accelerations.as_flattened())
            .zip(state.forces.as_flattened())
            .zip(self.inertia.as_flattened());
        for (residual, (((a, last), old), inertia)) in
            forces.as_flattened_mut().iter_mut().zip(motion)
        {
            *residual = method.new_force * *residual + method.old_force * old
                - inertia * (a + method.old_inertia * last);
        }
        self.structure.solve(simd, &state.work.system, forces);
        let to_force = 1.0 / method.new_force;
        let bodies = state.coordinates.iter_mut().zip(&mut state.velocities);
        let accelerations = state
            .accelerations
            .iter_mut()
            .zip(&state.last_accelerations);
        let loads = state.forces.iter_mut().zip(&self.inertia);
        let mut is_bounded = true;
        for (((change, (coordinates, velocity)), (acceleration, last)), (force, inertia)) in
            forces.iter().zip(bodies).zip(accelerations).zip(loads)
        {
            let (q, v, a, old) = (*coordinates, *velocity, *acceleration, *force);
            let a: Vector = from_fn(|i| a[i] + change[i]);
            let q: Vector = from_fn(|i| q[i] + method.to_displacement * change[i]);
            // Force at the end of the step according to the method.
            let inertia: Vector = from_fn(|i| inertia[i] * (a[i] + method.old_inertia * last[i]));
            *coordinates = q;
            *velocity = from_fn(|i| v[i] + method.to_velocity * change[i]);
            *acceleration = a;
            *force = from_fn(|i| (inertia[i] - method.old_force * old[i]) * to_force);
            is_bounded &=
                (0..N).all(|i| (q[i].abs() < MAX_DISPLACEMENT) & (a[i].abs() < MAX_ACCELERATION));
        }
        for constants in &self.wheelsets {
            state.coordinates[constants.blocks.wheelset][3] = 0.0;
        }
        state.is_diverged |= !is_bounded;
    }

    /// Adds the forces of springs and dashpots, gravity, track curvature and rails at the current positions.
    #[inline(always)]
    fn act<V: Simd>(
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
        for (number, constants) in self.wheelsets.iter().enumerate() {
            self.act_on_wheelset(state, track, distance_m, number, constants, forces);
        }
    }

    /// Motion of a wheelset over its track.
    #[inline(always)]
    pub(super) fn wheelset_motion(
        &self,
        state: &VehicleState,
        constants: &WheelsetConstants,
    ) -> Motion {
        let body = constants.blocks.wheelset;
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

    #[inline(always)]
    fn act_on_wheelset(
        &self,
        state: &mut VehicleState,
        track: &Track,
        distance_m: f64,
        number: usize,
        constants: &WheelsetConstants,
        forces: &mut [Vector],
    ) {
        let WheelsetConstants {
            blocks:
                ContactBlocks {
                    wheelset: body,
                    rails: on_rails,
                },
            standing_n,
            carried,
            axle_load_n,
            spin_inertia_kg_m2,
            ..
        } = *constants;
        let speed = state.speed_m_per_s;
        let motion = self.wheelset_motion(state, constants);
        let mut rails = track.displacements(distance_m + self.positions[body].x_m, speed);
        if let Some((rail, _)) = on_rails {
            displace(
                &mut rails,
                &state.coordinates[rail],
                &state.velocities[rail],
            );
        }
        for rail in &mut rails {
            rail.friction_ratio *= state.friction_factor;
        }
        let contact = &mut state.contacts[number];
        self.contacts[number].update(&motion, &rails, contact);
        state.work.extremes[number].add(contact);
        let [_, fy, fz] = contact.force_n;
        let [mx, my, mz] = contact.moment_n_m;
        let turned = state.work.guidance.relative[body][2];
        let [_, _, roll, _, yaw] = state.coordinates[body];
        let v = &state.velocities[body];
        let momentum = spin_inertia_kg_m2 * carried.motion(speed).rotation_rad_per_s;
        let sums = &mut forces[body];
        sums[0] += fy - turned * fz;
        sums[1] += fz + turned * fy + axle_load_n;
        sums[2] += mx - momentum * v[4];
        // Moment about the axle, which is yawed and rolled.
        sums[3] += my - yaw * mx + roll * mz;
        sums[4] += mz + momentum * v[2];
        if let Some((rail, _)) = on_rails {
            push(contact, &standing_n, &mut forces[rail]);
        }
    }
}
