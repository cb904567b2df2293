//! One step: generalised alpha method, linearly implicit.

use fearless_simd::dispatch;

use super::blocks::{N, Vector};
use super::guidance::Guidance;
use super::method::Method;
use super::state::VehicleState;
use super::tangent::{Weights, add_contact};
use super::{Vehicle, WheelsetConstants};
use crate::contact::{Motion, PatchSource};
use crate::creep::CreepLaw;
use crate::track::Track;

/// Displacement or rotation beyond which nothing of a vehicle is left, m or rad.
const DIVERGED: f64 = 10.0;

/// Acceleration beyond which nothing of it is left, m/s^2 or rad/s^2.
const DIVERGED_RATE: f64 = 1e6;

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// One tick along the track.
    ///
    /// Cannot fail and does not allocate; every tick costs the same but for the number of patches that carry load.
    pub fn step(&self, state: &mut VehicleState, track: &Track) {
        dispatch!(self.level, _simd => self.tick(state, track));
    }

    #[inline(always)]
    fn tick(&self, state: &mut VehicleState, track: &Track) {
        if state.is_diverged {
            return;
        }
        self.step_dampers(state, track);
        for substep in 1..=self.method.substeps {
            self.substep(state, track, substep);
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
        state.ticks += 1;
    }

    /// Contact and track of the first moment.
    pub(super) fn begin(&self, state: &mut VehicleState, track: &Track) {
        let mut forces = vec![[0.0; N]; self.names.len()];
        self.act(state, track, state.distance_m, &mut forces);
        state.forces = forces;
        for (body, forces) in state.forces.iter().enumerate() {
            state.accelerations[body] = std::array::from_fn(|i| forces[i] / self.inertia[body][i]);
        }
        state.last_accelerations.clone_from(&state.accelerations);
    }

    /// Dampers and stops at the end of the tick, where the bodies are predicted to be.
    #[inline(always)]
    fn step_dampers(&self, state: &mut VehicleState, track: &Track) {
        let h = self.step_s;
        let speed = state.speed_m_per_s;
        let distance = state.distance_m + h * speed;
        let guidance = &mut state.work.guidance;
        Guidance::update(track.layout(), distance, speed, &self.stands, guidance);
        for body in 0..self.names.len() {
            let guidance = &guidance[body];
            let (q, v, a) = (
                &state.coordinates[body],
                &state.velocities[body],
                &state.accelerations[body],
            );
            let predicted: Vector = std::array::from_fn(|i| {
                q[i] + h * (v[i] + 0.5 * h * a[i]) - (guidance.pose[i] - state.pose[body][i])
            });
            state.work.residual[body] = predicted;
            state.work.in_middle[body] =
                std::array::from_fn(|i| predicted[i] + guidance.relative[i]);
        }
        let work = &mut state.work;
        for (number, element) in self.dampers.iter().enumerate() {
            let from = if element.across.is_on_track() {
                &work.residual
            } else {
                &work.in_middle
            };
            let displacement = element.across.displacement(|body| from[body]);
            state.damper_displacements_m[number] = displacement;
            // A damper whose force comes from outside follows, so that it can take over.
            let own = element
                .damper
                .step(&mut state.dampers[number], displacement);
            work.target_damper_forces_n[number] = state.outside_forces_n[number].unwrap_or(own);
        }
        for (number, element) in self.stops.iter().enumerate() {
            let from = if element.across.is_on_track() {
                &work.residual
            } else {
                &work.in_middle
            };
            let displacement = element.across.displacement(|body| from[body]);
            work.target_stop_forces_n[number] = element.force(displacement);
        }
    }

    #[inline(always)]
    fn substep(&self, state: &mut VehicleState, track: &Track, substep: usize) {
        let distance = state.distance_m + self.method.step_s * state.speed_m_per_s;
        self.predict(state, track, distance);
        let mut forces = std::mem::take(&mut state.work.residual);
        let share = substep as f64 / self.method.substeps as f64;
        self.pull(state, share, &mut forces);
        self.act(state, track, distance, &mut forces);
        // Impacts last longer than two steps: the same factors serve both.
        if substep % 2 == 1 {
            self.factorise(state);
        }
        self.correct(state, &mut forces);
        state.work.residual = forces;
        state.distance_m = distance;
    }

    /// Coordinates and velocities at the end of a step with the predicted accelerations.
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
        Guidance::update(track.layout(), distance_m, speed, &self.stands, guidance);
        let bodies = state.coordinates.iter_mut().zip(&mut state.velocities);
        let accelerations = state
            .accelerations
            .iter_mut()
            .zip(&mut state.last_accelerations);
        let poses = state.pose.iter_mut().zip(guidance.iter());
        for (((q, v), (a, last)), (pose, guidance)) in bodies.zip(accelerations).zip(poses) {
            for i in 0..N {
                let predicted = self.method.predicted(a[i], last[i]);
                let change = predicted - a[i];
                q[i] += h * (v[i] + 0.5 * h * a[i]) + to_displacement * change
                    - (guidance.pose[i] - pose[i]);
                v[i] += h * a[i] + to_velocity * change;
                last[i] = a[i];
                a[i] = predicted;
            }
            *pose = guidance.pose;
        }
    }

    /// Dampers and stops at their share of the way through the tick.
    #[inline(always)]
    fn pull(&self, state: &VehicleState, share: f64, forces: &mut [Vector]) {
        forces.fill([0.0; N]);
        let tick = state
            .damper_forces_n
            .iter()
            .zip(&state.work.target_damper_forces_n);
        for (element, (before, after)) in self.dampers.iter().zip(tick) {
            element
                .across
                .pull(before + share * (after - before), forces);
        }
        let tick = state
            .stop_forces_n
            .iter()
            .zip(&state.work.target_stop_forces_n);
        for (element, (before, after)) in self.stops.iter().zip(tick) {
            element
                .across
                .pull(before + share * (after - before), forces);
        }
    }

    /// The system with what the contact resists at the predicted place, factorised.
    #[inline(always)]
    fn factorise(&self, state: &mut VehicleState) {
        let method = &self.method;
        let weights = Weights {
            stiffness: method.stiffness_weight(),
            damping: method.damping_weight(),
        };
        let system = &mut state.work.system;
        system.clone_from(&self.system);
        for (constants, forces) in self.wheelsets.iter().zip(&state.contacts) {
            let block = &mut system.diagonal[constants.body];
            add_contact(block, forces, self.surface, state.speed_m_per_s, weights);
        }
        state.is_diverged |= !self.structure.factorise(system);
    }

    /// One Newton correction with the forces at the predicted place.
    #[inline(always)]
    fn correct(&self, state: &mut VehicleState, forces: &mut [Vector]) {
        let method = &self.method;
        for (body, residual) in forces.iter_mut().enumerate() {
            for i in 0..N {
                let inertia = self.inertia[body][i];
                let (a, last) = (
                    state.accelerations[body][i],
                    state.last_accelerations[body][i],
                );
                residual[i] = method.new_force * residual[i]
                    + method.old_force * state.forces[body][i]
                    - inertia * (a + method.old_inertia * last);
            }
        }
        self.structure.solve(&state.work.system, forces);
        let mut is_bounded = true;
        for (body, change) in forces.iter().enumerate() {
            for i in 0..N {
                let a = state.accelerations[body][i] + change[i];
                let last = state.last_accelerations[body][i];
                state.accelerations[body][i] = a;
                state.velocities[body][i] += method.to_velocity * change[i];
                let q = state.coordinates[body][i] + method.to_displacement * change[i];
                state.coordinates[body][i] = q;
                // The force that the method has at the end of the step.
                let inertia_force = self.inertia[body][i] * (a + method.old_inertia * last);
                let force = &mut state.forces[body][i];
                *force = (inertia_force - method.old_force * *force) / method.new_force;
                is_bounded &= q.abs() < DIVERGED && a.abs() < DIVERGED_RATE;
            }
        }
        for constants in &self.wheelsets {
            state.coordinates[constants.body][3] = 0.0;
        }
        state.is_diverged |= !is_bounded;
    }

    /// Adds what acts on the bodies where they are: springs and dashpots, weight and track, rails.
    #[inline(always)]
    fn act(&self, state: &mut VehicleState, track: &Track, distance_m: f64, forces: &mut [Vector]) {
        let work = &mut state.work;
        for body in 0..self.names.len() {
            let guidance = &work.guidance[body];
            for i in 0..N {
                work.in_middle[body][i] = state.coordinates[body][i] + guidance.relative[i];
                work.rates_in_middle[body][i] =
                    state.velocities[body][i] - guidance.pose_rate[i] + guidance.relative_rate[i];
                forces[body][i] += self.inertia[body][i] * guidance.acceleration[i];
            }
        }
        self.structure
            .subtract_product(&self.stiffness, &work.in_middle, forces);
        self.structure
            .subtract_product(&self.damping, &work.rates_in_middle, forces);
        for (body, stiffness, damping) in &self.on_track {
            let guidance = &work.guidance[*body];
            for i in 0..N {
                for j in 0..N {
                    forces[*body][i] += stiffness[i][j] * guidance.relative[j]
                        + damping[i][j] * guidance.relative_rate[j];
                }
            }
        }
        for (number, constants) in self.wheelsets.iter().enumerate() {
            self.act_on_wheelset(state, track, distance_m, number, constants, forces);
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
            body,
            carried,
            axle_load_n,
            spin_inertia_kg_m2,
        } = *constants;
        let speed = state.speed_m_per_s;
        let guidance = &state.work.guidance[body];
        let [lateral, vertical, roll, _, yaw] = state.coordinates[body];
        let v = state.velocities[body];
        let free = carried.motion(speed);
        let motion = Motion {
            lateral_m: lateral,
            vertical_m: carried.vertical_m + vertical,
            roll_rad: roll,
            yaw_rad: yaw,
            lateral_velocity_m_per_s: v[0] - guidance.pose_rate[0],
            vertical_velocity_m_per_s: v[1],
            roll_rate_rad_per_s: v[2] - guidance.pose_rate[2],
            rotation_rad_per_s: free.rotation_rad_per_s - v[3],
            yaw_rate_rad_per_s: v[4],
            ..free
        };
        let rails = track.rails(distance_m + self.stands[body].x_m);
        let rails = rails.map(|rail| rail.displacement(speed));
        let contact = &mut state.contacts[number];
        self.contact.update(&motion, &rails, contact);
        let [_, fy, fz] = contact.force_n;
        let [mx, my, mz] = contact.moment_n_m;
        let turned = guidance.relative[2];
        let momentum = spin_inertia_kg_m2 * free.rotation_rad_per_s;
        let sums = &mut forces[body];
        sums[0] += fy - turned * fz;
        sums[1] += fz + turned * fy + axle_load_n;
        sums[2] += mx - momentum * v[4];
        // About the axle, which is turned and rolled.
        sums[3] += my - yaw * mx + roll * mz;
        sums[4] += mz + momentum * v[2];
    }
}
