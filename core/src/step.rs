//! The step of one damper or of several side by side. The method is described in `damper`.

use crate::damper::{Damper, IMPLICIT_SHARE};
use crate::math::{Lanes, Real};
use crate::state::DamperState;
use crate::status::Status;
use crate::table::{Piece, Table, cubic, locate};

/// The correction is at most this share of the step's travel, so it never undoes the damping.
const CORRECTION_SHARE: f64 = 0.125;

/// Added to a change of stretch to keep its inverse finite at a standstill (m); lost in any other.
const STANDSTILL: f64 = 1e-30;

/// Steps `L` dampers; returns their forces (N).
#[inline(always)]
pub(crate) fn step<T: Real, V: Lanes<T, L>, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    displacements: [T; L],
) -> [T; L] {
    let (travel, rest_rounder) = enter::<T, V, L>(dampers, states, V::new(displacements));
    let [_, start, potential, _] = V::columns(states.each_ref().map(DamperState::numbers));

    let stages = Stages::new(dampers);
    let gamma = V::all(IMPLICIT_SHARE);
    let first = stages.solve(start + gamma * travel);
    let last = stages.solve(start + travel - V::all(1.0 - IMPLICIT_SHARE) * first.flow);
    let bend = gamma * (last.flow - first.flow);
    let quadrature = first.flow + bend;
    let change = travel - quadrature;
    let end = start + change;

    // The flow's mean over the straight path, by its potential and, off the path, by its slope.
    let inverse = V::all(1.0) / (change + V::all(STANDSTILL));
    let end_potential = last.potential();
    let area = end_potential - potential + bend * bend;
    let share = ((area * inverse - quadrature) * inverse)
        .at_least(V::all(-CORRECTION_SHARE))
        .at_most(V::all(CORRECTION_SHARE));
    // In contact on the same side at both ends there is nothing to correct but rounding.
    let contact = last.flow * start * potential;
    let correction = (share * change).unless_positive(contact);

    let stretch = ((end + rest_rounder) - correction) - rest_rounder;
    let potential = end_potential - last.flow * correction;
    leave(dampers, states, stretch, potential, last.stiffness())
}

/// Takes the displacements (m) in; returns the travels (m) and the numbers that round a rest to zero (m).
#[inline(always)]
fn enter<T: Real, V: Lanes<T, L>, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    displacement: V,
) -> (V, V) {
    let [largest_move, position_rounder, rest_rounder, _] = V::columns(dampers.map(|damper| {
        let k = &damper.scalars;
        [k.largest_move, k.position_rounder, k.rest_rounder, k.step_s]
    }));
    let [last, ..] = V::columns(states.each_ref().map(DamperState::numbers));
    let mut travel = displacement - last;
    let known = dampers
        .iter()
        .zip(&*states)
        .all(|(damper, state)| damper.revision == state.revision);
    if !(known && travel.magnitudes().all_within(largest_move)) {
        let mut travels = travel.array();
        for ((damper, state), travel) in dampers.iter().zip(&mut *states).zip(&mut travels) {
            *travel = admit(damper, state, *travel);
        }
        travel = V::new(travels);
    }
    let travel = (travel + position_rounder) - position_rounder;
    for (state, displacement) in states.iter_mut().zip((last + travel).array()) {
        state.displacement = displacement;
    }
    (travel, rest_rounder)
}

/// The travel (m) to use for the one asked for: a state that another damper stepped is adopted, a travel
/// that is not credible limited; both latched, the latter counted.
#[cold]
#[inline(never)]
fn admit<T: Real>(damper: &Damper<T>, state: &mut DamperState<T>, travel: T) -> T {
    if state.revision != damper.revision {
        damper.adopt(state);
    }
    let largest_move = damper.scalars.largest_move;
    if travel.magnitude() <= largest_move {
        return travel;
    }
    state.rejected_inputs = state.rejected_inputs.saturating_add(1);
    if travel.is_finite() {
        state.status.insert(Status::INPUT_LIMITED);
        let limited = travel.larger(-largest_move).smaller(largest_move);
        // What the displacement can move by: far out, less than the limit.
        (state.displacement + limited) - state.displacement
    } else {
        state.status.insert(Status::INPUT_HELD);
        T::ZERO
    }
}

