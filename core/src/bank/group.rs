//! The step of a group of dampers in vectors: the operations of [`crate::step`] in the same order, in every lane.
#![expect(
    clippy::needless_range_loop,
    reason = "iterators are not always inlined into the function that enables the vector instructions"
)]

use super::Bank;
use crate::bins::BINS;
use crate::damper::Damper;
use crate::math::vectors::{GroupWork, Vector, Vectors};
use crate::parameters::MAX_FORCE_N;
use crate::real::Real;
use crate::stages::GAMMA;
use crate::state::DamperState;
use crate::status::Status;
use crate::step::{self, MAX_CORRECTION};
use crate::table::{FLOW, KNOTS, NUMBERS_PER_PIECE, POTENTIAL, STIFFNESS};

/// Dampers of a group: `N` vectors of `W` lanes.
type Dampers<'a, T, const W: usize, const N: usize> = [[&'a Damper<T>; W]; N];

impl<T: Real> GroupWork<T> for Bank<'_, T> {
    /// Steps the dampers in whole groups; returns the other dampers.
    #[inline(always)]
    fn in_groups<V: Vector<T, W>, const W: usize, const N: usize>(self, simd: V::Simd) -> Self {
        let groups = self.dampers.len() / (W * N);
        let (dampers, dampers_left) = self.dampers.split_at(groups * W * N);
        let (states, states_left) = self.states.split_at_mut(groups * W * N);
        let (displacements, displacements_left) = self.displacements.split_at(groups * W * N);
        let (forces, forces_left) = self.forces.split_at_mut(groups * W * N);
        let dampers = dampers.as_chunks().0.as_chunks().0;
        let states = states.as_chunks_mut().0.as_chunks_mut().0;
        let displacements = displacements.as_chunks().0.as_chunks().0;
        let forces = forces.as_chunks_mut().0.as_chunks_mut().0;
        let groups = dampers.iter().zip(states).zip(displacements).zip(forces);
        for (((dampers, states), displacements), forces) in groups {
            step_group::<T, V, W, N>(simd, dampers, states, displacements, forces);
        }
        Self {
            dampers: dampers_left,
            states: states_left,
            displacements: displacements_left,
            forces: forces_left,
        }
    }
}

