//! The step of one damper or of several side by side. The method is described in `damper`.

use crate::damper::{Damper, IMPLICIT_SHARE, Scalars};
use crate::math::{Lanes, Real};
use crate::state::DamperState;
use crate::status::Status;
use crate::table::{PIECES, Piece, Table, cubic, locate};

/// The correction is at most this share of the step's travel, so it never undoes the damping.
const CORRECTION_SHARE: f64 = 0.125;

/// Added to a change of stretch to keep its inverse finite at a standstill (m); lost in any other.
const STANDSTILL: f64 = 1e-30;

/// Steps `L` dampers; returns their forces (N).
#[inline(always)]
pub(crate) fn step<T: Real, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    displacements: [T; L],
) -> [T; L] {
    let travel = enter(dampers, states, displacements);
    let start = Lanes(states.each_ref().map(|state| state.stretch));
    let potential = Lanes(states.each_ref().map(|state| state.potential));
    let gamma = Lanes::all(IMPLICIT_SHARE);

    let stages = Stages::new(dampers);
    let first = stages.solve(start + gamma * travel);
    let last = stages.solve(start + travel - Lanes::all(1.0 - IMPLICIT_SHARE) * first.flow);

    // The flow's mean over the straight path, by its potential and, off the path, by its slope.
    let change = last.stretch - start;
    let inverse = Lanes::all(1.0) / (change + Lanes::all(STANDSTILL));
    let off_path = first.stretch - start - gamma * change;
    let difference = last.flow - first.flow;
    let end_potential = last.potential();
    let area = end_potential - potential + difference * off_path;
    let quadrature = first.flow + gamma * difference;
    let share = ((area * inverse - quadrature) * inverse)
        .at_least(-CORRECTION_SHARE)
        .at_most(CORRECTION_SHARE);
    // In contact on the same side at both ends there is nothing to correct but rounding.
    let contact = last.flow * start * potential;
    let correctable = change.zip(
        contact,
        |change, contact| {
            if contact > T::ZERO { T::ZERO } else { change }
        },
    );
    let correction = share * correctable;

    let rest = Lanes([T::REST_ROUNDER; L]);
    let stretch = ((last.stretch + rest) - correction) - rest;
    let potential = end_potential - last.flow * correction;
    let force = force(dampers, stretch, last.stiffness());
    leave(dampers, states, stretch, potential, force)
}

/// A number of each damper.
#[inline(always)]
fn of<T: Real, const L: usize>(
    dampers: [&Damper<T>; L],
    number: impl Fn(&Scalars<T>) -> T,
) -> Lanes<T, L> {
    Lanes(dampers.map(|damper| number(&damper.scalars)))
}

/// Takes the displacements in; returns the travels (m).
#[inline(always)]
#[allow(clippy::neg_cmp_op_on_partial_ord)] // so that NaN is noticed too
fn enter<T: Real, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    displacements: [T; L],
) -> Lanes<T, L> {
    let largest_move = of(dampers, |k| k.largest_move);
    let last = Lanes(states.each_ref().map(|state| state.displacement));
    let mut travel = Lanes(displacements) - last;
    let mut usual = true;
    for ((damper, state), (travel, largest_move)) in dampers
        .iter()
        .zip(&*states)
        .zip(travel.0.iter().zip(largest_move.0))
    {
        usual &= state.revision == damper.revision && travel.magnitude() <= largest_move;
    }
    if !usual {
        for ((damper, state), travel) in dampers.iter().zip(&mut *states).zip(&mut travel.0) {
            *travel = admit(damper, state, *travel);
        }
    }
    let rounder = Lanes([T::POSITION_ROUNDER; L]);
    let travel = (travel + rounder) - rounder;
    for (state, displacement) in states.iter_mut().zip((last + travel).0) {
        state.displacement = displacement;
    }
    travel
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
        travel.larger(-largest_move).smaller(largest_move)
    } else {
        state.status.insert(Status::INPUT_HELD);
        T::ZERO
    }
}

/// The constants of implicit stages.
struct Stages<'a, T, const L: usize> {
    tables: [&'a Table<T>; L],
    /// Stretch up to which nothing flows (m).
    offset: Lanes<T, L>,
    scale: Lanes<T, L>,
    shift: Lanes<T, L>,
    shift_root: Lanes<T, L>,
}

