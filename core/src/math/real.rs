//! The scalar of the step: `f32` on the target, `f64` on the desk.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::square_root;

/// `f32` or `f64` with the operations whose results are the same bits on every machine.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// Distance from 1 to the next larger number.
    const EPSILON: f64;
    /// Significant binary digits.
    const DIGITS: u32;
    /// Adding and subtracting it rounds a displacement below 4 mm to the grid of positions
    /// (2^-30 m in `f32`, 2^-59 m in `f64`): sums of such steps are exact, so a piston at rest
    /// in its clearance does not drift.
    const POSITION_ROUNDER: Self;
    /// Adding and subtracting it rounds a stretch far below the position grid to zero.
    const REST_ROUNDER: Self;

    /// The nearest representable number.
    fn from_f64(value: f64) -> Self;
    /// The same number in double precision.
    fn to_f64(self) -> f64;
    /// Correctly rounded square root.
    fn square_root(self) -> Self;
    /// Magnitude.
    fn magnitude(self) -> Self;
    /// The larger of two numbers, neither NaN, not zeros of opposite sign.
    fn larger(self, other: Self) -> Self;
    /// The smaller of two numbers, neither NaN, not zeros of opposite sign.
    fn smaller(self, other: Self) -> Self;
    /// 1 when the sign bit is set, else 0.
    fn sign_bit(self) -> usize;
    /// Nearest integer modulo 2^16 and the signed rest, for 0 <= self < 2^20.
    fn split(self) -> (usize, Self);
    /// Bits, zero-extended.
    fn to_bits_u64(self) -> u64;
    /// Whether the number is neither NaN nor infinite.
    fn is_finite(self) -> bool;
}

macro_rules! real {
    ($float:ident, $bits:ident, $position:expr, $rest:expr) => {
        impl Real for $float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const EPSILON: f64 = $float::EPSILON as f64;
            const DIGITS: u32 = $float::MANTISSA_DIGITS;
            const POSITION_ROUNDER: Self = $position;
            const REST_ROUNDER: Self = $rest;

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as Self
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn square_root(self) -> Self {
                square_root::$float(self)
            }
            #[inline(always)]
            fn magnitude(self) -> Self {
                self.abs()
            }
            // One instruction on either machine; they differ only for NaN and signed zeros.
            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                if cfg!(target_arch = "arm") {
                    self.max(other)
                } else if self > other {
                    self
                } else {
                    other
                }
            }
            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                if cfg!(target_arch = "arm") {
                    self.min(other)
                } else if self < other {
                    self
                } else {
                    other
                }
            }
            #[inline(always)]
            fn sign_bit(self) -> usize {
                (self.to_bits() >> ($bits::BITS - 1)) as usize
            }
            #[inline(always)]
            fn split(self) -> (usize, Self) {
                // In [2^(d-1), 2^d), d significant digits, the numbers are the integers.
                const INTEGERS: $float = 1.5 * (1_u64 << ($float::MANTISSA_DIGITS - 1)) as $float;
                let shifted = self + INTEGERS;
                (
                    usize::from(shifted.to_bits() as u16),
                    self - (shifted - INTEGERS),
                )
            }
            #[inline(always)]
            fn to_bits_u64(self) -> u64 {
                u64::from(self.to_bits())
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
        }
    };
}

// 1.5 * 2^-7 and 1.5 * 2^-7: ulp 2^-30 (f32) and 2^-59 (f64); 2^-29 and 2^-58 are on that grid.
real!(f32, u32, 0.011_718_75, 1.862_645_1e-9);
real!(f64, u64, 0.011_718_75, 3.469_446_951_953_614e-18);

#[cfg(test)]
mod tests {
    use super::Real;

    #[test]
    fn split_rounds_to_nearest() {
        assert_eq!(2.75_f32.split(), (3, -0.25));
        assert_eq!(0.25_f64.split(), (0, 0.25));
        assert_eq!(63.0_f32.split(), (63, 0.0));
    }

    #[test]
    fn position_grid_is_as_stated() {
        let grid = 2.0_f32.powi(-30);
        let rounded = (1.3 * grid + f32::POSITION_ROUNDER) - f32::POSITION_ROUNDER;
        assert_eq!(rounded, grid);
        assert_eq!(f32::REST_ROUNDER % grid, 0.0);
        let grid = 2.0_f64.powi(-59);
        let rounded = (1.3 * grid + f64::POSITION_ROUNDER) - f64::POSITION_ROUNDER;
        assert_eq!(rounded, grid);
        assert_eq!(f64::REST_ROUNDER % grid, 0.0);
    }
}