/// Steps `N` times `W` dampers.
#[inline(always)]
fn step_group<T: Real, V: Vector<T, W>, const W: usize, const N: usize>(
    simd: V::Simd,
    dampers: &Dampers<'_, T, W, N>,
    states: &mut [[DamperState<T>; W]; N],
    displacements: &[[T; W]; N],
    forces: &mut [[T; W]; N],
) {
    let zero: Vectors<V, N> = splat(simd, 0.0);
    let mut numbers = state_numbers(simd, states);
    let [move_bound, position_rounder, rest_rounder, _] = columns(
        simd,
        dampers,
        #[inline(always)]
        |damper, row| {
            let k = &damper.scalars;
            *row = [k.move_bound, k.position_rounder, k.rest_rounder, k.step_s];
        },
    );
    let [_, _, displacement_bound, stretch_bound] = columns(
        simd,
        dampers,
        #[inline(always)]
        |damper, row| {
            let k = &damper.scalars;
            *row = [
                k.half_force_limit,
                k.held,
                k.displacement_bound,
                k.stretch_bound,
            ];
        },
    );

    let displacement: Vectors<V, N> = vectors(simd, displacements);
    let mut travel = displacement - numbers[0];
    let mut unusual = 0;
    for vector in 0..N {
        let too_fast = travel.0[vector].is_beyond(move_bound.0[vector]);
        let too_far = displacement.0[vector].is_beyond(displacement_bound.0[vector]);
        let too_long = numbers[1].0[vector].is_beyond(stretch_bound.0[vector]);
        unusual |= V::bits(too_fast | too_far | too_long) as u32;
        for lane in 0..W {
            unusual |= dampers[vector][lane].revision ^ states[vector][lane].revision;
        }
    }
    if unusual != 0 {
        travel = vectors(simd, &travels(dampers, states, displacements));
        numbers = state_numbers(simd, states);
    }

    let [last, start, potential, _] = numbers;
    let travel = (travel + position_rounder) - position_rounder;
    let end_displacement = last + travel;
    let [offset, first_knot, half_clearance, half_limit] = columns(
        simd,
        dampers,
        #[inline(always)]
        |damper, row| {
            let k = &damper.scalars;
            *row = [k.offset, k.first_knot, k.half_clearance, k.half_force_limit];
        },
    );
    let force_limit = half_limit + half_limit;
    let gamma = splat(simd, GAMMA);

    let reach = start + gamma * travel;
    let beyond = (reach.abs() - offset).max(zero);
    let first = locate(simd, dampers, beyond + first_knot, reach);
    let [first_flow] = first.cubics(simd, [FLOW]);
    let reach = start + travel - splat(simd, 1.0 - GAMMA) * first_flow;
    let beyond = (reach.abs() - offset).max(zero);
    let last = locate(simd, dampers, beyond + first_knot, reach);
    let [last_flow, end_potential, stiffness] = last.cubics(simd, [FLOW, POTENTIAL, STIFFNESS]);
    let bend = gamma * (last_flow - first_flow);
    let quadrature = first_flow + bend;
    let change = travel - quadrature;
    let end = start + change;

    let area = end_potential - potential + bend * bend;
    let max_correction = (change * splat(simd, MAX_CORRECTION)).abs();
    let correction = (area / change - quadrature)
        .min(max_correction)
        .max(max_correction.negated());
    let contact = last_flow * start * potential;
    let correction = correction.unless_positive(contact);

    let stretch = ((end + rest_rounder) - correction) - rest_rounder;
    let potential = end_potential - last_flow * correction;
    let magnitude = (stretch.abs() - half_clearance).max(zero) * stiffness;
    let limited = magnitude
        .min(force_limit)
        .max(zero)
        .min(splat(simd, MAX_FORCE_N));
    let force = limited.with_sign_of(stretch);

    for vector in 0..N {
        forces[vector] = force.0[vector].array();
        let rows = V::rows([
            end_displacement.0[vector],
            stretch.0[vector],
            potential.0[vector],
            force.0[vector],
        ]);
        for lane in 0..W {
            let state = &mut states[vector][lane];
            [
                state.displacement,
                state.stretch,
                state.potential,
                state.force,
            ] = rows[lane];
        }
        let below = V::bits(magnitude.0[vector].is_below(force_limit.0[vector]));
        if below != (1 << W) - 1 {
            for (lane, state) in states[vector].iter_mut().enumerate() {
                state.latch(Status::SATURATED.only_if(below >> lane & 1 == 0));
            }
        }
    }
}

/// Travels (m) of dampers of which at least one has an unusual input or state.
#[cold]
#[inline(never)]
fn travels<T: Real, const W: usize, const N: usize>(
    dampers: &Dampers<'_, T, W, N>,
    states: &mut [[DamperState<T>; W]; N],
    displacements: &[[T; W]; N],
) -> [[T; W]; N] {
    let mut travels = *displacements;
    let lanes = dampers.as_flattened().iter().zip(states.as_flattened_mut());
    for ((damper, state), travel) in lanes.zip(travels.as_flattened_mut()) {
        *travel = step::travel(damper, state, *travel);
    }
    travels
}

#[inline(always)]
fn splat<T: Real, V: Vector<T, W>, const W: usize, const N: usize>(
    simd: V::Simd,
    value: f64,
) -> Vectors<V, N> {
    Vectors([V::splat(simd, value); N])
}

#[inline(always)]
fn vectors<T: Real, V: Vector<T, W>, const W: usize, const N: usize>(
    simd: V::Simd,
    numbers: &[[T; W]; N],
) -> Vectors<V, N> {
    let mut vectors = [V::splat(simd, 0.0); N];
    for vector in 0..N {
        vectors[vector] = V::new(simd, numbers[vector]);
    }
    Vectors(vectors)
}

/// Vectors of four numbers of each lane.
#[inline(always)]
fn columns<L, T: Real, V: Vector<T, W>, const W: usize, const N: usize>(
    simd: V::Simd,
    lanes: &[[L; W]; N],
    copy: impl Fn(&L, &mut [T; 4]),
) -> [Vectors<V, N>; 4] {
    let mut columns = [Vectors([V::splat(simd, 0.0); N]); 4];
    for vector in 0..N {
        let mut rows = [[T::ZERO; 4]; W];
        for lane in 0..W {
            copy(&lanes[vector][lane], &mut rows[lane]);
        }
        let found = V::columns(simd, &rows);
        for column in 0..4 {
            columns[column].0[vector] = found[column];
        }
    }
    columns
}

