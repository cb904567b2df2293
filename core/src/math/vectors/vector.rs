//! Vectors of a group of dampers: `W` numbers in a vector, `N` vectors in a group.
//!
//! Each lane goes through the same operations as the number of a single step, so the bits do not depend on the width.
//! Every function is inlined into the one that enables the vector instructions.

use core::ops::{Add, BitOr, Div, Mul, Neg, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8, f64x4, u32x8, u64x4};

use super::transposes::Transposes;
use crate::bins::{BINS, bin_shift};

/// Vector of `W` numbers.
pub(crate) trait Vector<T, const W: usize>:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Token of the vector instructions.
    type Simd: Transposes;
    /// Truth of each lane.
    type Mask: Copy + BitOr<Output = Self::Mask>;

    fn new(simd: Self::Simd, lanes: [T; W]) -> Self;
    fn splat(simd: Self::Simd, value: f64) -> Self;
    fn array(self) -> [T; W];
    /// Vector `i` of the result contains number `i` of every row.
    fn columns(simd: Self::Simd, rows: &[[T; 4]; W]) -> [Self; 4];
    /// Inverse of [`Vector::columns`].
    fn rows(columns: [Self; 4]) -> [[T; 4]; W];
    fn abs(self) -> Self;
    /// Lane-wise maximum; `other` if `self` is NaN.
    fn max(self, other: Self) -> Self;
    /// Lane-wise minimum; `other` if `self` is NaN.
    fn min(self, other: Self) -> Self;
    fn is_above(self, other: Self) -> Self::Mask;
    fn is_below(self, other: Self) -> Self::Mask;
    /// Zero in lanes with a positive `gate`, else the unchanged number.
    fn unless_positive(self, gate: Self) -> Self;
    /// The negated number in lanes with a negative `direction`, else the unchanged number.
    fn with_sign_of(self, direction: Self) -> Self;
    fn negated(self) -> Self;
    /// True unless the magnitude is at most the bound of the [`doubled bits`](crate::real::Scalar::doubled_bits).
    fn is_beyond(self, doubled_bits: Self) -> Self::Mask;
    /// One bit for each lane.
    fn bits(mask: Self::Mask) -> u64;
    /// The number in each true lane, else zero.
    fn where_true(mask: Self::Mask, number: usize) -> [usize; W];
    fn select(mask: Self::Mask, then: Self, otherwise: Self) -> Self;
    /// Index of the entry of the table's bins: two for each bin, the second for a negative direction.
    fn entries(self, direction: Self) -> [usize; W];
}

macro_rules! vector {
    ($float:ident, $width:literal, $vector:ident, $words:ident, $word:ident, $split:ident) => {
        impl<S: Transposes> Vector<$float, $width> for $vector<S> {
            type Simd = S;
            type Mask = <Self as SimdBase<S>>::Mask;

            #[inline(always)]
            fn new(simd: S, lanes: [$float; $width]) -> Self {
                lanes.simd_into(simd)
            }
            #[inline(always)]
            fn splat(simd: S, value: f64) -> Self {
                <Self as SimdBase<S>>::splat(simd, value as $float)
            }
            #[inline(always)]
            fn array(self) -> [$float; $width] {
                self.into()
            }
            #[inline(always)]
            fn columns(simd: S, rows: &[[$float; 4]; $width]) -> [Self; 4] {
                $split::columns(simd, rows)
            }
            #[inline(always)]
            fn rows(columns: [Self; 4]) -> [[$float; 4]; $width] {
                $split::rows(columns)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                <Self as SimdBase<S>>::abs(self)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // On x86-64 this is one instruction. On other processors it would return NaN if a number is NaN.
                if cfg!(target_arch = "x86_64") {
                    <Self as SimdBase<S>>::max(self, other)
                } else {
                    self.simd_gt(other).select(self, other)
                }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if cfg!(target_arch = "x86_64") {
                    <Self as SimdBase<S>>::min(self, other)
                } else {
                    self.simd_lt(other).select(self, other)
                }
            }
            #[inline(always)]
            fn is_above(self, other: Self) -> Self::Mask {
                self.simd_gt(other)
            }
            #[inline(always)]
            fn is_below(self, other: Self) -> Self::Mask {
                self.simd_lt(other)
            }
            #[inline(always)]
            fn unless_positive(self, gate: Self) -> Self {
                let zero = <Self as SimdBase<S>>::splat(self.simd, 0.0);
                gate.simd_gt(zero).select(zero, self)
            }
            #[inline(always)]
            fn with_sign_of(self, direction: Self) -> Self {
                direction.simd_ge(0.0).select(self, -self)
            }
            #[inline(always)]
            fn negated(self) -> Self {
                -self
            }
            #[inline(always)]
            fn is_beyond(self, doubled_bits: Self) -> Self::Mask {
                let bound: $words<S> = doubled_bits.bitcast();
                let bound: Self = (bound >> 1).bitcast();
                !<Self as SimdBase<S>>::abs(self).simd_le(bound)
            }
            #[inline(always)]
            fn bits(mask: Self::Mask) -> u64 {
                mask.to_bitmask()
            }
            #[inline(always)]
            fn where_true(mask: Self::Mask, number: usize) -> [usize; $width] {
                let numbers: $words<S> = mask.to_vector().bitcast();
                let words: [$word; $width] = (numbers & number as $word).into();
                let mut numbers = [0; $width];
                for lane in 0..$width {
                    numbers[lane] = words[lane] as usize;
                }
                numbers
            }
            #[inline(always)]
            fn select(mask: Self::Mask, then: Self, otherwise: Self) -> Self {
                mask.select(then, otherwise)
            }
            #[inline(always)]
            fn entries(self, direction: Self) -> [usize; $width] {
                const SHIFT: u32 = bin_shift($float::MANTISSA_DIGITS) - 1;
                const MASK: $word = 2 * (BINS as $word - 1);
                let (reach, direction): ($words<S>, $words<S>) =
                    (self.bitcast(), direction.bitcast());
                let entries = (reach >> SHIFT) & MASK | direction >> ($word::BITS - 1);
                let words: [$word; $width] = entries.into();
                let mut entries = [0; $width];
                for lane in 0..$width {
                    entries[lane] = words[lane] as usize;
                }
                entries
            }
        }
    };
}

