//! A group of eight dampers, computed with the vector instructions of a desktop processor.

use core::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x4, f64x4, i32x4, u32x4};

use super::Lanes;
use crate::bins::{BINS, bin_shift};

/// Number of lanes of a group.
pub(crate) const GROUP: usize = 8;

/// Vector instructions that every processor of the architecture has.
#[cfg(target_arch = "x86_64")]
type Baseline = fearless_simd::x86::Sse2;
/// Vector instructions that every processor of the architecture has.
#[cfg(target_arch = "aarch64")]
type Baseline = fearless_simd::aarch64::Neon;

/// Numbers of a group in single precision.
pub(crate) type F32 = Pair<f32x4<Baseline>>;
/// Numbers of a group in double precision.
pub(crate) type F64 = Pair<f64x4<Baseline>>;

/// Returns the token of [`Baseline`]; the compiler removes the check for these instructions.
#[inline(always)]
fn baseline() -> Baseline {
    #[cfg(target_arch = "x86_64")]
    let found = Level::baseline().as_sse2();
    #[cfg(target_arch = "aarch64")]
    let found = Level::baseline().as_neon();
    found.expect("the baseline of the processor")
}

/// Two vectors. The processor works on one while the other waits for a result.
#[derive(Clone, Copy)]
pub(crate) struct Pair<V>(V, V);