#[inline(always)]
fn state_numbers<T: Real, V: Vector<T, W>, const W: usize, const N: usize>(
    simd: V::Simd,
    states: &[[DamperState<T>; W]; N],
) -> [Vectors<V, N>; 4] {
    columns(
        simd,
        states,
        #[inline(always)]
        |state, row| {
            *row = [
                state.displacement,
                state.stretch,
                state.potential,
                state.force,
            ]
        },
    )
}

/// Numbers of a piece and of the next one.
type Window<T> = [T; 2 * NUMBERS_PER_PIECE];

/// Returns the pieces from an entry of the table's bins on. Every entry has two pieces, so no check remains in compiled
/// code that is optimised for speed.
#[inline(always)]
fn window<T: Real>(damper: &Damper<T>, entry: u8) -> &Window<T> {
    let numbers = damper.table.pieces.as_flattened().as_flattened();
    let start = NUMBERS_PER_PIECE / 2 * usize::from(entry);
    let window = numbers.get(start..).and_then(<[T]>::first_chunk);
    window.unwrap_or(T::ZERO_PIECES)
}

/// Returns a row of the piece that starts at a number of the window: `piece` is 0 or [`NUMBERS_PER_PIECE`].
#[inline(always)]
fn row<T: Real>(window: &Window<T>, piece: usize, row: usize) -> [T; 4] {
    let start = (piece & NUMBERS_PER_PIECE) + 4 * row;
    let row = window.get(start..).and_then(<[T]>::first_chunk);
    row.copied().unwrap_or([T::ZERO; 4])
}

/// The piece of each lane's table that contains the reach of a stage, and the reach beyond its knot (m).
struct Located<'a, T, V, const W: usize, const N: usize> {
    windows: [[&'a Window<T>; W]; N],
    /// First number of the piece in its window.
    pieces: [[usize; W]; N],
    z: Vectors<V, N>,
}

/// See [`crate::table::locate`].
#[inline(always)]
fn locate<'a, T: Real, V: Vector<T, W>, const W: usize, const N: usize>(
    simd: V::Simd,
    dampers: &Dampers<'a, T, W, N>,
    reach: Vectors<V, N>,
    direction: Vectors<V, N>,
) -> Located<'a, T, V, W, N> {
    let mut windows = [[window(dampers[0][0], 0); W]; N];
    let mut pieces = [[0; W]; N];
    let mut z = reach;
    for vector in 0..N {
        let reach = reach.0[vector];
        let entries = reach.entries(direction.0[vector]);
        let mut knots = [[T::ZERO; 4]; W];
        for lane in 0..W {
            let damper = dampers[vector][lane];
            let entry = damper.table.bins.as_flattened()[entries[lane] % (2 * BINS)];
            let window = window(damper, entry);
            knots[lane] = row(window, 0, KNOTS);
            windows[vector][lane] = window;
        }
        let [knot, next, ..] = V::columns(simd, &knots);
        let passed = reach.is_above(next);
        z.0[vector] = reach - V::select(passed, next, knot);
        pieces[vector] = V::where_true(passed, NUMBERS_PER_PIECE);
    }
    Located { windows, pieces, z }
}

impl<T: Real, V: Vector<T, W>, const W: usize, const N: usize> Located<'_, T, V, W, N> {
    /// Evaluates the cubics in the given rows of each lane's piece; see [`crate::table::cubic`].
    #[inline(always)]
    fn cubics<const C: usize>(&self, simd: V::Simd, cubics: [usize; C]) -> [Vectors<V, N>; C] {
        let mut results = [self.z; C];
        for vector in 0..N {
            let mut numbers = [[[T::ZERO; 4]; W]; C];
            for lane in 0..W {
                let (window, piece) = (self.windows[vector][lane], self.pieces[vector][lane]);
                for cubic in 0..C {
                    numbers[cubic][lane] = row(window, piece, cubics[cubic]);
                }
            }
            let z = self.z.0[vector];
            for cubic in 0..C {
                let [c0, c1, c2, c3] = V::columns(simd, &numbers[cubic]);
                results[cubic].0[vector] = (c3 * z + c2) * (z * z) + (c1 * z + c0);
            }
        }
        results
    }
}
