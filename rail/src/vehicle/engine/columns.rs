//! A block in the registers: its first four columns in a vector for each row, and its last column.
//!
//! With vectors of four numbers, a row of five takes two instructions for each operation; here, the second is for a
//! single number, or one for four rows.

use fearless_simd::{Simd, SimdBase, f64x4, mask64x4};

use super::block::{Block, N, Vector};
use crate::math::number::load;

/// Number of columns in vectors.
const FIRST: usize = 4;

/// Index of each of these columns.
const INDICES: [f64; FIRST] = [0.0, 1.0, 2.0, 3.0];

/// A block in the registers.
#[derive(Clone, Copy)]
pub(super) struct Columns<S: Simd> {
    /// The first four columns of each row.
    first: [f64x4<S>; N],
    last: [f64; N],
}

impl<S: Simd> Columns<S> {
    #[inline(always)]
    pub fn new(simd: S, block: &Block) -> Self {
        let mut columns = Self {
            first: [simd.splat_f64x4(0.0); N],
            last: [0.0; N],
        };
        for (i, row) in block.0.iter().enumerate() {
            columns.first[i] = f64x4::from_slice(simd, &row[..FIRST]);
            columns.last[i] = row[FIRST];
        }
        columns
    }

    #[inline(always)]
    pub fn write(&self, block: &mut Block) {
        for (i, row) in block.0.iter_mut().enumerate() {
            self.first[i].store_slice(&mut row[..FIRST]);
            row[FIRST] = self.last[i];
        }
    }

    /// One step of Gauss-Jordan elimination. Returns true if its pivot is positive.
    // Every row by its name instead of a loop, so that all rows stay in registers.
    #[inline(always)]
    pub fn eliminate<const J: usize>(self) -> (Self, bool) {
        let simd = self.first[0].simd;
        let pivot = self.number(J, J);
        let inverse = 1.0 / pivot;
        let (mut scaled, mut last_scaled) = (self.first[J] * inverse, inverse);
        if J < FIRST {
            scaled = simd.select_f64x4(at::<J, S>(simd), simd.splat_f64x4(inverse), scaled);
            last_scaled = self.last[J] * inverse;
        }
        let (p, a) = self.reduced::<J>(0, scaled, last_scaled);
        let (q, b) = self.reduced::<J>(1, scaled, last_scaled);
        let (r, c) = self.reduced::<J>(2, scaled, last_scaled);
        let (s, d) = self.reduced::<J>(3, scaled, last_scaled);
        let (t, e) = self.reduced::<J>(4, scaled, last_scaled);
        let columns = Self {
            first: [p, q, r, s, t],
            last: [a, b, c, d, e],
        };
        (columns, pivot > 0.0)
    }

    /// Row `i` after the elimination of row `J`, which is given scaled.
    #[inline(always)]
    fn reduced<const J: usize>(
        &self,
        i: usize,
        scaled: f64x4<S>,
        last_scaled: f64,
    ) -> (f64x4<S>, f64) {
        let simd = scaled.simd;
        if i == J {
            return (scaled, last_scaled);
        }
        let (factor, first) = (self.number(i, J), self.first[i]);
        if J < FIRST {
            let first = simd.select_f64x4(at::<J, S>(simd), simd.splat_f64x4(0.0), first);
            (first - scaled * factor, self.last[i] - last_scaled * factor)
        } else {
            (first - scaled * factor, 0.0 - last_scaled * factor)
        }
    }

    #[inline(always)]
    fn number(&self, i: usize, j: usize) -> f64 {
        if j < FIRST {
            self.first[i][j]
        } else {
            self.last[i]
        }
    }
}

impl Block {
    /// Inverts a symmetric block in place (Gauss-Jordan elimination without row exchange). Returns true if it is
    /// positive definite, that is, if all pivots are positive.
    #[inline(always)]
    pub fn invert<S: Simd>(&mut self, simd: S) -> bool {
        let columns = Columns::new(simd, self);
        let (columns, a) = columns.eliminate::<0>();
        let (columns, b) = columns.eliminate::<1>();
        let (columns, c) = columns.eliminate::<2>();
        let (columns, d) = columns.eliminate::<3>();
        let (columns, e) = columns.eliminate::<4>();
        columns.write(self);
        a & b & c & d & e
    }
}

