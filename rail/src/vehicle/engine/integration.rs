//! One step: the linearly implicit generalised-alpha method.

use std::array::from_fn;

use fearless_simd::Simd;

use super::Vehicle;
use super::block::Vector;
use super::elementwise::{Formula, are_below, for_all};
use super::method::Method;
use super::state::{VehicleState, Work};
use super::tangent::{Weights, add_contact};
use crate::contact::PatchSource;
use crate::creep::CreepLaw;
use crate::math::number::Number;
use crate::track::Track;

/// A larger displacement or rotation counts as divergence, m or rad.
pub(super) const MAX_DISPLACEMENT: f64 = 10.0;

/// A larger acceleration counts as divergence, m/s^2 or rad/s^2.
const MAX_ACCELERATION: f64 = 1e6;

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// Computes coordinates and velocities at the end of a step with the predicted accelerations.
    #[inline(always)]
    pub(super) fn predict(&self, state: &mut VehicleState, track: &Track, distance_m: f64) {
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
    pub(super) fn factorise<V: Simd>(&self, simd: V, state: &mut VehicleState) {
        let method = &self.method;
        let weights = Weights {
            stiffness: method.stiffness_weight(),
            damping: method.damping_weight(),
        };
        let Work { system, rails, .. } = &mut state.work;
        system.set(&self.system);
        rails.copy_from_slice(&self.rails);
        let mut is_positive = true;
        for (number, (constants, forces)) in self.wheelsets.iter().zip(&state.contacts).enumerate()
        {
            let wheelset = &mut system.diagonal[constants.bodies.wheelset];
            let (surface, speed) = (constants.surface, state.speed_m_per_s);
            let mut rails = rails.get_mut(number);
            let under = rails.as_deref_mut();
            add_contact(simd, wheelset, under, forces, surface, speed, weights);
            if let Some(rails) = rails {
                is_positive &= rails.eliminate(simd, wheelset);
            }
        }
        is_positive &= self.structure.factorise(simd, system);
        state.is_diverged |= !is_positive;
    }

    /// Applies one Newton correction with the forces at the predicted positions.
    #[inline(always)]
    pub(super) fn correct<V: Simd>(
        &self,
        simd: V,
        state: &mut VehicleState,
        forces: &mut [Vector],
    ) {
        let method = &self.method;
        let VehicleState {
            coordinates,
            velocities,
            accelerations,
            last_accelerations,
            forces: sums,
            ..
        } = state;
        let operands = [&accelerations[..], last_accelerations, sums, &self.inertia];
        for_all(simd, &Residual(method), operands, [&mut *forces]);
        self.solve(simd, &state.work, forces);
        let correction = Correction {
            method,
            to_force: 1.0 / method.new_force,
        };
        let operands = [&*forces, last_accelerations, &self.inertia];
        let corrected = [&mut coordinates[..], velocities, accelerations, sums];
        for_all(simd, &correction, operands, corrected);
        // Not short-circuited, so that there are no branches.
        let is_bounded = are_below(simd, coordinates, MAX_DISPLACEMENT)
            & are_below(simd, accelerations, MAX_ACCELERATION);
        for constants in &self.wheelsets {
            state.coordinates[constants.bodies.wheelset][3] = 0.0;
        }
        state.is_diverged |= !is_bounded;
    }

    /// Replaces the right-hand side of the equations by their solution.
    #[inline(always)]
    fn solve<V: Simd>(&self, simd: V, factors: &Work, vector: &mut [Vector]) {
        let bodies = self.names.len();
        let wheelsets = bodies - self.wheelsets.len()..;
        // The bodies end with the wheelsets; the rails follow in the same order.
        let (vector, rails) = vector.split_at_mut(bodies);
        let under = factors.rails.iter().zip(rails.iter_mut());
        for ((equations, rails), wheelset) in under.zip(&mut vector[wheelsets.clone()]) {
            equations.solve_rails(simd, rails, wheelset);
        }
        self.structure.solve(simd, &factors.system, vector);
        let under = factors.rails.iter().zip(rails);
        for ((equations, rails), wheelset) in under.zip(&vector[wheelsets]) {
            equations.follow_wheelset(simd, rails, wheelset);
        }
    }
}

/// Right-hand side of the equations, from the forces at the predicted positions.
struct Residual<'a>(&'a Method);

impl Formula<4, 1> for Residual<'_> {
    #[inline(always)]
    fn at<T: Number>(&self, [a, last, old, inertia]: [T; 4], [force]: [T; 1]) -> [T; 1] {
        let method = self.0;
        let forces = force * method.new_force + old * method.old_force;
        [forces - inertia * (a + last * method.old_inertia)]
    }
}

/// Coordinate, velocity, acceleration and force at the end of a step, from the change of the predicted acceleration.
struct Correction<'a> {
    method: &'a Method,
    to_force: f64,
}

impl Formula<3, 4> for Correction<'_> {
    #[inline(always)]
    fn at<T: Number>(&self, [change, last, inertia]: [T; 3], [q, v, a, old]: [T; 4]) -> [T; 4] {
        let Self { method, to_force } = self;
        let a = a + change;
        // Force at the end of the step according to the method.
        let force = inertia * (a + last * method.old_inertia) - old * method.old_force;
        [
            q + change * method.to_displacement,
            v + change * method.to_velocity,
            a,
            force * *to_force,
        ]
    }
}
