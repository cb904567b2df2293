//! Numbers that may carry their derivatives: one text for the forces and for their tangents.

use std::array::from_fn;
use std::ops::{Add, Mul, Neg, Sub};

/// A real number, with or without derivatives.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// Whether the number carries derivatives.
    const DIFFERENTIATED: bool;

    /// The number without derivatives.
    fn value(self) -> f64;

    /// A number that depends on nothing.
    fn constant(value: f64) -> Self;

    /// The function of `terms` that has this `value` and the given derivative by each term.
    fn function<const N: usize>(value: f64, terms: [(f64, Self); N]) -> Self;

    /// `1 / self`.
    #[inline(always)]
    fn reciprocal(self) -> Self {
        let reciprocal = 1.0 / self.value();
        Self::function(reciprocal, [(-reciprocal * reciprocal, self)])
    }

    /// Square root of a positive number.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value().sqrt();
        Self::function(root, [(0.5 / root, self)])
    }

    /// The number limited to `limit` in magnitude; constant where it is limited.
    #[inline(always)]
    fn limited(self, limit: f64) -> Self {
        let value = self.value();
        let limited = value.max(-limit).min(limit);
        let slope = if limited == value { 1.0 } else { 0.0 };
        Self::function(limited, [(slope, self)])
    }
}

impl Number for f64 {
    const DIFFERENTIATED: bool = false;

    #[inline(always)]
    fn value(self) -> f64 {
        self
    }

    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn function<const N: usize>(value: f64, _: [(f64, Self); N]) -> Self {
        value
    }
}

/// Number of variables that a [`Dual`] can be differentiated by: three vectors of four.
pub const VARIABLES: usize = 12;

/// A number and its derivatives by [`VARIABLES`] variables (forward automatic differentiation). The derivatives are in
/// single precision: a tangent needs no more, and four of them take one instruction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual {
    value: f64,
    derivatives: [f32; VARIABLES],
}

impl Dual {
    /// The variable number `index` at `value`.
    pub fn variable(value: f64, index: usize) -> Self {
        Self {
            value,
            derivatives: from_fn(|i| if i == index { 1.0 } else { 0.0 }),
        }
    }

    /// The derivatives by the variables.
    pub fn derivatives(&self) -> &[f32; VARIABLES] {
        &self.derivatives
    }
}

impl Number for Dual {
    const DIFFERENTIATED: bool = true;

    #[inline(always)]
    fn value(self) -> f64 {
        self.value
    }

    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self {
            value,
            derivatives: [0.0; VARIABLES],
        }
    }

    #[inline(always)]
    fn function<const N: usize>(value: f64, terms: [(f64, Self); N]) -> Self {
        let mut derivatives = [0.0; VARIABLES];
        for (slope, term) in terms {
            let slope = slope as f32;
            for (sum, derivative) in derivatives.iter_mut().zip(term.derivatives) {
                *sum += slope * derivative;
            }
        }
        Self { value, derivatives }
    }
}

impl Add for Dual {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            derivatives: from_fn(|i| self.derivatives[i] + other.derivatives[i]),
        }
    }
}

impl Sub for Dual {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            derivatives: from_fn(|i| self.derivatives[i] - other.derivatives[i]),
        }
    }
}

impl Mul for Dual {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (here, there) = (self.value as f32, other.value as f32);
        Self {
            value: self.value * other.value,
            derivatives: from_fn(|i| self.derivatives[i] * there + here * other.derivatives[i]),
        }
    }
}

impl Neg for Dual {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl Add<f64> for Dual {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self {
            value: self.value + other,
            ..self
        }
    }
}

impl Sub<f64> for Dual {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        self + -other
    }
}

impl Mul<f64> for Dual {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        Self {
            value: self.value * other,
            derivatives: self.derivatives.map(|derivative| derivative * other as f32),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_closed_forms() {
        let (x, y) = (Dual::variable(0.7, 0), Dual::variable(-1.3, 3));
        // x^2 y / sqrt(x) - 2 x + 1/y
        let f = x * x * y * x.sqrt().reciprocal() - x * 2.0 + y.reciprocal();
        assert!((f.value() - (-1.3 * 0.7_f64.powf(1.5) - 1.4 - 1.0 / 1.3)).abs() < 1e-14);
        let by_x = -1.3 * 1.5 * 0.7_f64.sqrt() - 2.0;
        let by_y = 0.7_f64.powf(1.5) - 1.0 / 1.69;
        assert!((f64::from(f.derivatives()[0]) - by_x).abs() < 1e-6);
        assert!((f64::from(f.derivatives()[3]) - by_y).abs() < 1e-6);
        assert_eq!(f.derivatives()[1..3], [0.0, 0.0]);
        assert_eq!(x.limited(0.5), Dual::constant(0.5));
        assert_eq!((-x).limited(0.9), -x);
    }
}
