//! A group of eight dampers, in the vector instructions of a desktop processor.

use core::ops::{Add, Div, Mul, Neg, Sub};

use wide::bytemuck::cast;
use wide::{f32x4, f64x4, u32x4, u64x4};

use super::Lanes;
use crate::table::{BINS, bin_shift};

/// Number of lanes of a group.
pub(crate) const GROUP: usize = 8;

/// Numbers of a group in single precision.
pub type F32 = Pair<f32x4>;
/// Numbers of a group in double precision.
pub type F64 = Pair<f64x4>;

/// Two vectors. The processor works on one while the other waits for a result.
#[derive(Clone, Copy)]
pub struct Pair<V>(V, V);

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

/// Joins two halves to an array.
#[inline(always)]
fn whole<T: Copy>([[a, b, c, d], [e, f, g, h]]: [[T; 4]; 2]) -> [T; GROUP] {
    [a, b, c, d, e, f, g, h]
}

macro_rules! group {
    ($float:ident, $vector:ident, $bits:ident) => {
        impl Pair<$vector> {
            #[inline(always)]
            fn map(self, f: impl Fn($vector) -> $vector) -> Self {
                Self(f(self.0), f(self.1))
            }

            #[inline(always)]
            fn zip(self, other: Self, f: impl Fn($vector, $vector) -> $vector) -> Self {
                Self(f(self.0, other.0), f(self.1, other.1))
            }
        }

        impl Lanes<$float, GROUP> for Pair<$vector> {
            #[inline(always)]
            fn new(lanes: [$float; GROUP]) -> Self {
                let [low, high] = halves(lanes).map($vector::new);
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
                let transpose = |rows: [[$float; 4]; 4]| $vector::transpose(rows.map($vector::new));
                let [low, high] = halves(rows).map(transpose);
                core::array::from_fn(|column| Self(low[column], high[column]))
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.map($vector::abs)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // One instruction on x86-64. On other processors `fast_max` would return NaN for NaN.
                if cfg!(target_arch = "x86_64") {
                    self.zip(other, $vector::fast_max)
                } else {
                    self.zip(other, |v, other| v.simd_gt(other).select(v, other))
                }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if cfg!(target_arch = "x86_64") {
                    self.zip(other, $vector::fast_min)
                } else {
                    self.zip(other, |v, other| v.simd_lt(other).select(v, other))
                }
            }
            #[inline(always)]
            fn all_within(self, doubled_bits: [&$float; GROUP]) -> bool {
                let bounds = doubled_bits.map(|bound| $float::from_bits(bound.to_bits() >> 1));
                let within = self.abs().zip(Self::new(bounds), $vector::simd_le);
                (within.0 & within.1).all()
            }
            #[inline(always)]
            fn reaches(self, limit: Self) -> [bool; GROUP] {
                let below = self.zip(limit, $vector::simd_lt);
                let bits = below.0.to_bitmask() | below.1.to_bitmask() << 4;
                core::array::from_fn(|lane| bits >> lane & 1 == 0)
            }
            #[inline(always)]
            fn unless_positive(self, gate: Self) -> Self {
                self.zip(gate, |v, gate| {
                    gate.simd_gt($vector::ZERO).select($vector::ZERO, v)
                })
            }
            #[inline(always)]
            fn with_sign_of(self, direction: Self) -> Self {
                self.zip(direction, |v, direction| {
                    direction.simd_ge($vector::ZERO).select(v, -v)
                })
            }
            #[inline(always)]
            fn bins(self) -> [usize; GROUP] {
                let bins = |reach: $vector| {
                    let bits: $bits = cast(reach);
                    let bins = bits >> bin_shift($float::MANTISSA_DIGITS);
                    (bins & $bits::splat((BINS - 1) as _)).to_array()
                };
                whole([bins(self.0), bins(self.1)]).map(|bin| bin as usize)
            }
            #[inline(always)]
            fn knots_passed(self, knots: [[$float; 4]; GROUP]) -> [usize; GROUP] {
                let [_, next, second, _] = Self::transpose(knots);
                let [next, second] = [next, second].map(|knot| {
                    let passed = self.zip(knot, $vector::simd_gt);
                    passed.0.to_bitmask() | passed.1.to_bitmask() << 4
                });
                core::array::from_fn(|lane| {
                    (next >> lane & 1) as usize + (second >> lane & 1) as usize
                })
            }
            #[inline(always)]
            fn sign_bits(self) -> [usize; GROUP] {
                let bits = self.0.to_bitmask() | self.1.to_bitmask() << 4;
                core::array::from_fn(|lane| (bits >> lane & 1) as usize)
            }
        }
    };
}

group!(f32, f32x4, u32x4);
group!(f64, f64x4, u64x4);
