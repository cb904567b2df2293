//! The step of one damper, or of several in parallel.
//!
//! With the stretch `u = x - x_r` of clearance and springs, the chain `x = g + delta(F) + x_r`, `dx_r/dt = v_h(F)` is
//! the single equation `du/dt = dx/dt - f(u)`, where `f = v_h(F(u))` is zero in the clearance and increases beyond it.
//!
//! A step has two implicit stages. They are Alexander's SDIRK2 with gamma = 1 - 1/sqrt 2, which has second order, is
//! L-stable and has its last stage at the tick. The step then corrects the flow: the correction is the exact mean of
//! the flow along the straight path of the step, minus the quadrature of the stages. For linear f the correction is
//! zero, so the stages alone determine stability and order. If f has a root (orifice) or a corner (clearance edge)
//! inside the step, the correction removes the leading error. See docs/numerics.md.

use crate::damper::Damper;
use crate::math::Lanes;
use crate::parameters::MAX_FORCE_N;
use crate::real::Real;
use crate::scalars::Scalars;
use crate::stages::{GAMMA, Stages, state_at_force};
use crate::state::DamperState;
use crate::status::Status;
use crate::unusual;

/// Largest ratio of the correction to the change of the stretch in the step (1). A larger one could cancel the damping.
pub(crate) const MAX_CORRECTION: f64 = 0.125;

impl<T: Real> Damper<T> {
    /// Returns the force (N) at this tick for the displacement (m) of the tick.
    ///
    /// The displacement is positive in extension, the force when it resists extension. The displacement is interpolated
    /// linearly from the last tick to this one, which adds no delay.
    ///
    /// The step never fails: bad input is held or limited, and the status of the state latches it. The force is finite
    /// and at most [`Damper::force_limit_n`] in magnitude, even if the damper or the state is damaged.
    ///
    /// A state that another damper stepped before is adopted first and keeps its force. An impossible state (a stretch
    /// or displacement that is not finite, a stretch beyond the reach of the damper, a displacement outside its range)
    /// restarts at rest and latches [`Status::CORRUPTED`].
    #[inline]
    pub fn step(&self, state: &mut DamperState<T>, displacement: T) -> T {
        let (dampers, states) = ([self], core::array::from_mut(state));
        let travel = displacement - states[0].displacement;
        if is_usual::<T, T, 1>(dampers, states, displacement, travel) {
            let [force] = advance::<T, T, 1>(dampers, states, travel);
            force
        } else {
            self.unusual_step(state, displacement)
        }
    }

    /// Steps with an unusual input or state. It has the arguments and the result of [`Damper::step`], so a step jumps
    /// here without a stack frame of its own.
    #[cold]
    #[inline(never)]
    fn unusual_step(&self, state: &mut DamperState<T>, displacement: T) -> T {
        let travel = unusual::travel(self, state, displacement);
        let [force] = advance::<T, T, 1>([self], core::array::from_mut(state), travel);
        force
    }

    /// Takes over a state of another damper.
    ///
    /// Displacement and force remain, limited to the range of this damper. The stretch becomes the one at which this
    /// damper has the same force. Without force the stretch remains, limited to the clearance.
    ///
    /// [`Damper::step`] calls this when needed. Call it between ticks so that the next tick has its usual cost. It
    /// solves 26 stages in `f32` and 55 in `f64`, but none without force.
    pub fn adopt(&self, state: &mut DamperState<T>) {
        let a = self.scalars.half_clearance;
        let limit = self.force_limit_n();
        let end = self.largest_displacement_m();
        let force = state.force.max(-limit).min(limit);
        (state.stretch, state.potential) = if force == T::ZERO {
            (state.stretch.max(-a).min(a), T::ZERO)
        } else {
            state_at_force(self, force)
        };
        state.displacement = state.displacement.max(-end).min(end);
        state.force = force;
        if state.revision != 0 {
            state.latch(Status::DAMPER_SWAPPED);
        }
        state.revision = self.revision;
    }
}

/// Travel (m) of a damper in a group in which an input or a state is unusual, as its own step takes it.
#[cfg(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
pub(crate) fn travel<T: Real>(
    damper: &Damper<T>,
    state: &mut DamperState<T>,
    displacement: T,
) -> T {
    let travel = displacement - state.displacement;
    if is_usual::<T, T, 1>([damper], core::array::from_mut(state), displacement, travel) {
        travel
    } else {
        unusual::travel(damper, state, displacement)
    }
}

/// True if all dampers can take the usual step: each was the last damper to step its state, the state is possible, and
/// displacement and travel (m) are within their bounds. A damaged displacement in the state gives a travel out of
/// bounds.
#[inline(always)]
fn is_usual<T: Real, V: Lanes<T, L>, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &[DamperState<T>; L],
    displacement: V,
    travel: V,
) -> bool {
    let stretch = V::new(states.each_ref().map(|state| state.stretch));
    let known = dampers
        .iter()
        .zip(states)
        .all(|(damper, state)| damper.revision == state.revision);
    known
        && stretch.all_within(dampers.map(|damper| &damper.scalars.stretch_bound))
        && travel.all_within(dampers.map(|damper| &damper.scalars.move_bound))
        && displacement.all_within(dampers.map(|damper| &damper.scalars.displacement_bound))
}

