//! Matrix blocks for the coordinates of two bodies, with each row in one SIMD vector.

use fearless_simd::{Simd, SimdBase, f64x8};

use crate::vehicle::body::COORDINATES;

/// Number of coordinates of a body.
pub(super) const N: usize = COORDINATES.len();

/// One value per coordinate of a body.
pub(super) type Vector = [f64; N];

/// SIMD lanes per row; unused lanes are zero.
const WIDTH: usize = 8;

/// Index of each lane.
const LANES: [f64; WIDTH] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// A weighted direction in the coordinates of a body, padded with zeros.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct Weighted {
    direction: [f64; WIDTH],
    weight: f64,
}

impl Weighted {
    pub const NONE: Self = Self {
        direction: [0.0; WIDTH],
        weight: 0.0,
    };

    #[inline(always)]
    pub fn new([lateral, vertical, roll, pitch, yaw]: Vector, weight: f64) -> Self {
        Self {
            direction: [lateral, vertical, roll, pitch, yaw, 0.0, 0.0, 0.0],
            weight,
        }
    }
}

/// One value for each pair of coordinates of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Block([[f64; WIDTH]; N]);

/// Returns the lanes that hold coordinates.
#[inline(always)]
pub(super) fn coordinates<S: Simd>(row: f64x8<S>) -> Vector {
    let lanes: [f64; WIDTH] = row.into();
    std::array::from_fn(|i| lanes[i])
}

impl Block {
    pub const ZERO: Self = Self([[0.0; WIDTH]; N]);

    /// Returns the block with the entries `entry(row, column)`.
    pub fn new(entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut block = Self::ZERO;
        for (i, row) in block.0.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().take(N).enumerate() {
                *value = entry(i, j);
            }
        }
        block
    }

    pub fn is_zero(&self) -> bool {
        *self == Self::ZERO
    }

    #[inline(always)]
    fn load<S: Simd>(&self, simd: S) -> [f64x8<S>; N] {
        // `array::map` would copy the array.
        let mut rows = [simd.splat_f64x8(0.0); N];
        for (row, numbers) in rows.iter_mut().zip(&self.0) {
            *row = f64x8::from_slice(simd, numbers);
        }
        rows
    }

    #[inline(always)]
    fn store<S: Simd>(&mut self, rows: [f64x8<S>; N]) {
        for (row, numbers) in self.0.iter_mut().zip(rows) {
            *row = numbers.into();
        }
    }

    /// Returns `sum + vector * self`: the sum of the rows, each times one entry of the vector.
    #[inline(always)]
    pub fn add_product<S: Simd>(&self, simd: S, vector: &Vector, sum: f64x8<S>) -> f64x8<S> {
        let mut sum = sum;
        for (row, number) in self.0.iter().zip(vector) {
            let row = f64x8::from_slice(simd, row);
            sum += simd.splat_f64x8(*number) * row;
        }
        sum
    }

    /// Returns `vector * self`.
    #[inline(always)]
    pub fn product<S: Simd>(&self, simd: S, vector: &Vector) -> f64x8<S> {
        self.add_product(simd, vector, simd.splat_f64x8(0.0))
    }

    /// Adds `weight * direction * direction^T` for each element of `all`.
    #[inline(always)]
    pub fn add_along<S: Simd>(&mut self, simd: S, all: &[Weighted]) {
        let mut rows = self.load(simd);
        for Weighted { direction, weight } in all {
            let across = f64x8::from_slice(simd, direction) * *weight;
            for (row, number) in rows.iter_mut().zip(direction) {
                *row += simd.splat_f64x8(*number) * across;
            }
        }
        self.store(rows);
    }

    /// Adds `weight * row * column^T` for each pair, with the weight of the row.
    #[inline(always)]
    pub fn add_between<S: Simd>(&mut self, simd: S, rows: &[Weighted], columns: &[Weighted]) {
        let mut sums = self.load(simd);
        for (row, column) in rows.iter().zip(columns) {
            let across = f64x8::from_slice(simd, &column.direction) * row.weight;
            for (sum, number) in sums.iter_mut().zip(&row.direction) {
                *sum += simd.splat_f64x8(*number) * across;
            }
        }
        self.store(sums);
    }

    /// Computes `self -= left * right`.
    #[inline(always)]
    pub fn subtract_product<S: Simd>(&mut self, simd: S, left: &Self, right: &Self) {
        let right = right.load(simd);
        for (row, left) in self.0.iter_mut().zip(&left.0) {
            let mut sum = f64x8::from_slice(simd, row);
            for (number, right) in left.iter().zip(right) {
                sum += simd.splat_f64x8(-number) * right;
            }
            *row = sum.into();
        }
    }

    /// Computes `self = left^T * right`.
    #[inline(always)]
    pub fn set_transposed_product<S: Simd>(&mut self, simd: S, left: &Self, right: &Self) {
        let right = right.load(simd);
        for (i, row) in self.0.iter_mut().enumerate() {
            let mut sum = simd.splat_f64x8(0.0);
            for (left, right) in left.0.iter().zip(right) {
                sum += simd.splat_f64x8(left[i]) * right;
            }
            *row = sum.into();
        }
    }

    /// Inverts a symmetric block in place (Gauss-Jordan elimination without row exchange). Returns true if it is
    /// positive definite, that is, if all pivots are positive.
    #[inline(always)]
    pub fn invert<S: Simd>(&mut self, simd: S) -> bool {
        let mut is_positive = true;
        let lanes = f64x8::from_slice(simd, &LANES);
        let zero = simd.splat_f64x8(0.0);
        let mut rows = self.load(simd);
        for j in 0..N {
            let at_pivot = simd.simd_eq_f64x8(lanes, simd.splat_f64x8(LANES[j]));
            let pivot = rows[j][j];
            is_positive &= pivot > 0.0;
            let inverse = simd.splat_f64x8(1.0 / pivot);
            let scaled = simd.select_f64x8(at_pivot, inverse, rows[j] * inverse);
            for (i, row) in rows.iter_mut().enumerate() {
                if i == j {
                    *row = scaled;
                } else {
                    let factor = simd.splat_f64x8(-row[j]);
                    let left = simd.select_f64x8(at_pivot, zero, *row);
                    *row = left + factor * scaled;
                }
            }
        }
        self.store(rows);
        is_positive
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    /// Two directions with their weights, and two others.
    const ROWS: [(Vector, f64); 2] = [
        ([1.0, -2.0, 3.0, 0.5, -4.0], 2.0),
        ([0.0, 5.0, -1.0, 2.0, 1.0], -3.0),
    ];
    const COLUMNS: [Vector; 2] = [[2.0, 1.0, -1.0, 4.0, 0.5], [-3.0, 2.0, 1.0, 1.0, 6.0]];

    #[test]
    fn a_pair_of_directions_adds_its_weighted_outer_product() {
        let start = |i: usize, j: usize| (3 * i + 7 * j) as f64;
        let expected = Block::new(|i, j| {
            let pairs = ROWS.iter().zip(&COLUMNS);
            let added = pairs.map(|((row, weight), column)| weight * row[i] * column[j]);
            start(i, j) + added.sum::<f64>()
        });
        let rows = ROWS.map(|(row, weight)| Weighted::new(row, weight));
        // Only the weights of the rows count.
        let columns = COLUMNS.map(|column| Weighted::new(column, 100.0));
        let mut block = Block::new(start);
        dispatch!(Level::new(), simd => block.add_between(simd, &rows, &columns));
        assert_eq!(block, expected);
    }

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
}