/// The constants of implicit stages.
struct Stages<'a, T, V, const L: usize> {
    tables: [&'a Table<T>; L],
    offset: V,
    scale: V,
    shift: V,
    origin: V,
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
        let [offset, scale, shift, origin] = V::columns(dampers.map(|damper| {
            let k = &damper.scalars;
            [k.offset, k.scale, k.shift, k.origin]
        }));
        Self {
            tables: dampers.map(|damper| &damper.table),
            offset,
            scale,
            shift,
            origin,
        }
    }

    /// The stage whose stretch and flow sum to `reach` (m).
    #[inline(always)]
    fn solve(&self, reach: V) -> Stage<'a, T, V, L> {
        let beyond = (reach.magnitudes() - self.offset).at_least(V::all(0.0));
        let y = (beyond * self.scale + self.shift).square_roots();
        let (pieces, z) = locate(self.tables, self.origin, y, reach);
        let flow = cubic(pieces.map(|piece| piece.flow), z);
        Stage { flow, pieces, z }
    }
}

impl<T: Real, V: Lanes<T, L>, const L: usize> Stage<'_, T, V, L> {
    /// Flow potential times the step (m^2).
    #[inline(always)]
    fn potential(&self) -> V {
        cubic(self.pieces.map(|piece| piece.potential), self.z)
    }

    /// Force over stretch beyond the offset, less the held stiffness (N/m).
    #[inline(always)]
    fn stiffness(&self) -> V {
        cubic(self.pieces.map(|piece| piece.stiffness), self.z)
    }
}

/// Force magnitude (N) at a stretch (m), by the stiffness of the stage that ended there, and the limit
/// (N) that it may exceed.
#[inline(always)]
fn force<T: Real, V: Lanes<T, L>, const L: usize>(
    dampers: [&Damper<T>; L],
    stretch: V,
    stiffness: V,
) -> (V, V) {
    let [half_clearance, held_stiffness, limit, _] = V::columns(dampers.map(|damper| {
        let k = &damper.scalars;
        [k.half_clearance, k.held_stiffness, k.force_limit, k.held]
    }));
    let offset = V::new(dampers.map(|damper| damper.scalars.offset));
    let magnitude = stretch.magnitudes();
    let sprung = (magnitude - half_clearance).at_least(V::all(0.0));
    let beyond = (magnitude - offset).at_least(V::all(0.0));
    (sprung * held_stiffness + beyond * stiffness, limit)
}

/// Stores what the step found; returns the forces (N).
#[inline(always)]
fn leave<T: Real, V: Lanes<T, L>, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    stretch: V,
    potential: V,
    stiffness: V,
) -> [T; L] {
    let (magnitude, limit) = force(dampers, stretch, stiffness);
    let (limited, yields) = magnitude.limited(limit);
    let forces = limited.along(stretch).array();
    let (stretches, potentials) = (stretch.array(), potential.array());
    for (lane, state) in states.iter_mut().enumerate() {
        state.stretch = stretches[lane];
        state.potential = potentials[lane];
        state.force = forces[lane];
        state.status.insert_if(yields[lane], Status::SATURATED);
    }
    forces
}

/// The stretch (m) and flow potential (m^2) at which `damper` has a force (N), by bisection of its stages.
pub(crate) fn settle<T: Real>(damper: &Damper<T>, force: T) -> (T, T) {
    let stages: Stages<'_, T, T, 1> = Stages::new([damper]);
    let signed = |value: T| if force < T::ZERO { -value } else { value };
    let mut low = damper.scalars.half_clearance;
    let mut high = damper.largest_reach();
    let mut found = (T::ZERO, T::ZERO);
    for _ in 0..T::DIGITS + 2 {
        let middle = T::from_f64(0.5) * (low + high);
        let reach = signed(middle);
        let stage = stages.solve(reach);
        let stretch = reach - T::from_f64(IMPLICIT_SHARE) * stage.flow;
        let (reached, _) = self::force([damper], stretch, stage.stiffness());
        found = (stretch, stage.potential());
        if reached < force.magnitude() {
            low = middle;
        } else {
            high = middle;
        }
    }
    found
}
