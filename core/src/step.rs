//! The step of one damper or of several side by side.
//!
//! With the stretch `u = x - x_r` of clearance and springs, the chain
//! `x = g + delta(F) + x_r`, `dx_r/dt = v_h(F)` is one equation, `du/dt = dx/dt - f(u)`, with
//! `f = v_h(F(u))` zero in the clearance and rising beyond. A step takes two implicit stages
//! (Alexander's SDIRK2, gamma = 1 - 1/sqrt 2: second order, L-stable, last stage at the tick) and then
//! corrects the flow by the difference between its exact mean along the step's straight path and the
//! stages' quadrature of that path. The correction vanishes for linear f, so stability and order are
//! those of the stages; where f has a root (orifice) or a corner (clearance edge) inside the step it
//! takes away their leading error. See docs/numerics.md.

use crate::damper::Damper;
use crate::math::{Lanes, Real};
use crate::parameters::LARGEST_FORCE_N;
use crate::scalars::Scalars;
use crate::state::DamperState;
use crate::status::Status;
use crate::table::{Piece, Table, cubic, locate};

/// gamma of both stages: the implicit part of each.
pub(crate) const GAMMA: f64 = 1.0 - core::f64::consts::FRAC_1_SQRT_2;

/// Largest correction over the change of the stretch in the step, so that it never undoes the damping.
const LARGEST_CORRECTION: f64 = 0.125;

impl<T: Real> Damper<T> {
    /// Force (N) at this tick for the displacement (m) of the tick; positive when it resists
    /// extension. The displacement is taken as linear since the last tick: no added delay.
    ///
    /// Never fails: bad input is held or limited and latched in the state's status. The force is
    /// finite and at most [`Damper::force_limit_n`] in magnitude, whatever bits the damper and the state
    /// have.
    ///
    /// A state that another damper stepped before is carried over first, its force kept.
    #[inline]
    pub fn step(&self, state: &mut DamperState<T>, displacement: T) -> T {
        let [force] = step::<T, T, 1>([self], core::array::from_mut(state), [displacement]);
        force
    }

    /// Carries a state over from another damper: displacement and force stay, the stretch becomes
    /// the one this damper has under that force; without force it stays within the clearance.
    ///
    /// [`Damper::step`] does this by itself when it meets a state of another damper; call it between
    /// ticks to keep that tick at its usual cost. Fixed work: 26 stages in `f32`, 55 in `f64`.
    pub fn adopt(&self, state: &mut DamperState<T>) {
        let a = self.scalars.half_clearance;
        let limit = self.force_limit_n();
        let force = state.force.max(-limit).min(limit);
        (state.stretch, state.potential) = if force == T::ZERO {
            (state.stretch.max(-a).min(a), T::ZERO)
        } else {
            state_at_force(self, force)
        };
        if state.revision != 0 {
            state.latch(Status::DAMPER_SWAPPED);
        }
        state.revision = self.revision;
    }
}

/// Steps `L` dampers; returns their forces (N).
#[inline(always)]
pub(crate) fn step<T: Real, V: Lanes<T, L>, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    displacements: [T; L],
) -> [T; L] {
    let (travel, rest_rounder) = enter::<T, V, L>(dampers, states, V::new(displacements));
    let [_, start, potential, _] = V::transpose(states.each_ref().map(DamperState::numbers));

    let stages = Stages::new(dampers);
    let gamma = V::splat(GAMMA);
    let first = stages.solve(start + gamma * travel);
    let last = stages.solve(start + travel - V::splat(1.0 - GAMMA) * first.flow);
    let bend = gamma * (last.flow - first.flow);
    let quadrature = first.flow + bend;
    let change = travel - quadrature;
    let end = start + change;

    // The flow's mean over the straight path, by its potential and, off the path, by its slope.
    let end_potential = last.potential();
    let area = end_potential - potential + bend * bend;
    let most = (change * V::splat(LARGEST_CORRECTION)).abs();
    let correction = (area / change - quadrature).min(most).max(-most);
    let contact = last.flow * start * potential;
    let correction = correction.unless_positive(contact);

    let stretch = ((end + rest_rounder) - correction) - rest_rounder;
    let potential = end_potential - last.flow * correction;
    let magnitude = stages.force(stretch, last.stiffness());
    let yields = magnitude.reaches(stages.force_limit);
    // Damaged constants may make each of the two any number or NaN; the force is finite all the same.
    let limited = magnitude.min(stages.force_limit).max(V::splat(0.0));
    let limited = limited.min(V::splat(LARGEST_FORCE_N));
    let forces = limited.with_sign_of(stretch).array();
    let (stretches, potentials) = (stretch.array(), potential.array());
    for (lane, state) in states.iter_mut().enumerate() {
        state.stretch = stretches[lane];
        state.potential = potentials[lane];
        state.force = forces[lane];
        state.latch(Status::SATURATED.only_if(yields[lane]));
    }
    forces
}

