//! A block in the registers: its first four columns in a vector for each row, and its last column.
//!
//! With vectors of four numbers, a row of five takes two instructions for each operation; here, the second is for a
//! single number, or one for four rows.

use fearless_simd::{Simd, SimdBase, f64x4};

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
    #[inline(always)]
    pub fn eliminate<const J: usize>(&mut self) -> bool {
        let simd = self.first[0].simd;
        let is_last = J == FIRST;
        let lanes = load(simd, &INDICES);
        let at_pivot = simd.simd_eq_f64x4(lanes, simd.splat_f64x4(J as f64));
        let zero = simd.splat_f64x4(0.0);
        let pivot = if is_last {
            self.last[J]
        } else {
            self.first[J][J]
        };
        let inverse = 1.0 / pivot;
        let (mut scaled, mut last_scaled) = (self.first[J] * inverse, inverse);
        if !is_last {
            scaled = simd.select_f64x4(at_pivot, simd.splat_f64x4(inverse), scaled);
            last_scaled = self.last[J] * inverse;
        }
        for i in 0..N {
            if i == J {
                continue;
            }
            let (first, last) = (self.first[i], self.last[i]);
            if is_last {
                self.first[i] = first - scaled * last;
                self.last[i] = 0.0 - last_scaled * last;
            } else {
                let factor = first[J];
                self.first[i] = simd.select_f64x4(at_pivot, zero, first) - scaled * factor;
                self.last[i] = last - last_scaled * factor;
            }
        }
        (self.first[J], self.last[J]) = (scaled, last_scaled);
        pivot > 0.0
    }
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
    use fearless_simd::{Level, dispatch};

    use super::*;

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
