//! The step of one damper or of several side by side. The method is described in `damper`.

use crate::damper::{Damper, IMPLICIT_SHARE, Scalars};
use crate::math::{Lanes, Real};
use crate::state::DamperState;
use crate::status::Status;
use crate::table::{PIECES, Piece, Table, cubic, locate};

/// Weight of the first stage's flow over that of the last, (1 - gamma)/gamma.
const EXPLICIT_RATIO: f64 = (1.0 - IMPLICIT_SHARE) / IMPLICIT_SHARE;

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
    let gamma = Lanes::all(IMPLICIT_SHARE);
    let explicit_ratio = Lanes::all(EXPLICIT_RATIO);
    let half_clearance = of(dampers, |k| k.half_clearance);

    let stages = Stages::new(dampers);
    let first = stages.solve(start + gamma * travel);
    let last = stages.solve(start + travel - explicit_ratio * first.flow);

    // The flow's mean over the straight path, by its potential and, off the path, by its slope.
    let change = last.stretch - start;
    let inverse = Lanes::all(1.0) / (change + Lanes::all(STANDSTILL));
    let off_path = first.stretch - start - gamma * change;
    let slope = (last.flow - first.flow) * Lanes::all(1.0 / IMPLICIT_SHARE);
    let potential = Lanes(states.each_ref().map(|state| state.potential));
    let end_potential = last.potential();
    let mean = (end_potential - potential + slope * off_path) * inverse;

    // In contact on the same side all through there is nothing to correct but rounding; an element
    // that yields follows the input.
    let excess = first.stretch.magnitude().larger(last.stretch.magnitude())
        - (half_clearance + of(dampers, |k| k.yield_stretch));
    for (state, excess) in states.iter_mut().zip(excess.0) {
        state.status.insert_if(excess >= T::ZERO, Status::SATURATED);
    }
    let touched = start.magnitude().smaller(last.stretch.magnitude()) - stages.offset;
    let side =
        (start * last.stretch).zip(
            touched,
            |product, touched| {
                if touched > T::ZERO { product } else { T::ZERO }
            },
        );
    let most = (change.magnitude() * Lanes::all(CORRECTION_SHARE))
        .zip(
            side,
            |most, side| if side > T::ZERO { T::ZERO } else { most },
        )
        .zip(
            excess,
            |most, excess| {
                if excess >= T::ZERO { T::ZERO } else { most }
            },
        );
    let correction = (mean - (explicit_ratio * first.flow + last.flow))
        .larger(-most)
        .smaller(most);
    let rest = Lanes([T::REST_ROUNDER; L]);
    let stretch = ((last.stretch + rest) - correction) - rest;
    let outflow = last.flow * Lanes::all(1.0 / IMPLICIT_SHARE);
    let potential = end_potential - outflow * correction;

    leave(dampers, states, stretch, potential, half_clearance)
}

/// A number of each damper.
#[inline(always)]
fn of<T: Real, const L: usize>(
    dampers: [&Damper<T>; L],
    number: impl Fn(&Scalars<T>) -> T,
) -> Lanes<T, L> {
    Lanes(dampers.map(|damper| number(&damper.scalars)))
}

/// Takes the displacements in: adopts states that another damper stepped, limits the travel, which it
/// returns (m).
#[inline(always)]
#[allow(clippy::neg_cmp_op_on_partial_ord)] // so that NaN is rejected too
fn enter<T: Real, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    displacements: [T; L],
) -> Lanes<T, L> {
    let mut travels = displacements;
    for ((damper, state), travel) in dampers.iter().zip(states).zip(&mut travels) {
        if state.revision != damper.revision {
            damper.adopt(state);
        }
        let largest_move = damper.scalars.largest_move;
        let mut asked = *travel - state.displacement;
        if !(asked.magnitude() <= largest_move) {
            asked = reject(state, asked, largest_move);
        }
        *travel = (asked + T::POSITION_ROUNDER) - T::POSITION_ROUNDER;
        state.displacement = state.displacement + *travel;
    }
    Lanes(travels)
}

