//! Dual numbers: forward automatic differentiation.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::number::Number;

/// A number with its derivatives with respect to `N` variables. The derivatives are in single precision, which suffices
/// for a tangent, and lets one instruction process four of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<const N: usize> {
    value: f64,
    derivatives: [f32; N],
}

impl<const N: usize> Dual<N> {
    /// The variable with index `index`, at `value`.
    pub fn variable(value: f64, index: usize) -> Self {
        Self {
            value,
            derivatives: from_fn(|i| if i == index { 1.0 } else { 0.0 }),
        }
    }

    /// A number with zero derivatives.
    #[inline(always)]
    pub fn constant(value: f64) -> Self {
        Self {
            value,
            derivatives: [0.0; N],
        }
    }

    /// The value without derivatives.
    #[inline(always)]
    pub fn value(&self) -> f64 {
        self.value
    }

    /// The derivative with respect to each variable.
    pub fn derivatives(&self) -> &[f32; N] {
        &self.derivatives
    }

    /// A function of `terms` by the chain rule; each term comes with the derivative of the function with respect to it.
    #[inline(always)]
    pub fn function<const TERMS: usize>(value: f64, terms: [(f64, Self); TERMS]) -> Self {
        let mut derivatives = [0.0; N];
        for (slope, term) in terms {
            let slope = slope as f32;
            for (sum, derivative) in derivatives.iter_mut().zip(term.derivatives) {
                *sum += slope * derivative;
            }
        }
        Self { value, derivatives }
    }
}

impl<const N: usize> Number for Dual<N> {
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self.value
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        let reciprocal = 1.0 / self.value;
        Self::function(reciprocal, [(-reciprocal * reciprocal, self)])
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self::function(root, [(0.5 / root, self)])
    }

    #[inline(always)]
    fn limited(self, limit: f64) -> Self {
        if self.value.abs() <= limit {
            self
        } else {
            Self::constant(limit.copysign(self.value))
        }
    }

    #[inline(always)]
    fn not_negative(self) -> Self {
        if self.value > 0.0 {
            self
        } else {
            Self::constant(0.0)
        }
    }

    #[inline(always)]
    fn sign(self) -> Self {
        Self::constant(1f64.copysign(self.value))
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            derivatives: from_fn(|i| self.derivatives[i] + other.derivatives[i]),
        }
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            derivatives: from_fn(|i| self.derivatives[i] - other.derivatives[i]),
        }
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let product = self.value * other.value;
        Self::function(product, [(other.value, self), (self.value, other)])
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let (quotient, per) = (self.value / other.value, 1.0 / other.value);
        Self::function(quotient, [(per, self), (-quotient * per, other)])
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self {
            value: self.value + other,
            ..self
        }
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        Self::function(self.value * other, [(other, self)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_agree_with_closed_forms() {
        let (x, y) = (Dual::<4>::variable(0.7, 0), Dual::variable(-1.3, 3));
        let f = x * x * y / x.sqrt() - x * 2.0 + y.reciprocal();
        assert!((f.value() - (-1.3 * 0.7_f64.powf(1.5) - 1.4 - 1.0 / 1.3)).abs() < 1e-14);
        let by_x = -1.3 * 1.5 * 0.7_f64.sqrt() - 2.0;
        let by_y = 0.7_f64.powf(1.5) - 1.0 / 1.69;
        assert!((f64::from(f.derivatives()[0]) - by_x).abs() < 1e-6);
        assert!((f64::from(f.derivatives()[3]) - by_y).abs() < 1e-6);
        assert_eq!(f.derivatives()[1..3], [0.0, 0.0]);
        assert_eq!(x.limited(0.5), Dual::constant(0.5));
        assert_eq!((-x).limited(0.9), -x);
        assert_eq!(y.not_negative(), Dual::constant(0.0));
        assert_eq!(x.not_negative(), x);
        assert_eq!([x.sign(), y.sign()], [1.0, -1.0].map(Dual::constant));
    }
}