vector!(f32, 8, f32x8, u32x8, u32, eight);
vector!(f64, 4, f64x4, u64x4, u64, four);

/// Transposes of eight rows of four numbers in single precision.
mod eight {
    use super::*;

    #[inline(always)]
    pub(super) fn columns<S: Transposes>(simd: S, rows: &[[f32; 4]; 8]) -> [f32x8<S>; 4] {
        let [a, b, c, d, e, f, g, h] = rows;
        simd.transposed_halves([
            load(simd, a).combine(load(simd, e)),
            load(simd, b).combine(load(simd, f)),
            load(simd, c).combine(load(simd, g)),
            load(simd, d).combine(load(simd, h)),
        ])
    }

    #[inline(always)]
    pub(super) fn rows<S: Transposes>(columns: [f32x8<S>; 4]) -> [[f32; 4]; 8] {
        let columns = columns[0].token().transposed_halves(columns);
        let mut rows = [[0.0; 4]; 8];
        for row in 0..4 {
            let (low, high) = columns[row].split();
            low.store_slice(&mut rows[row]);
            high.store_slice(&mut rows[row + 4]);
        }
        rows
    }

    #[inline(always)]
    fn load<S: Simd>(simd: S, row: &[f32; 4]) -> f32x4<S> {
        f32x4::from_slice(simd, row)
    }
}

/// Transposes of four rows of four numbers in double precision.
mod four {
    use super::*;

    #[inline(always)]
    pub(super) fn columns<S: Transposes>(simd: S, rows: &[[f64; 4]; 4]) -> [f64x4<S>; 4] {
        let [a, b, c, d] = rows;
        simd.transposed([load(simd, a), load(simd, b), load(simd, c), load(simd, d)])
    }

    #[inline(always)]
    pub(super) fn rows<S: Transposes>(columns: [f64x4<S>; 4]) -> [[f64; 4]; 4] {
        let columns = columns[0].token().transposed(columns);
        let mut rows = [[0.0; 4]; 4];
        for row in 0..4 {
            columns[row].store_slice(&mut rows[row]);
        }
        rows
    }

    #[inline(always)]
    fn load<S: Simd>(simd: S, row: &[f64; 4]) -> f64x4<S> {
        f64x4::from_slice(simd, row)
    }
}

/// `N` vectors. The processor works on one while another waits for a result.
#[derive(Clone, Copy)]
pub(crate) struct Vectors<V, const N: usize>(pub(crate) [V; N]);

macro_rules! operator {
    ($operator:ident, $method:ident) => {
        impl<V: Copy + $operator<Output = V>, const N: usize> $operator for Vectors<V, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let mut result = self;
                for vector in 0..N {
                    result.0[vector] = self.0[vector].$method(other.0[vector]);
                }
                result
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

macro_rules! method {
    ($method:ident($($other:ident),*)) => {
        #[inline(always)]
        pub(crate) fn $method<T, const W: usize>(self, $($other: Self),*) -> Self
        where
            V: Vector<T, W>,
        {
            let mut result = self;
            for vector in 0..N {
                result.0[vector] = self.0[vector].$method($($other.0[vector]),*);
            }
            result
        }
    };
}

/// The methods of [`Vector`] in each vector.
impl<V: Copy, const N: usize> Vectors<V, N> {
    method!(abs());
    method!(negated());
    method!(max(other));
    method!(min(other));
    method!(unless_positive(gate));
    method!(with_sign_of(direction));
}