/// The travel to use instead of one that is not credible; latched and counted.
#[cold]
#[inline(never)]
fn reject<T: Real>(state: &mut DamperState<T>, travel: T, largest_move: T) -> T {
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
    tables: [&'a Table<Piece<T>>; L],
    /// Stretch up to which nothing flows (m).
    offset: Lanes<T, L>,
    scale: Lanes<T, L>,
    shift: Lanes<T, L>,
    shift_root: Lanes<T, L>,
    /// The shift less what clearance and friction take off the reach.
    net_shift: Lanes<T, L>,
}

/// A solved stage.
struct Stage<'a, T, const L: usize> {
    /// (m).
    stretch: Lanes<T, L>,
    /// Flow over the stage (m).
    flow: Lanes<T, L>,
    pieces: [&'a Piece<T>; L],
    z: Lanes<T, L>,
}

impl<'a, T: Real, const L: usize> Stages<'a, T, L> {
    #[inline(always)]
    fn new(dampers: [&'a Damper<T>; L]) -> Self {
        let offset = of(dampers, |k| k.half_clearance) + of(dampers, |k| k.held);
        let scale = of(dampers, |k| k.stage_scale);
        let shift = of(dampers, |k| k.stage_shift);
        Self {
            tables: dampers.map(|damper| &damper.stage),
            offset,
            scale,
            shift,
            shift_root: of(dampers, |k| k.stage_shift_root),
            net_shift: shift - offset * scale,
        }
    }

    /// The stage whose stretch and flow sum to `reach`.
    #[inline(always)]
    fn solve(&self, reach: Lanes<T, L>) -> Stage<'a, T, L> {
        let square = (reach.magnitude() * self.scale + self.net_shift).larger(self.shift);
        let (pieces, z) = locate(self.tables, square.square_root() - self.shift_root, reach);
        let flow = cubic(pieces.map(|piece| &piece.flow), z);
        Stage {
            stretch: reach - flow,
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
}

/// Flow potential times the step (m^2) of `damper` at a stretch (m), by bisection of its stages.
pub(crate) fn potential_at<T: Real>(damper: &Damper<T>, stretch: T) -> T {
    let stages = Stages::new([damper]);
    let k = &damper.scalars;
    let last = T::from_f64(PIECES as f64 - 1.0) + k.stage_shift_root;
    let mut low = stretch.magnitude();
    let mut high = (last * last - k.stage_shift) / k.stage_scale + k.half_clearance + k.held;
    let mut stage = stages.solve(Lanes([stretch]));
    for _ in 0..T::DIGITS + 2 {
        let middle = T::from_f64(0.5) * (low + high);
        let reach = if stretch < T::ZERO { -middle } else { middle };
        stage = stages.solve(Lanes([reach]));
        if stage.stretch.0[0].magnitude() < stretch.magnitude() {
            low = middle;
        } else {
            high = middle;
        }
    }
    stage.potential().0[0]
}

/// Force (N) under a stretch of the springs (m), with the sign of `direction`: the mount's up to seal
/// friction, beyond it the table's.
#[inline(always)]
pub(crate) fn force<T: Real, const L: usize>(
    dampers: [&Damper<T>; L],
    sprung: Lanes<T, L>,
    direction: Lanes<T, L>,
) -> Lanes<T, L> {
    let held = of(dampers, |k| k.held);
    let rubbing = sprung.smaller(held) * of(dampers, |k| k.mount_stiffness);
    let beyond = (sprung - held).larger(Lanes::all(0.0));
    let y = (beyond * of(dampers, |k| k.output_scale)).square_root();
    let (pieces, z) = locate(dampers.map(|damper| &damper.output), y, direction);
    let rubbing = rubbing.zip(
        direction,
        |force, direction| {
            if direction < T::ZERO { -force } else { force }
        },
    );
    rubbing + cubic(pieces, z)
}

/// Stores stretch and flow potential at the tick; returns the forces.
#[inline(always)]
fn leave<T: Real, const L: usize>(
    dampers: [&Damper<T>; L],
    states: &mut [DamperState<T>; L],
    stretch: Lanes<T, L>,
    potential: Lanes<T, L>,
    half_clearance: Lanes<T, L>,
) -> [T; L] {
    let sprung = (stretch.magnitude() - half_clearance).larger(Lanes::all(0.0));
    let force = force(dampers, sprung, stretch);
    let ends = stretch.0.iter().zip(potential.0).zip(force.0);
    for (state, ((stretch, potential), force)) in states.iter_mut().zip(ends) {
        state.stretch = *stretch;
        state.potential = potential;
        state.force = force;
    }
    force.0
}
