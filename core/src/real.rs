//! The scalar of the step: `f32` on the target, `f64` on the desktop.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::math::{Groups, Lanes};
#[cfg(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
use crate::table::NUMBERS_PER_PIECE;
use crate::table::Table;

/// Scalar of a damper, implemented only for `f32` and `f64`.
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
#[expect(
    private_bounds,
    reason = "seals the trait and keeps its internal operations private"
)]
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
    + Scalar
    + 'static
{
    /// Name of the type: `f32` or `f64`.
    const NAME: &'static str;
    /// Zero.
    const ZERO: Self;
    /// Largest finite number.
    const MAX: Self;

    /// Rounds to the nearest representable number.
    fn from_f64(value: f64) -> Self;
    /// Converts to double precision.
    fn to_f64(self) -> f64;
    /// Returns the bits, zero-extended.
    fn to_bits_u64(self) -> u64;
    /// True if the number is neither NaN nor infinite.
    fn is_finite(self) -> bool;
}

/// Operations of a scalar for the step and the builder. The trait is private, so other crates can neither call them nor
/// implement [`Real`].
pub(crate) trait Scalar: Lanes<Self, 1> + Groups + 'static {
    /// Distance from 1 to the next larger number.
    #[cfg(feature = "builder")]
    const EPSILON: f64;
    /// Number of significant binary digits.
    const MANTISSA_DIGITS: u32;
    /// Two pieces of zeros.
    #[cfg(any(
        target_arch = "x86_64",
        target_arch = "aarch64",
        all(target_arch = "wasm32", target_feature = "simd128")
    ))]
    const ZERO_PIECES: &'static [Self; 2 * NUMBERS_PER_PIECE];
    /// A table of zeros.
    #[cfg(feature = "builder")]
    const ZERO_TABLE: Table<Self>;

    /// Doubles the bits of this number, read as an integer; the number must not be negative and must be below 1.5.
    ///
    /// The result lets the step compare the magnitude of another number with this one in one instruction instead of
    /// three.
    fn doubled_bits(self) -> Self;
    /// Inverse of [`Scalar::doubled_bits`].
    fn halved_bits(self) -> Self;
    /// See [`Table::index`].
    #[cfg(feature = "builder")]
    fn index(table: &mut Table<Self>);
    /// See [`Table::check`].
    #[cfg(all(test, feature = "builder"))]
    fn table_check(table: &Table<Self>) -> u32;
    /// See [`Table::check_row`].
    fn check_row(table: &Table<Self>, row: usize, crc: u32) -> u32;
}

macro_rules! real {
    ($float:ident) => {
        impl Real for $float {
            const NAME: &'static str = stringify!($float);
            const ZERO: Self = 0.0;
            const MAX: Self = $float::MAX;

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
            #[cfg(feature = "builder")]
            const EPSILON: f64 = $float::EPSILON as f64;
            const MANTISSA_DIGITS: u32 = $float::MANTISSA_DIGITS;
            #[cfg(any(
                target_arch = "x86_64",
                target_arch = "aarch64",
                all(target_arch = "wasm32", target_feature = "simd128")
            ))]
            const ZERO_PIECES: &'static [Self; 2 * NUMBERS_PER_PIECE] =
                &[0.0; 2 * NUMBERS_PER_PIECE];
            #[cfg(feature = "builder")]
            const ZERO_TABLE: Table<Self> = Table::<$float>::ZERO;

            fn doubled_bits(self) -> Self {
                Self::from_bits(self.to_bits() << 1)
            }
            fn halved_bits(self) -> Self {
                Self::from_bits(self.to_bits() >> 1)
            }
            #[cfg(feature = "builder")]
            fn index(table: &mut Table<Self>) {
                table.index();
            }
            #[cfg(all(test, feature = "builder"))]
            fn table_check(table: &Table<Self>) -> u32 {
                table.check()
            }
            fn check_row(table: &Table<Self>, row: usize, crc: u32) -> u32 {
                table.check_row(row, crc)
            }
        }
    };
}

real!(f32);
real!(f64);
