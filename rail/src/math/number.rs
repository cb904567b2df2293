//! Number types for generic formulas: a scalar, four vector lanes, or a number with derivatives.

use std::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::{Simd, SimdBase, f32x4, f64x4};

/// A real number, possibly in several lanes or with derivatives.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// The value in one lane.
    fn lane(self, lane: usize) -> f64;

    /// `1 / self`.
    fn reciprocal(self) -> Self;

    /// Square root of a non-negative number.
    fn sqrt(self) -> Self;

    /// Limits the magnitude to `limit`; the derivatives of a limited number are zero.
    fn limited(self, limit: f64) -> Self;

    /// The number, or zero if it is negative.
    fn not_negative(self) -> Self;

    /// 1 with the sign of the number (also of a negative zero).
    fn sign(self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        1.0 / self
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn limited(self, limit: f64) -> Self {
        self.clamp(-limit, limit)
    }

    #[inline(always)]
    fn not_negative(self) -> Self {
        self.max(0.0)
    }

    #[inline(always)]
    fn sign(self) -> Self {
        1f64.copysign(self)
    }
}

impl<S: Simd> Number for f64x4<S> {
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self[lane]
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        1.0 / self
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.simd.sqrt_f64x4(self)
    }

    #[inline(always)]
    fn limited(self, limit: f64) -> Self {
        let simd = self.simd;
        let (low, high) = (simd.splat_f64x4(-limit), simd.splat_f64x4(limit));
        simd.min_f64x4(simd.max_f64x4(self, low), high)
    }

    #[inline(always)]
    fn not_negative(self) -> Self {
        let simd = self.simd;
        simd.max_f64x4(self, simd.splat_f64x4(0.0))
    }

    #[inline(always)]
    fn sign(self) -> Self {
        let simd = self.simd;
        simd.copysign_f64x4(simd.splat_f64x4(1.0), self)
    }
}

/// A number whose last bit counts ones: added to a small number, it leaves the nearest whole one in the last 32 bits. A
/// conversion with `as` takes more instructions, because it checks the range.
pub const WHOLE: f64 = (3_u64 << 51) as f64;

/// True if all lanes are greater than `low` and at most `high`; false for NaN.
#[inline(always)]
pub fn are_within<S: Simd>(numbers: f64x4<S>, low: f64, high: f64) -> bool {
    let simd = numbers.simd;
    let above = simd.simd_gt_f64x4(numbers, simd.splat_f64x4(low));
    let below = simd.simd_le_f64x4(numbers, simd.splat_f64x4(high));
    simd.all_true_mask64x4(above & below)
}

/// Loads an array into a vector.
#[inline(always)]
pub fn load<S: Simd>(simd: S, lanes: &[f64; 4]) -> f64x4<S> {
    f64x4::from_slice(simd, lanes)
}

/// Transposes four vectors: returns the first lanes of all, then the second lanes, and so on.
#[inline(always)]
pub fn rows<S: Simd>([a, b, c, d]: [f64x4<S>; 4]) -> [f64x4<S>; 4] {
    let simd = a.simd;
    let (even, odd) = (simd.interleave_f64x4(a, c), simd.interleave_f64x4(b, d));
    let (first, second) = simd.interleave_f64x4(even.0, odd.0);
    let (third, last) = simd.interleave_f64x4(even.1, odd.1);
    [first, second, third, last]
}

/// Transposes four vectors, as [`rows`], and converts them to double precision.
#[inline(always)]
pub fn transposed<S: Simd>(simd: S, [a, b, c, d]: [f32x4<S>; 4]) -> [f64x4<S>; 4] {
    let (even, odd) = (simd.interleave_f32x4(a, c), simd.interleave_f32x4(b, d));
    let (first, second) = simd.interleave_f32x4(even.0, odd.0);
    let (third, last) = simd.interleave_f32x4(even.1, odd.1);
    let (first, second) = simd.widen_f32x8(simd.combine_f32x4(first, second));
    let (third, last) = simd.widen_f32x8(simd.combine_f32x4(third, last));
    [first, second, third, last]
}

#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use crate::math::dispatch::dispatch;

    use super::*;

    #[test]
    fn lanes_compute_independently() {
        fn formula<T: Number>(x: T, y: T) -> T {
            x * x * y / x.sqrt() - x * 2.0 + y.reciprocal()
        }
        #[inline(always)]
        fn check<S: Simd>(simd: S) {
            let (x, y) = ([0.7, 2.0, 3.0, 0.1], [-1.3, 0.5, -0.0, 7.0]);
            let lanes = formula(load(simd, &x), load(simd, &y));
            for lane in 0..4 {
                assert_eq!(lanes.lane(lane), formula(x[lane], y[lane]));
            }
            let numbers = load(simd, &[-3.0, 0.2, 0.0, 5.0]);
            let array = <[f64; 4]>::from;
            assert_eq!(array(numbers.limited(1.0)), [-1.0, 0.2, 0.0, 1.0]);
            assert_eq!(array(numbers.not_negative()), [0.0, 0.2, 0.0, 5.0]);
            assert_eq!(array(numbers.sign()), [-1.0, 1.0, 1.0, 1.0]);
            let rows = [0.0f32, 1.0, 2.0, 3.0]
                .map(|row| f32x4::from_slice(simd, &[row, row + 10.0, row + 20.0, row + 30.0]));
            let columns = transposed(simd, rows).map(<[f64; 4]>::from);
            assert_eq!(columns[0], [0.0, 1.0, 2.0, 3.0]);
            assert_eq!(columns[2], [20.0, 21.0, 22.0, 23.0]);
            assert!(are_within(numbers, -3.5, 5.0));
            assert!(!are_within(numbers, -3.0, 5.0));
            let with_nan = load(simd, &[1.0, f64::NAN, 1.0, 1.0]);
            assert!(!are_within(with_nan, 0.0, 2.0));
        }
        dispatch!(Level::new(), simd => check(simd));
        dispatch!(Level::baseline(), simd => check(simd));
    }
}
