//! What formulas compute with: a number, both wheels side by side, or a number with derivatives.

use std::ops::{Add, Div, Mul, Neg, Sub};

use wide::f64x2;

/// A real number in several lanes, or with derivatives.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// A number that depends on nothing, the same in every lane.
    fn constant(value: f64) -> Self;

    /// The value in one lane.
    fn lane(self, lane: usize) -> f64;

    /// `1 / self`.
    fn reciprocal(self) -> Self;

    /// Square root of a number that is not negative.
    fn sqrt(self) -> Self;

    /// The number limited to `limit` in magnitude; constant where it is limited.
    fn limited(self, limit: f64) -> Self;

    /// The number, or zero where it is negative.
    fn not_negative(self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        1.0 / self
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn limited(self, limit: f64) -> Self {
        self.clamp(-limit, limit)
    }

    #[inline(always)]
    fn not_negative(self) -> Self {
        self.max(0.0)
    }
}

/// The left and the right wheel, one in each lane.
#[derive(Debug, Clone, Copy)]
pub struct Sides(f64x2);

impl From<[f64; 2]> for Sides {
    #[inline(always)]
    fn from(sides: [f64; 2]) -> Self {
        Self(f64x2::from(sides))
    }
}

impl From<Sides> for [f64; 2] {
    #[inline(always)]
    fn from(sides: Sides) -> Self {
        sides.0.to_array()
    }
}

impl Number for Sides {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self(f64x2::splat(value))
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0.as_array()[lane]
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        Self(f64x2::ONE / self.0)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn limited(self, limit: f64) -> Self {
        let limit = f64x2::splat(limit);
        Self(self.0.fast_max(-limit).fast_min(limit))
    }

    #[inline(always)]
    fn not_negative(self) -> Self {
        Self(self.0.fast_max(f64x2::ZERO))
    }
}

/// Operators of [`Sides`], by lane.
macro_rules! by_lane {
    ($($operator:ident $function:ident),*) => {$(
        impl $operator for Sides {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self($operator::$function(self.0, other.0))
            }
        }

        impl $operator<f64> for Sides {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: f64) -> Self {
                Self($operator::$function(self.0, f64x2::splat(other)))
            }
        }
    )*};
}
by_lane!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Sides {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_lane_has_its_own_number() {
        fn formula<T: Number>(x: T, y: T) -> T {
            x * x * y / x.sqrt() - x * 2.0 + y.reciprocal()
        }
        let sides = formula(Sides::from([0.7, 2.0]), Sides::from([-1.3, 0.5]));
        let alone = [formula(0.7, -1.3), formula(2.0, 0.5)];
        assert_eq!(<[f64; 2]>::from(sides), alone);
        let limited = Sides::from([-3.0, 0.2]).limited(1.0);
        assert_eq!(<[f64; 2]>::from(limited), [-1.0, 0.2]);
        let not_negative = Sides::from([-3.0, 0.2]).not_negative();
        assert_eq!(<[f64; 2]>::from(not_negative), [0.0, 0.2]);
    }
}
