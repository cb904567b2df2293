//! Numbers that carry their derivatives, so that a formula written once gives both.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// What a formula computes with: `f64`, or [`Dual`] for its derivatives too.
pub trait Real:
    Copy
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The number without its derivatives.
    fn value(self) -> f64;
    /// Square root; the number is positive.
    fn sqrt(self) -> Self;

    /// Magnitude.
    #[inline]
    fn abs(self) -> Self {
        self * Self::from(1f64.copysign(self.value()))
    }
}

impl Real for f64 {
    #[inline]
    fn value(self) -> f64 {
        self
    }

    #[inline]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline]
    fn abs(self) -> Self {
        f64::abs(self)
    }
}

/// A number and its derivatives by three variables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual {
    pub value: f64,
    pub by: [f64; 3],
}

impl Dual {
    /// Variable `index`.
    pub fn variable(value: f64, index: usize) -> Self {
        let mut by = [0.0; 3];
        by[index] = 1.0;
        Self { value, by }
    }

    /// `value`, with derivatives `p` times those of `a` plus `q` times those of `b`.
    fn chain(value: f64, a: &Self, p: f64, b: &Self, q: f64) -> Self {
        Self {
            value,
            by: std::array::from_fn(|k| p * a.by[k] + q * b.by[k]),
        }
    }
}

impl From<f64> for Dual {
    fn from(value: f64) -> Self {
        Self {
            value,
            by: [0.0; 3],
        }
    }
}

impl Real for Dual {
    fn value(self) -> f64 {
        self.value
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self::chain(root, &self, 0.5 / root, &self, 0.0)
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::chain(self.value + other.value, &self, 1.0, &other, 1.0)
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::chain(self.value - other.value, &self, 1.0, &other, -1.0)
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.value * other.value;
        Self::chain(product, &self, other.value, &other, self.value)
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        let per = 1.0 / other.value;
        Self::chain(quotient, &self, per, &other, -quotient * per)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self::from(0.0) - self
    }
}
