//! A number for each of `L` dampers: the step is written once, for one damper and for several.
//!
//! Every lane is computed as a single number is, so the bits do not depend on `L`; the compiler uses
//! vector instructions where there are any.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Real;

/// One number a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lanes<T, const L: usize>(pub(crate) [T; L]);

impl<T: Real, const L: usize> Lanes<T, L> {
    /// The same number in every lane.
    #[inline(always)]
    pub(crate) fn all(value: f64) -> Self {
        Self([T::from_f64(value); L])
    }

    /// `f` of each lane.
    #[inline(always)]
    pub(crate) fn map(mut self, f: impl Fn(T) -> T) -> Self {
        for lane in &mut self.0 {
            *lane = f(*lane);
        }
        self
    }

    /// `f` of each lane of two.
    #[inline(always)]
    pub(crate) fn zip(mut self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        for (lane, other) in self.0.iter_mut().zip(other.0) {
            *lane = f(*lane, other);
        }
        self
    }

    /// See [`Real::magnitude`].
    #[inline(always)]
    pub(crate) fn magnitude(self) -> Self {
        self.map(T::magnitude)
    }

    /// See [`Real::square_root`].
    #[inline(always)]
    pub(crate) fn square_root(self) -> Self {
        self.map(T::square_root)
    }

    /// Not below a constant.
    #[inline(always)]
    pub(crate) fn at_least(self, least: f64) -> Self {
        self.map(|lane| lane.larger(T::from_f64(least)))
    }

    /// Not above a constant.
    #[inline(always)]
    pub(crate) fn at_most(self, most: f64) -> Self {
        self.map(|lane| lane.smaller(T::from_f64(most)))
    }

    /// See [`Real::smaller`].
    #[inline(always)]
    pub(crate) fn smaller(self, other: Self) -> Self {
        self.zip(other, T::smaller)
    }
}

impl<T: Real, const L: usize> Add for Lanes<T, L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<T: Real, const L: usize> Sub for Lanes<T, L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<T: Real, const L: usize> Mul for Lanes<T, L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<T: Real, const L: usize> Div for Lanes<T, L> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl<T: Real, const L: usize> Neg for Lanes<T, L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}
