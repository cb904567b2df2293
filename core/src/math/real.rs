//! The scalar of the step: `f32` on the target, `f64` on the desk.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Lanes;
use super::group::{self, GROUP};
use crate::table::{BINS, Table, bin_shift};

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
    /// Largest finite number.
    const LARGEST: Self;
    /// A table without meaning, to be written.
    #[doc(hidden)]
    const TABLE: Table<Self>;
    /// Significant binary digits.
    const DIGITS: u32;

    /// The nearest representable number.
    fn from_f64(value: f64) -> Self;
    /// The same number in double precision.
    fn to_f64(self) -> f64;
    /// Magnitude.
    fn magnitude(self) -> Self;
    /// The larger of two numbers that are not zeros of opposite sign; of NaN `other`, which is none.
    fn larger(self, other: Self) -> Self;
    /// The smaller of two numbers that are not zeros of opposite sign; of NaN `other`, which is none.
    fn smaller(self, other: Self) -> Self;
    /// 1 when the sign bit is set, else 0.
    fn sign_bit(self) -> usize;
    /// Number of the bin of a table that a positive number lies in, below `BINS`; of any other number
    /// one below it too.
    fn bin(self) -> usize;
    /// 1 when this number is larger than the other, else 0; both positive.
    fn is_beyond(self, other: Self) -> usize;
    /// See [`Table::index`].
    #[doc(hidden)]
    fn index(table: &mut Table<Self>);
    /// See [`Table::check`].
    #[doc(hidden)]
    fn table_check(table: &Table<Self>) -> u32;
    /// See [`Table::check_row`].
    #[doc(hidden)]
    fn check_row(table: &Table<Self>, row: usize, crc: u32) -> u32;
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
            const LARGEST: Self = $float::MAX;
            const TABLE: Table<Self> = Table::<$float>::ZERO;
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
            fn bin(self) -> usize {
                (self.to_bits() >> bin_shift($float::MANTISSA_DIGITS)) as usize % BINS
            }
            #[inline(always)]
            fn is_beyond(self, other: Self) -> usize {
                // Positive numbers are in the order of their bits.
                (other.to_bits().wrapping_sub(self.to_bits()) >> ($bits::BITS - 1)) as usize
            }
            fn index(table: &mut Table<Self>) {
                table.index();
            }
            fn table_check(table: &Table<Self>) -> u32 {
                table.check()
            }
            fn check_row(table: &Table<Self>, row: usize, crc: u32) -> u32 {
                table.check_row(row, crc)
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
    use crate::table::BINS;

    #[test]
    fn a_doubling_has_128_bins() {
        let bins = [1.0, 1.0078, 1.0079, 1.999, 2.0, 4.0].map(|x: f64| (x.bin(), (x as f32).bin()));
        let from_one = |(double, single): (usize, usize)| {
            [(double, 1.0_f64.bin()), (single, 1.0_f32.bin())]
                .map(|(bin, one)| (bin + BINS - one) % BINS)
        };
        let expected = [0, 0, 1, 127, 128, 256].map(|bin| [bin; 2]);
        assert_eq!(bins.map(from_one), expected);
        assert!(
            [f32::NAN, -1.0, 1e30]
                .map(Real::bin)
                .iter()
                .all(|bin| *bin < BINS)
        );
    }
}
