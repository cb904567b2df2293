//! A number for each of `L` dampers: the step is written once, for one damper and for several.
//!
//! Every lane is computed as a single number is, so the bits do not depend on `L`.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::table::{BINS, bin_shift};

/// `L` numbers computed side by side.
pub trait Lanes<T, const L: usize>:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The numbers of an array.
    fn new(lanes: [T; L]) -> Self;
    /// The same number in every lane.
    fn splat(value: f64) -> Self;
    /// The numbers as an array.
    fn array(self) -> [T; L];
    /// Four numbers of each lane as four times a number a lane.
    fn transpose(rows: [[T; 4]; L]) -> [Self; 4];
    /// Magnitude.
    fn abs(self) -> Self;
    /// The larger of two numbers that are not zeros of opposite sign; of NaN `other`, which is not NaN.
    fn max(self, other: Self) -> Self;
    /// The smaller of two numbers that are not zeros of opposite sign; of NaN `other`, which is not NaN.
    fn min(self, other: Self) -> Self;
    /// Whether every magnitude is at most that whose [`doubled_bits`](crate::math::Scalar) are given; false for NaN.
    fn all_within(self, doubled_bits: [&T; L]) -> bool;
    /// Whether each number is not below the limit; true for NaN.
    fn reaches(self, limit: Self) -> [bool; L];
    /// 0 where `gate` is positive.
    fn unless_positive(self, gate: Self) -> Self;
    /// Negated where `direction` is below zero.
    fn with_sign_of(self, direction: Self) -> Self;
    /// Number of the bin of a table that each positive number lies in; of any other number a bin too.
    fn bins(self) -> [usize; L];
    /// How many of the second and third of its knots each positive number is beyond.
    fn knots_passed(self, knots: [[T; 4]; L]) -> [usize; L];
    /// 1 where the sign bit is set, else 0.
    fn sign_bits(self) -> [usize; L];
}

/// One number is one lane.
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
            // One instruction on either machine; they differ only for NaN and signed zeros.
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if cfg!(target_arch = "arm") {
                    $float::max(self, other)
                } else if self > other {
                    self
                } else {
                    other
                }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if cfg!(target_arch = "arm") {
                    $float::min(self, other)
                } else if self < other {
                    self
                } else {
                    other
                }
            }
            #[inline(always)]
            fn all_within(self, [doubled_bits]: [&$float; 1]) -> bool {
                // Without its sign; the bits of NaN are beyond those of every number. Read as bits, the bound is what
                // one instruction compares with the shifted bits.
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
                // One instruction, where an `if` is two on some.
                core::hint::select_unpredictable(direction >= 0.0, self, -self)
            }
            #[inline(always)]
            fn bins(self) -> [usize; 1] {
                [(self.to_bits() >> bin_shift($float::MANTISSA_DIGITS)) as usize % BINS]
            }
            #[inline(always)]
            fn knots_passed(self, [[_, next, second, _]]: [[$float; 4]; 1]) -> [usize; 1] {
                // Positive numbers are in the order of their bits.
                let passed = |knot: $float| {
                    (knot.to_bits().wrapping_sub(self.to_bits()) >> ($bits::BITS - 1)) as usize
                };
                [passed(next) + passed(second)]
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
    use crate::table::BINS;

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