/// A solved stage.
struct Stage<'a, T, const L: usize> {
    /// (m).
    stretch: Lanes<T, L>,
    /// Flow times the step (m).
    flow: Lanes<T, L>,
    pieces: [&'a Piece<T>; L],
    z: Lanes<T, L>,
}

impl<'a, T: Real, const L: usize> Stages<'a, T, L> {
    #[inline(always)]
    fn new(dampers: [&'a Damper<T>; L]) -> Self {
        Self {
            tables: dampers.map(|damper| &damper.table),
            offset: of(dampers, |k| k.offset),
            scale: of(dampers, |k| k.scale),
            shift: of(dampers, |k| k.shift),
            shift_root: of(dampers, |k| k.shift_root),
        }
    }

    /// The stage whose stretch and flow sum to `reach`.
    #[inline(always)]
    fn solve(&self, reach: Lanes<T, L>) -> Stage<'a, T, L> {
        let beyond = (reach.magnitude() - self.offset).at_least(0.0);
        let y = (beyond * self.scale + self.shift).square_root() - self.shift_root;
        let (pieces, z) = locate(self.tables, y, reach);
        let flow = cubic(pieces.map(|piece| &piece.flow), z);
        Stage {
            stretch: reach - Lanes::all(IMPLICIT_SHARE) * flow,
            flow,
            pieces,
            z,
        }
    }
}

impl<T: Real, const L: usize> Stage<'_, T, L> {
    /// Flow potential times the step (m^2).
    #[inline(always)]
    fn potential(&self) -> Lanes<T, L> {
        cubic(self.pieces.map(|piece| &piece.potential), self.z)
    }

    /// Force over stretch beyond the offset, less the held stiffness (N/m).
    #[inline(always)]
    fn stiffness(&self) -> Lanes<T, L> {
        cubic(self.pieces.map(|piece| &piece.stiffness), self.z)
    }
}

/// Force magnitude (N) at a stretch (m), by the stiffness of the stage that ended there; not yet limited.
#[inline(always)]
fn force<T: Real, const L: usize>(
    dampers: [&Damper<T>; L],
    stretch: Lanes<T, L>,
    stiffness: Lanes<T, L>,
) -> Lanes<T, L> {
    let magnitude = stretch.magnitude();
    let sprung = (magnitude - of(dampers, |k| k.half_clearance)).at_least(0.0);
    let beyond = (magnitude - of(dampers, |k| k.offset)).at_least(0.0);
    sprung * of(dampers, |k| k.held_stiffness) + beyond * stiffness
}

/// Stores what the step found; returns the forces (N).
#[inline(always)]
fn leave<T: Real, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    stretch: Lanes<T, L>,
    potential: Lanes<T, L>,
    magnitude: Lanes<T, L>,
) -> [T; L] {
    let limit = of(dampers, |k| k.force_limit);
    let mut forces = magnitude.0;
    for lane in 0..L {
        let state = &mut states[lane];
        let yields = magnitude.0[lane] >= limit.0[lane];
        state.status.insert_if(yields, Status::SATURATED);
        let limited = if yields {
            limit.0[lane]
        } else {
            magnitude.0[lane]
        };
        let force = if stretch.0[lane] >= T::ZERO {
            limited
        } else {
            -limited
        };
        state.stretch = stretch.0[lane];
        state.potential = potential.0[lane];
        state.force = force;
        forces[lane] = force;
    }
    forces
}

/// The stretch (m) and flow potential (m^2) at which `damper` has a force (N), by bisection of its stages.
pub(crate) fn settle<T: Real>(damper: &Damper<T>, force: T) -> (T, T) {
    let stages = Stages::new([damper]);
    let k = &damper.scalars;
    let signed = |value: T| if force < T::ZERO { -value } else { value };
    let last = T::from_f64(PIECES as f64 - 1.0) + k.shift_root;
    let mut low = k.half_clearance;
    let mut high = (last * last - k.shift) / k.scale + k.offset;
    let mut stage = stages.solve(Lanes([signed(low)]));
    for _ in 0..T::DIGITS + 2 {
        let middle = T::from_f64(0.5) * (low + high);
        stage = stages.solve(Lanes([signed(middle)]));
        let [found] = self::force([damper], stage.stretch, stage.stiffness()).0;
        if found < force.magnitude() {
            low = middle;
        } else {
            high = middle;
        }
    }
    (stage.stretch.0[0], stage.potential().0[0])
}
