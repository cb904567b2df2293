//! The scalar of the step: `f32` on the target, `f64` on the desk.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::group::{self, GROUP};
use super::{Lanes, square_root};

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
    /// A number for each damper of a group.
    #[doc(hidden)]
    type Group: Lanes<Self, GROUP>;

    /// Zero.
    const ZERO: Self;
    /// Distance from 1 to the next larger number.
    const EPSILON: f64;
    /// Significant binary digits.
    const DIGITS: u32;

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
    /// Whole part of a number in [768, 1024), less 768; of any other a number below 256.
    fn place(self) -> usize;
    /// Bits, zero-extended.
    fn to_bits_u64(self) -> u64;
    /// Whether the number is neither NaN nor infinite.
    fn is_finite(self) -> bool;
}

macro_rules! real {
    ($float:ident, $bits:ident, $group:ident) => {
        impl Real for $float {
            type Group = group::$group;

            const ZERO: Self = 0.0;
            const EPSILON: f64 = $float::EPSILON as f64;
            const DIGITS: u32 = $float::MANTISSA_DIGITS;

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
            fn place(self) -> usize {
                // Below the leading digit of the fraction: 512 and 256 take two.
                (self.to_bits() >> ($float::MANTISSA_DIGITS - 10)) as usize & 0xff
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

real!(f32, u32, F32);
real!(f64, u64, F64);

#[cfg(test)]
mod tests {
    use super::Real;

    #[test]
    fn the_place_is_the_whole_part() {
        assert_eq!([770.75_f32, 768.0, 1023.9].map(Real::place), [2, 0, 255]);
        assert_eq!([770.75_f64, 768.0, 1023.9].map(Real::place), [2, 0, 255]);
        assert!(
            [f32::NAN, -1.0, 1e30]
                .map(Real::place)
                .iter()
                .all(|place| *place < 256)
        );
    }
}