/// Takes the displacements (m) in; returns the travels (m) and the numbers that round a rest to zero (m).
#[inline(always)]
fn enter<T: Real, V: Lanes<T, L>, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    displacement: V,
) -> (V, V) {
    let number = |of: fn(&Scalars<T>) -> T| V::new(dampers.map(|damper| of(&damper.scalars)));
    let last = |states: &[DamperState<T>; L]| V::new(states.each_ref().map(|s| s.displacement));
    let mut travel = displacement - last(states);
    let known = dampers
        .iter()
        .zip(&*states)
        .all(|(damper, state)| damper.revision == state.revision);
    if !(known && travel.abs().all_at_most(number(|k| k.largest_move))) {
        let mut travels = displacement.array();
        for ((damper, state), travel) in dampers.iter().zip(&mut *states).zip(&mut travels) {
            *travel = limit_input(damper, state, *travel);
        }
        travel = V::new(travels);
    }
    // Read only now: numbers that live across the call above would be saved on the stack at every step.
    let position_rounder = number(|k| k.position_rounder);
    let travel = (travel + position_rounder) - position_rounder;
    let displacements = (last(states) + travel).array();
    for (state, displacement) in states.iter_mut().zip(displacements) {
        state.displacement = displacement;
    }
    (travel, number(|k| k.rest_rounder))
}

/// The travel (m) to a displacement (m): a state that no damper made starts over, one that another damper
/// stepped is adopted, a travel that is not credible limited; each latched, the last counted.
#[cold]
#[inline(never)]
fn limit_input<T: Real>(damper: &Damper<T>, state: &mut DamperState<T>, displacement: T) -> T {
    if !state.is_marked() || !state.displacement.is_finite() {
        *state = damper.at_rest(displacement);
        state.latch(Status::CORRUPTED);
    }
    if state.revision != damper.revision {
        damper.adopt(state);
    }
    let travel = displacement - state.displacement;
    let largest_move = damper.scalars.largest_move;
    if travel.abs() <= largest_move {
        return travel;
    }
    state.rejected_inputs = state.rejected_inputs.saturating_add(1);
    if travel.is_finite() {
        state.latch(Status::INPUT_LIMITED);
        let limited = travel.max(-largest_move).min(largest_move);
        // What the displacement can move by: far out, less than the limit.
        (state.displacement + limited) - state.displacement
    } else {
        state.latch(Status::INPUT_HELD);
        T::ZERO
    }
}

/// The constants of implicit stages.
struct Stages<'a, T, V, const L: usize> {
    tables: [&'a Table<T>; L],
    offset: V,
    first_knot: V,
    half_clearance: V,
    force_limit: V,
}

/// A solved stage.
struct Stage<'a, T, V, const L: usize> {
    /// Flow times the step (m).
    flow: V,
    pieces: [&'a Piece<T>; L],
    z: V,
}

impl<'a, T: Real, V: Lanes<T, L>, const L: usize> Stages<'a, T, V, L> {
    #[inline(always)]
    fn new(dampers: [&'a Damper<T>; L]) -> Self {
        let [offset, first_knot, half_clearance, half_limit] =
            V::transpose(dampers.map(|damper| {
                let k = &damper.scalars;
                [k.offset, k.first_knot, k.half_clearance, k.half_force_limit]
            }));
        Self {
            tables: dampers.map(|damper| &damper.table),
            offset,
            first_knot,
            half_clearance,
            force_limit: half_limit + half_limit,
        }
    }

    /// The stage whose stretch and flow sum to `reach` (m).
    #[inline(always)]
    fn solve(&self, reach: V) -> Stage<'a, T, V, L> {
        // Comparing with a constant takes one instruction by every compiler, with a variable it may take eight.
        let beyond = (reach.abs() - self.offset).max(V::splat(0.0));
        let (pieces, z) = locate(self.tables, beyond + self.first_knot, reach);
        let flow = cubic(pieces.map(|piece| piece.flow), z);
        Stage { flow, pieces, z }
    }

    /// Force magnitude (N) at a stretch (m), by the stiffness of the stage that ended there; it may exceed
    /// the limit.
    #[inline(always)]
    fn force(&self, stretch: V, stiffness: V) -> V {
        let beyond = (stretch.abs() - self.half_clearance).max(V::splat(0.0));
        beyond * stiffness
    }
}

impl<T: Real, V: Lanes<T, L>, const L: usize> Stage<'_, T, V, L> {
    /// Flow potential times the step (m^2).
    #[inline(always)]
    fn potential(&self) -> V {
        cubic(self.pieces.map(|piece| piece.potential), self.z)
    }

    /// Force over stretch beyond the clearance (N/m).
    #[inline(always)]
    fn stiffness(&self) -> V {
        cubic(self.pieces.map(|piece| piece.stiffness), self.z)
    }
}

/// The stretch (m) and flow potential (m^2) at which `damper` has a force (N), by bisection of its stages.
pub(crate) fn state_at_force<T: Real>(damper: &Damper<T>, force: T) -> (T, T) {
    let stages: Stages<'_, T, T, 1> = Stages::new([damper]);
    let signed = |value: T| if force < T::ZERO { -value } else { value };
    let mut low = damper.scalars.half_clearance;
    let mut high = damper.largest_reach();
    let mut found = (T::ZERO, T::ZERO);
    for _ in 0..T::MANTISSA_DIGITS + 2 {
        let middle = T::from_f64(0.5) * (low + high);
        let reach = signed(middle);
        let stage = stages.solve(reach);
        let stretch = reach - T::from_f64(GAMMA) * stage.flow;
        let reached = stages.force(stretch, stage.stiffness());
        found = (stretch, stage.potential());
        if reached < force.abs() {
            low = middle;
        } else {
            high = middle;
        }
    }
    found
}