/// Selects column `J`.
#[inline(always)]
fn at<const J: usize, S: Simd>(simd: S) -> mask64x4<S> {
    simd.simd_eq_f64x4(load(simd, &INDICES), simd.splat_f64x4(J as f64))
}

/// Sums of weighted outer products of directions.
#[derive(Clone, Copy)]
pub(super) struct Products<S: Simd> {
    /// The first four columns of each row.
    first: [f64x4<S>; N],
    /// The last column of the first four rows.
    last: f64x4<S>,
    corner: f64,
}

/// A direction `d` times a weight `w`: the first four coordinates, and the last.
#[derive(Clone, Copy)]
pub(super) struct Weighted<S: Simd> {
    pub first: f64x4<S>,
    pub last: f64,
}

impl<S: Simd> Products<S> {
    #[inline(always)]
    pub fn new(simd: S, block: &Block) -> Self {
        let Columns { first, last } = Columns::new(simd, block);
        let [lateral, vertical, roll, pitch, yaw] = last;
        Self {
            first,
            last: load(simd, &[lateral, vertical, roll, pitch]),
            corner: yaw,
        }
    }

    #[inline(always)]
    pub fn write(&self, block: &mut Block) {
        let [lateral, vertical, roll, pitch] = self.last.into();
        let last = [lateral, vertical, roll, pitch, self.corner];
        let first = self.first;
        Columns { first, last }.write(block);
    }

    /// Adds `w d d^T` to the rows that `rows` names; `d` is zero in the others. Returns `w d`.
    #[inline(always)]
    pub fn add<const ROWS: usize>(
        &mut self,
        direction: &Vector,
        weight: f64,
        rows: [usize; ROWS],
    ) -> Weighted<S> {
        let simd = self.last.simd;
        let four = f64x4::from_slice(simd, &direction[..FIRST]);
        let weighted = Weighted {
            first: four * weight,
            last: direction[FIRST] * weight,
        };
        let mut k = 0;
        while k < ROWS {
            let row = rows[k];
            self.first[row] += weighted.first * direction[row];
            k += 1;
        }
        self.last += four * weighted.last;
        self.corner += direction[FIRST] * weighted.last;
        weighted
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use crate::math::dispatch::dispatch;

    use super::*;

    #[test]
    fn a_block_with_a_zero_pivot_is_not_positive_definite() {
        let diagonal = |last: f64| {
            let entries = [1.0, 2.0, 3.0, 4.0, last];
            Block::new(|i, j| if i == j { entries[i] } else { 0.0 })
        };
        for (last, expected) in [(1e-3, true), (0.0, false), (-1e-3, false)] {
            let mut block = diagonal(last);
            let found = dispatch!(Level::new(), simd => block.invert(simd));
            assert_eq!(found, expected, "{last}");
        }
    }

    #[test]
    fn a_direction_adds_its_weighted_outer_product() {
        #[inline(always)]
        fn sum<S: Simd>(simd: S, block: &mut Block) {
            let mut products = Products::new(simd, block);
            products.add(&[1.0, -2.0, 3.0, 0.5, -4.0], 2.0, [0, 1, 2, 3, 4]);
            products.add(&[0.0, 0.0, 0.0, 2.0, 1.0], -3.0, [3, 4]);
            products.write(block);
        }
        let all: [(Vector, f64); 2] = [
            ([1.0, -2.0, 3.0, 0.5, -4.0], 2.0),
            ([0.0, 0.0, 0.0, 2.0, 1.0], -3.0),
        ];
        let start = |i: usize, j: usize| (3 * i + 7 * j) as f64;
        let expected = Block::new(|i, j| {
            let added = all.iter().map(|(d, weight)| weight * d[i] * d[j]);
            start(i, j) + added.sum::<f64>()
        });
        let mut block = Block::new(start);
        dispatch!(Level::new(), simd => sum(simd, &mut block));
        assert_eq!(block, expected);
    }
}