macro_rules! operator {
    ($operator:ident, $method:ident) => {
        impl<V: $operator<Output = V>> $operator for Pair<V> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<V: Neg<Output = V>> Neg for Pair<V> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

/// Splits an array into two halves.
#[inline(always)]
fn halves<T: Copy>([a, b, c, d, e, f, g, h]: [T; GROUP]) -> [[T; 4]; 2] {
    [[a, b, c, d], [e, f, g, h]]
}

/// Joins two halves into an array.
#[inline(always)]
fn whole<T: Copy>([[a, b, c, d], [e, f, g, h]]: [[T; 4]; 2]) -> [T; GROUP] {
    [a, b, c, d, e, f, g, h]
}

macro_rules! group {
    ($float:ident, $vector:ident, $bins:expr, $signs:expr) => {
        impl Pair<$vector<Baseline>> {
            #[inline(always)]
            fn map(self, f: impl Fn($vector<Baseline>) -> $vector<Baseline>) -> Self {
                Self(f(self.0), f(self.1))
            }
            #[inline(always)]
            fn zip(
                self,
                other: Self,
                f: impl Fn($vector<Baseline>, $vector<Baseline>) -> $vector<Baseline>,
            ) -> Self {
                Self(f(self.0, other.0), f(self.1, other.1))
            }
            #[inline(always)]
            fn bits(
                self,
                other: Self,
                f: impl Fn(
                    $vector<Baseline>,
                    $vector<Baseline>,
                ) -> <$vector<Baseline> as SimdBase<Baseline>>::Mask,
            ) -> u64 {
                f(self.0, other.0).to_bitmask() | f(self.1, other.1).to_bitmask() << 4
            }
        }

        impl Lanes<$float, GROUP> for Pair<$vector<Baseline>> {
            #[inline(always)]
            fn new(lanes: [$float; GROUP]) -> Self {
                let [low, high] = halves(lanes).map(|half| $vector::load_array(baseline(), half));
                Self(low, high)
            }
            #[inline(always)]
            fn splat(value: f64) -> Self {
                Self::new([value as $float; GROUP])
            }
            #[inline(always)]
            fn array(self) -> [$float; GROUP] {
                whole([self.0.to_array(), self.1.to_array()])
            }
            #[inline(always)]
            fn transpose(rows: [[$float; 4]; GROUP]) -> [Self; 4] {
                let transpose = |rows: [[$float; 4]; 4]| {
                    let [a, b, c, d] = rows.map(|row| $vector::load_array(baseline(), row));
                    let (even, odd) = (a.interleave(c), b.interleave(d));
                    let (first, second) = even.0.interleave(odd.0);
                    let (third, last) = even.1.interleave(odd.1);
                    [first, second, third, last]
                };
                let [low, high] = halves(rows).map(transpose);
                core::array::from_fn(|column| Self(low[column], high[column]))
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.map(|v| v.abs())
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // On x86-64, `max` is one instruction. On other processors it would return NaN if a number is NaN.
                if cfg!(target_arch = "x86_64") {
                    self.zip(other, |v, other| v.max(other))
                } else {
                    self.zip(other, |v, other| v.simd_gt(other).select(v, other))
                }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if cfg!(target_arch = "x86_64") {
                    self.zip(other, |v, other| v.min(other))
                } else {
                    self.zip(other, |v, other| v.simd_lt(other).select(v, other))
                }
            }
            #[inline(always)]
            fn all_within(self, doubled_bits: [&$float; GROUP]) -> bool {
                let bounds = doubled_bits.map(|bound| $float::from_bits(bound.to_bits() >> 1));
                let bounds = Self::new(bounds);
                let within = self.abs();
                (within.0.simd_le(bounds.0) & within.1.simd_le(bounds.1)).all_true()
            }
            #[inline(always)]
            fn reaches(self, limit: Self) -> [bool; GROUP] {
                let bits = self.bits(limit, |v, limit| v.simd_lt(limit));
                core::array::from_fn(|lane| bits >> lane & 1 == 0)
            }
            #[inline(always)]
            fn unless_positive(self, gate: Self) -> Self {
                self.zip(gate, |v, gate| {
                    let zero = $vector::splat(baseline(), 0.0);
                    gate.simd_gt(zero).select(zero, v)
                })
            }
            #[inline(always)]
            fn with_sign_of(self, direction: Self) -> Self {
                self.zip(direction, |v, direction| {
                    direction.simd_ge(0.0).select(v, -v)
                })
            }
            #[inline(always)]
            fn bins(self) -> [usize; GROUP] {
                whole([$bins(self.0), $bins(self.1)])
            }
            #[inline(always)]
            fn knots_passed(self, knots: [[$float; 4]; GROUP]) -> [usize; GROUP] {
                let [_, next, second, _] = Self::transpose(knots);
                let [next, second] =
                    [next, second].map(|knot| self.bits(knot, |v, knot| v.simd_gt(knot)));
                core::array::from_fn(|lane| {
                    (next >> lane & 1) as usize + (second >> lane & 1) as usize
                })
            }
            #[inline(always)]
            fn sign_bits(self) -> [usize; GROUP] {
                whole([$signs(self.0), $signs(self.1)])
            }
        }
    };
}

/// Indices of the bins; see [`Lanes::bins`].
#[inline(always)]
fn bins_f32(reach: f32x4<Baseline>) -> [usize; 4] {
    let bits: u32x4<Baseline> = reach.bitcast();
    let bins = (bits >> bin_shift(f32::MANTISSA_DIGITS)) & (BINS - 1) as u32;
    bins.to_array().map(|bin| bin as usize)
}

/// Indices of the bins; see [`Lanes::bins`].
#[inline(always)]
fn bins_f64(reach: f64x4<Baseline>) -> [usize; 4] {
    reach
        .to_array()
        .map(|x| (x.to_bits() >> bin_shift(f64::MANTISSA_DIGITS)) as usize % BINS)
}

/// Sign bits; see [`Lanes::sign_bits`].
#[inline(always)]
fn signs_f32(v: f32x4<Baseline>) -> [usize; 4] {
    let bits: i32x4<Baseline> = v.bitcast();
    let mask = bits.simd_lt(0).to_bitmask();
    core::array::from_fn(|lane| (mask >> lane & 1) as usize)
}

/// Sign bits; see [`Lanes::sign_bits`].
#[inline(always)]
fn signs_f64(v: f64x4<Baseline>) -> [usize; 4] {
    v.to_array().map(|x| (x.to_bits() >> 63) as usize)
}

group!(f32, f32x4, bins_f32, signs_f32);
group!(f64, f64x4, bins_f64, signs_f64);

#[cfg(test)]
mod tests {
    use super::GROUP;
    use crate::math::Lanes;
    use crate::real::Real;

    /// Compares the results of a group with those of each of its numbers alone.
    fn lanes_equal_numbers<T: Real>() {
        let any = [1e-3, -2.5e-4, 0.0, 7.75e-3, f64::NAN, -1.0, 3.1e-2, 1e30].map(T::from_f64);
        let group = T::Group::new(any);
        assert_eq!(group.bins(), any.map(|x| x.bins()[0]));
        assert_eq!(group.sign_bits(), any.map(|x| x.sign_bits()[0]));
        let limit = T::from_f64(1e-3);
        let limits = T::Group::new([limit; GROUP]);
        assert_eq!(group.reaches(limits), any.map(|x| x.reaches(limit)[0]));

        let positive = [1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5].map(T::from_f64);
        let knots = [1.0, 2.0, 3.0, 0.0].map(T::from_f64);
        let passed = T::Group::new(positive).knots_passed([knots; GROUP]);
        assert_eq!(passed, [0, 0, 0, 1, 1, 2, 2, 2]);
        assert_eq!(passed, positive.map(|x| x.knots_passed([knots])[0]));
    }

    #[test]
    fn lanes_of_a_group_equal_single_numbers() {
        lanes_equal_numbers::<f32>();
        lanes_equal_numbers::<f64>();
    }
}
