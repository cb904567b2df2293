//! Matrix blocks for the coordinates of two bodies, with each row in one SIMD vector.

use fearless_simd::{Simd, SimdBase, f64x8};

use crate::vehicle::body::COORDINATES;

/// Number of coordinates of a body.
pub(super) const N: usize = COORDINATES.len();

/// One value per coordinate of a body.
pub(super) type Vector = [f64; N];

/// SIMD lanes per row; unused lanes are zero.
pub(super) const WIDTH: usize = 8;

/// One value for each pair of coordinates of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Block(pub(super) [[f64; WIDTH]; N]);

/// Returns the lanes that hold coordinates.
#[inline(always)]
pub(super) fn coordinates<S: Simd>(row: f64x8<S>) -> Vector {
    let lanes: [f64; WIDTH] = row.into();
    std::array::from_fn(|i| lanes[i])
}

/// Subtracts the lanes that hold coordinates.
#[inline(always)]
pub(super) fn subtract<S: Simd>(vector: &mut Vector, row: f64x8<S>) {
    for (value, subtrahend) in vector.iter_mut().zip(coordinates(row)) {
        *value -= subtrahend;
    }
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

    pub fn diagonal(&self) -> Vector {
        std::array::from_fn(|i| self.0[i][i])
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

    /// Computes `self -= left * right`.
    #[inline(always)]
    pub fn subtract_product<S: Simd>(&mut self, simd: S, left: &Self, right: &Self) {
        for (row, left) in self.0.iter_mut().zip(&left.0) {
            let mut sum = f64x8::from_slice(simd, row);
            for (number, right) in left.iter().zip(&right.0) {
                sum -= simd.splat_f64x8(*number) * f64x8::from_slice(simd, right);
            }
            sum.store_slice(row);
        }
    }

    /// Computes `self = left^T * right`.
    #[inline(always)]
    pub fn set_transposed_product<S: Simd>(&mut self, simd: S, left: &Self, right: &Self) {
        for (i, row) in self.0.iter_mut().enumerate() {
            let mut sum = simd.splat_f64x8(0.0);
            for (left, right) in left.0.iter().zip(&right.0) {
                sum += simd.splat_f64x8(left[i]) * f64x8::from_slice(simd, right);
            }
            sum.store_slice(row);
        }
    }
}