/// Moves the ends of `L` dampers by the given travels (m) and returns the forces (N).
#[inline(always)]
fn advance<T: Real, V: Lanes<T, L>, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    travel: V,
) -> [T; L] {
    let scalar = |get: fn(&Scalars<T>) -> T| V::new(dampers.map(|damper| get(&damper.scalars)));
    let position_rounder = scalar(|k| k.position_rounder);
    let rest_rounder = scalar(|k| k.rest_rounder);
    let travel = (travel + position_rounder) - position_rounder;
    let [last, start, potential, _] = V::transpose(states.each_ref().map(DamperState::numbers));
    let displacements = (last + travel).array();

    let stages = Stages::new(dampers);
    let gamma = V::splat(GAMMA);
    let first = stages.solve(start + gamma * travel);
    let last = stages.solve(start + travel - V::splat(1.0 - GAMMA) * first.flow);
    let bend = gamma * (last.flow - first.flow);
    let quadrature = first.flow + bend;
    let change = travel - quadrature;
    let end = start + change;

    // The change of the potential gives the mean flow along the straight path. The square of `bend` corrects this mean,
    // because the first stage is not on the path.
    let end_potential = last.potential();
    let area = end_potential - potential + bend * bend;
    let max_correction = (change * V::splat(MAX_CORRECTION)).abs();
    let correction = (area / change - quadrature)
        .min(max_correction)
        .max(-max_correction);
    let contact = last.flow * start * potential;
    let correction = correction.unless_positive(contact);

    let stretch = ((end + rest_rounder) - correction) - rest_rounder;
    let potential = end_potential - last.flow * correction;
    let magnitude = stages.force(stretch, last.stiffness());
    let yields = magnitude.reaches(stages.force_limit);
    // Damaged constants can turn the magnitude and the limit into any number or NaN; the force must be finite even
    // then.
    let limited = magnitude.min(stages.force_limit).max(V::splat(0.0));
    let limited = limited.min(V::splat(MAX_FORCE_N));
    let forces = limited.with_sign_of(stretch).array();
    let (stretches, potentials) = (stretch.array(), potential.array());
    for (lane, state) in states.iter_mut().enumerate() {
        state.displacement = displacements[lane];
        state.stretch = stretches[lane];
        state.potential = potentials[lane];
        state.force = forces[lane];
        state.latch(Status::SATURATED.only_if(yields[lane]));
    }
    forces
}

#[cfg(test)]
#[cfg(feature = "builder")]
mod tests {
    mod correction;

    use crate::damper::Damper;
    use crate::state::DamperState;
    use crate::status::Status;

    /// A damper with a clearance of 1 mm that yields at 3600 N.
    fn damper() -> Damper<f64> {
        crate::example::reduced_vertical()
            .build(1e-3)
            .expect("a valid damper")
    }

    /// A state of another damper, adopted.
    fn adopted(displacement: f64, stretch: f64, force: f64) -> DamperState<f64> {
        let numbers = [displacement, stretch, 1e-9, force];
        let mut state = DamperState::new(numbers, 1, Status::empty(), 0);
        damper().adopt(&mut state);
        assert_eq!(state.revision(), damper().revision());
        assert_eq!(state.status(), Status::DAMPER_SWAPPED);
        state
    }

    #[test]
    fn a_state_without_force_keeps_its_stretch_within_the_clearance() {
        let stretches = [
            (0.2e-3, 0.2e-3),
            (-0.2e-3, -0.2e-3),
            (0.8e-3, 0.5e-3),
            (-0.8e-3, -0.5e-3),
        ];
        for (stretch, expected) in stretches {
            let state = adopted(0.01, stretch, 0.0);
            assert_eq!(state.numbers(), [0.01, expected, 0.0, 0.0]);
        }
    }

    #[test]
    fn an_adopted_state_is_limited_to_the_range_of_its_damper() {
        let end = damper().largest_displacement_m();
        for sign in [1.0, -1.0] {
            let state = adopted(sign * 2.0 * end, 0.0, sign * 5000.0);
            assert_eq!(state.displacement_m(), sign * end);
            assert_eq!(state.force_n(), sign * 3600.0);
            let inside = adopted(sign * 0.01, 0.0, sign * 1000.0);
            assert_eq!(inside.displacement_m(), sign * 0.01);
            assert_eq!(inside.force_n(), sign * 1000.0);
        }
    }

    #[test]
    fn a_usual_step_does_not_read_the_last_force() {
        let damper = damper();
        let mut sound = damper.at_rest(0.0);
        for tick in 1..100 {
            damper.step(&mut sound, 2e-5 * f64::from(tick));
        }
        for force in [f64::NAN, 1e30, -1000.0] {
            let (mut right, mut wrong) = (sound, sound);
            wrong.force = force;
            assert!(damper.step(&mut right, 2e-3) > 1000.0);
            damper.step(&mut wrong, 2e-3);
            assert_eq!(wrong, right);
        }
    }

    #[test]
    fn only_a_step_that_reaches_the_yield_force_latches_it() {
        let damper = damper();
        let mut state = damper.at_rest(0.0);
        for tick in 1..=100 {
            assert!(damper.step(&mut state, 28e-6 * f64::from(tick)) < 3600.0);
        }
        assert_eq!(state.status(), Status::empty());
        for tick in 1..=100 {
            damper.step(&mut state, 2.8e-3 + 32e-6 * f64::from(tick));
        }
        assert_eq!(state.force_n(), 3600.0);
        assert_eq!(state.status(), Status::SATURATED);
    }

    /// Each displacement is a multiple of the grid of positions, so the stretch is exactly the displacement.
    #[test]
    fn a_piston_at_rest_in_its_clearance_does_not_drift() {
        let damper: Damper<f32> = crate::example::reduced_vertical()
            .build(1e-3)
            .expect("a valid damper");
        let mut state = damper.at_rest(0.0);
        for round in 0..100 {
            for displacement in [0.25, 0.375, -0.25, -0.375].map(|part| part * 2e-3 / 2.048) {
                assert_eq!(damper.step(&mut state, displacement), 0.0);
                assert_eq!(state.piston_displacement_m(), 0.0, "round {round}");
            }
        }
    }
}
