//! Numbers of `L` dampers side by side. The step is written once, for one damper and for several.
//!
//! Each lane goes through the same operations as a single number, so the bits do not depend on `L`.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::bins::{BINS, bin_shift};

/// `L` numbers side by side.
pub(crate) trait Lanes<T, const L: usize>:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Returns the lanes of an array.
    fn new(lanes: [T; L]) -> Self;
    /// Returns lanes that all have this value.
    fn splat(value: f64) -> Self;
    /// Returns the lanes as an array.
    fn array(self) -> [T; L];
    /// Collects the four numbers of each lane: result `i` contains number `i` of every lane.
    fn transpose(rows: [[T; 4]; L]) -> [Self; 4];
    /// Magnitude.
    fn abs(self) -> Self;
    /// Lane-wise maximum; `other` if `self` is NaN. `other` must not be NaN, and the two must not be zeros of opposite
    /// sign.
    fn max(self, other: Self) -> Self;
    /// Lane-wise minimum; `other` if `self` is NaN. `other` must not be NaN, and the two must not be zeros of opposite
    /// sign.
    fn min(self, other: Self) -> Self;
    /// True if no magnitude exceeds its bound, given by its [`doubled_bits`](crate::real::Scalar). False for NaN.
    fn all_within(self, doubled_bits: [&T; L]) -> bool;
    /// True for each lane that is not below the limit. True for NaN.
    fn reaches(self, limit: Self) -> [bool; L];
    /// Returns zero in lanes with a positive `gate`, else the unchanged number.
    fn unless_positive(self, gate: Self) -> Self;
    /// Returns the negated number in lanes with a negative `direction`, else the unchanged number.
    fn with_sign_of(self, direction: Self) -> Self;
    /// Index of the table's bin for each positive number; a valid index for any other number.
    fn bins(self) -> [usize; L];
    /// True for each lane whose positive number exceeds the positive limit; any result for other numbers.
    fn exceeds(self, limit: Self) -> [bool; L];
    /// Sign bit of each lane, 0 or 1.
    fn sign_bits(self) -> [usize; L];
}

/// Implements a single number as one lane.
macro_rules! single_lane {
    ($float:ident, $bits:ident) => {
        impl Lanes<$float, 1> for $float {
            #[inline(always)]
            fn new([lane]: [$float; 1]) -> Self {
                lane
            }
            #[inline(always)]
            fn splat(value: f64) -> Self {
                value as Self
            }
            #[inline(always)]
            fn array(self) -> [$float; 1] {
                [self]
            }
            #[inline(always)]
            fn transpose([row]: [[$float; 4]; 1]) -> [Self; 4] {
                row
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            // Each variant takes the fewest instructions on its processors. The variants differ only for NaN and signed
            // zeros.
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if cfg!(has_maximum) {
                    $float::max(self, other)
                } else if self > other {
                    self
                } else {
                    other
                }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if cfg!(has_maximum) {
                    $float::min(self, other)
                } else if self < other {
                    self
                } else {
                    other
                }
            }
            #[inline(always)]
            fn all_within(self, [doubled_bits]: [&$float; 1]) -> bool {
                // Shifting left drops the sign bit. The shifted bits of NaN exceed those of any bound. One instruction
                // compares the shifted bits with the bits of the bound.
                let bound: &$bits = zerocopy::transmute_ref!(doubled_bits);
                *bound >= self.to_bits() << 1
            }
            #[inline(always)]
            fn reaches(self, limit: Self) -> [bool; 1] {
                let below = self < limit;
                [!below]
            }
            #[inline(always)]
            fn unless_positive(self, gate: Self) -> Self {
                if gate > 0.0 { 0.0 } else { self }
            }
            #[inline(always)]
            fn with_sign_of(self, direction: Self) -> Self {
                // One instruction; an `if` takes two on some processors.
                core::hint::select_unpredictable(direction >= 0.0, self, -self)
            }
            #[inline(always)]
            fn bins(self) -> [usize; 1] {
                [(self.to_bits() >> bin_shift($float::MANTISSA_DIGITS)) as usize % BINS]
            }
            #[inline(always)]
            fn exceeds(self, limit: Self) -> [bool; 1] {
                // The bits of positive numbers are in the same order as the numbers.
                [self.to_bits() > limit.to_bits()]
            }
            #[inline(always)]
            fn sign_bits(self) -> [usize; 1] {
                [(self.to_bits() >> ($bits::BITS - 1)) as usize]
            }
        }
    };
}

single_lane!(f32, u32);
single_lane!(f64, u64);

#[cfg(test)]
mod tests {
    use super::Lanes;
    use crate::bins::BINS;

    #[test]
    fn a_doubling_has_128_bins() {
        let bins =
            [1.0, 1.0078, 1.0079, 1.999, 2.0, 4.0_f64].map(|x| [x.bins(), (x as f32).bins()]);
        let one = [1.0_f64.bins(), 1.0_f32.bins()];
        let expected = [0, 0, 1, 127, 128, 256];
        for (bins, expected) in bins.iter().zip(expected) {
            for ([bin], [one]) in bins.iter().zip(one) {
                assert_eq!((bin + BINS - one) % BINS, expected);
            }
        }
        let strange = [f32::NAN, -1.0, 1e30].map(Lanes::bins);
        assert!(strange.iter().all(|[bin]| *bin < BINS));
    }
}
