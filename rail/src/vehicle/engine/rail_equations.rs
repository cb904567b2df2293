//! Equations of the two rails under a wheelset. They are coupled only to this wheelset, and not to each other.

use fearless_simd::{Simd, SimdBase, f64x4, f64x8};

use super::block::{Block, N, Vector, WIDTH, subtract};
use super::columns::Weighted;
use crate::math::number::load;

/// Coordinates of the rails: lateral and vertical of the left rail, then of the right rail.
pub(super) const RAILS: usize = 4;

/// The matrix of the rails, or its factors after their elimination.
///
/// A row of numbers for the coordinates of the rails has the left rail in its first two lanes and the right rail in the
/// others.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct RailEquations {
    /// A row for each coordinate of the rails, a column for each one of the wheelset.
    pub(super) coupling: [[f64; WIDTH]; RAILS],
    /// The lateral row of each rail in its own block; after elimination, in the inverse of the block.
    pub(super) lateral: [f64; RAILS],
    /// The vertical rows.
    pub(super) vertical: [f64; RAILS],
    /// Factors only: transpose of the coupling times the inverse of the blocks.
    carried: [[f64; RAILS]; N],
}

/// Inverts a block `[[a, b], [c, d]]` in the same order as [`Block::invert`]. Returns true if its pivots are positive.
#[inline(always)]
fn inverse([[a, b], [c, d]]: [[f64; 2]; 2]) -> ([[f64; 2]; 2], bool) {
    let per_a = 1.0 / a;
    let scaled = b * per_a;
    let pivot = d - c * scaled;
    let per_pivot = 1.0 / pivot;
    let below = (0.0 - c * per_a) * per_pivot;
    let inverse = [
        [per_a - scaled * below, 0.0 - scaled * per_pivot],
        [below, per_pivot],
    ];
    (inverse, (a > 0.0) & (pivot > 0.0))
}

impl RailEquations {
    /// Uncoupled rails with this diagonal.
    pub fn uncoupled([a, b, c, d]: [f64; RAILS]) -> Self {
        Self {
            coupling: [[0.0; WIDTH]; RAILS],
            lateral: [a, 0.0, c, 0.0],
            vertical: [0.0, b, 0.0, d],
            carried: [[0.0; RAILS]; N],
        }
    }

    /// Adds the resistance of a patch on one side to the motion of the wheelset relative to the rail along
    /// `[lateral, vertical]`, which is `weighted` with its weight.
    #[inline(always)]
    pub fn add<S: Simd>(
        &mut self,
        simd: S,
        side: usize,
        [lateral, vertical]: [f64; 2],
        weighted: &Weighted<S>,
    ) {
        let first = 2 * (side % 2);
        let [across, down, ..] = <[f64; 4]>::from(weighted.first);
        self.lateral[first] += lateral * across;
        self.lateral[first + 1] += lateral * down;
        self.vertical[first] += vertical * across;
        self.vertical[first + 1] += vertical * down;
        for (row, number) in [(first, lateral), (first + 1, vertical)] {
            let row = &mut self.coupling[row];
            let four = f64x4::from_slice(simd, &row[..4]) - weighted.first * number;
            four.store_slice(&mut row[..4]);
            row[4] -= weighted.last * number;
        }
    }

    /// Eliminates the rails from the equations of their wheelset. Returns true if all pivots are positive.
    #[inline(always)]
    pub fn eliminate<S: Simd>(&mut self, simd: S, wheelset: &mut Block) -> bool {
        let [a, b, c, d] = self.lateral;
        let [e, f, g, h] = self.vertical;
        let ([[a, b], [e, f]], is_left_positive) = inverse([[a, b], [e, f]]);
        let ([[c, d], [g, h]], is_right_positive) = inverse([[c, d], [g, h]]);
        (self.lateral, self.vertical) = ([a, b, c, d], [e, f, g, h]);
        let (lateral, vertical) = (load(simd, &self.lateral), load(simd, &self.vertical));
        let [p, q, r, s] = &self.coupling;
        for (i, (carried, row)) in self.carried.iter_mut().zip(&mut wheelset.0).enumerate() {
            let product = load(simd, &[p[i], p[i], r[i], r[i]]) * lateral
                + load(simd, &[q[i], q[i], s[i], s[i]]) * vertical;
            product.store_slice(carried);
            let mut sum = f64x8::from_slice(simd, row);
            for (number, coupling) in carried.iter().zip(&self.coupling) {
                sum -= simd.splat_f64x8(*number) * f64x8::from_slice(simd, coupling);
            }
            sum.store_slice(row);
        }
        is_left_positive & is_right_positive
    }

    /// First half of the solution: replaces the right-hand side of the rails by the solution with the wheelset held,
    /// and changes that of the wheelset.
    #[inline(always)]
    pub fn solve_rails<S: Simd>(&self, simd: S, rails: &mut Vector, wheelset: &mut Vector) {
        let [a, b, c, d, _] = *rails;
        let own = load(simd, &[a, a, c, c]) * load(simd, &self.lateral)
            + load(simd, &[b, b, d, d]) * load(simd, &self.vertical);
        own.store_slice(&mut rails[..RAILS]);
        let mut sum = simd.splat_f64x8(0.0);
        for (number, coupling) in rails.iter().zip(&self.coupling) {
            sum += simd.splat_f64x8(*number) * f64x8::from_slice(simd, coupling);
        }
        subtract(wheelset, sum);
    }

    /// Second half of the solution: adds what the motion of the wheelset does to the rails.
    #[inline(always)]
    pub fn follow_wheelset<S: Simd>(&self, simd: S, rails: &mut Vector, wheelset: &Vector) {
        let mut sum = simd.splat_f64x4(0.0);
        for (number, carried) in wheelset.iter().zip(&self.carried) {
            sum += load(simd, carried) * *number;
        }
        let rails = &mut rails[..RAILS];
        (f64x4::from_slice(simd, rails) - sum).store_slice(rails);
    }
}

#[cfg(test)]
mod tests;
