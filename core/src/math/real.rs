//! The scalar of the step: `f32` on the target, `f64` on the desk.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Lanes;
use super::group::{self, GROUP};
use crate::table::Table;

/// The scalar of a damper: `f32` or `f64`, and no other type.
///
/// ```
/// use dashpot_core::Real;
///
/// fn twice<T: Real>(x: T) -> T {
///     x + x
/// }
/// assert_eq!(twice(0.25_f32), 0.5);
/// assert_eq!(<f64 as Real>::NAME, "f64");
/// ```
pub trait Real: Scalar {
    /// `f32` or `f64`.
    const NAME: &'static str;
    /// Zero.
    const ZERO: Self;

    /// The nearest representable number.
    fn from_f64(value: f64) -> Self;
    /// The same number in double precision.
    fn to_f64(self) -> f64;
    /// Bits, zero-extended.
    fn to_bits_u64(self) -> u64;
    /// Whether the number is neither NaN nor infinite.
    fn is_finite(self) -> bool;
}

/// What the step and the builder need of a scalar; out of reach of other crates, so that they cannot add one.
pub trait Scalar:
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
    + Lanes<Self, 1>
    + 'static
{
    /// A number for each damper of a group.
    type Group: Lanes<Self, GROUP>;

    /// Distance from 1 to the next larger number.
    const EPSILON: f64;
    /// Largest finite number.
    const MAX: Self;
    /// Significant binary digits.
    const MANTISSA_DIGITS: u32;
    /// A table without meaning, to be written.
    const ZERO_TABLE: Table<Self>;

    /// The number whose bits are twice those of this one, a magnitude below 1.5: the step compares it with the bits
    /// of a number without their sign, one instruction where numbers take three.
    fn doubled_bits(self) -> Self;
    /// The inverse of [`Scalar::doubled_bits`].
    fn halved_bits(self) -> Self;
    /// See [`Table::index`].
    fn index(table: &mut Table<Self>);
    /// See [`Table::check`].
    fn table_check(table: &Table<Self>) -> u32;
    /// See [`Table::check_row`].
    fn check_row(table: &Table<Self>, row: usize, crc: u32) -> u32;
}

macro_rules! real {
    ($float:ident, $group:ident) => {
        impl Real for $float {
            const NAME: &'static str = stringify!($float);
            const ZERO: Self = 0.0;

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as Self
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
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

        impl Scalar for $float {
            type Group = group::$group;

            const EPSILON: f64 = $float::EPSILON as f64;
            const MAX: Self = $float::MAX;
            const MANTISSA_DIGITS: u32 = $float::MANTISSA_DIGITS;
            const ZERO_TABLE: Table<Self> = Table::<$float>::ZERO;

            fn doubled_bits(self) -> Self {
                Self::from_bits(self.to_bits() << 1)
            }
            fn halved_bits(self) -> Self {
                Self::from_bits(self.to_bits() >> 1)
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
        }
    };
}

real!(f32, F32);
real!(f64, F64);
