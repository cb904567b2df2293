//! The shape of an ellipse as a coordinate of tables.

use crate::math::number::Number;

/// Shape of an ellipse, `(a^2 - b^2)/(a^2 + 4 a b + b^2)`, from -1 (slender across) to 1 (long). Rows of tables are
/// equidistant in it.
#[inline(always)]
pub(super) fn shape<C: Number>(a: C, b: C) -> C {
    let squares = a * a + b * b;
    (a * a - b * b) / (squares + a * b * 4.0)
}

/// The ratio `a/b` of an ellipse of this shape.
pub(super) fn ratio(shape: f64) -> f64 {
    (2.0 * shape + (1.0 + 3.0 * shape * shape).sqrt()) / (1.0 - shape)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shape_has_its_ratio() {
        for a_over_b in [0.01, 0.3, 1.0, 2.5, 40.0] {
            assert!((ratio(shape(a_over_b, 1.0)) / a_over_b - 1.0).abs() < 1e-12);
        }
        assert_eq!(shape(2.0, 2.0), 0.0);
    }
}
