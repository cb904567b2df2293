//! A number for each of `L` dampers: the step is written once, for one damper and for several.
//!
//! Every lane is computed as a single number is, so the bits do not depend on `L`.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Real;

/// `L` numbers computed side by side.
pub trait Lanes<T: Real, const L: usize>:
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
    #[inline(always)]
    fn all(value: f64) -> Self {
        Self::new([T::from_f64(value); L])
    }
    /// The numbers as an array.
    fn array(self) -> [T; L];
    /// Four numbers of each lane as four times a number a lane.
    fn columns(rows: [[T; 4]; L]) -> [Self; 4];
    /// See [`Real::magnitude`].
    fn magnitudes(self) -> Self;
    /// The larger; of NaN `other`, which is none.
    fn at_least(self, other: Self) -> Self;
    /// The smaller; of NaN `other`, which is none.
    fn at_most(self, other: Self) -> Self;
    /// Whether every number is at most the other; not for NaN.
    fn all_within(self, other: Self) -> bool;
    /// Whether each number is not below the limit; true for NaN.
    fn reaches(self, limit: Self) -> [bool; L];
    /// 0 where `gate` is positive.
    fn unless_positive(self, gate: Self) -> Self;
    /// Negated where `direction` is below zero.
    fn with_sign_of(self, direction: Self) -> Self;
    /// See [`Real::bin`].
    fn bins(self) -> [usize; L];
    /// How many of the second and third of its knots each positive number is beyond.
    fn beyond(self, knots: [[T; 4]; L]) -> [usize; L];
    /// See [`Real::sign_bit`].
    fn sign_bits(self) -> [usize; L];
}

impl<T: Real> Lanes<T, 1> for T {
    #[inline(always)]
    fn new([lane]: [T; 1]) -> Self {
        lane
    }
    #[inline(always)]
    fn array(self) -> [T; 1] {
        [self]
    }
    #[inline(always)]
    fn columns([row]: [[T; 4]; 1]) -> [Self; 4] {
        row
    }
    #[inline(always)]
    fn magnitudes(self) -> Self {
        self.magnitude()
    }
    #[inline(always)]
    fn at_least(self, other: Self) -> Self {
        self.larger(other)
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        self.smaller(other)
    }
    #[inline(always)]
    fn all_within(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn reaches(self, limit: Self) -> [bool; 1] {
        let below = self < limit;
        [!below]
    }
    #[inline(always)]
    fn unless_positive(self, gate: Self) -> Self {
        if gate > T::ZERO { T::ZERO } else { self }
    }
    #[inline(always)]
    fn with_sign_of(self, direction: Self) -> Self {
        if direction >= T::ZERO { self } else { -self }
    }
    #[inline(always)]
    fn bins(self) -> [usize; 1] {
        [self.bin()]
    }
    #[inline(always)]
    fn beyond(self, [[_, next, second, _]]: [[T; 4]; 1]) -> [usize; 1] {
        [self.is_beyond(next) + self.is_beyond(second)]
    }
    #[inline(always)]
    fn sign_bits(self) -> [usize; 1] {
        [self.sign_bit()]
    }
}
