//! Cheap approximations, for displays only: nothing the force depends on may use them.

use micromath::F32Ext;

/// Square root of `value` within 6 %; 0 for 0 and below.
///
/// micromath halves the exponent in the number's bits, which is exact at even powers of 2 and largest
/// in error, 6.07 %, half-way between two.
pub(crate) fn sqrt(value: f32) -> f32 {
    if value > 0.0 {
        F32Ext::sqrt(value)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    /// Worst relative error against the exact root, over two octaves and at either end of a force.
    #[test]
    fn errs_by_six_percent_at_most() {
        let mut worst = 0.0_f32;
        for step in 0..40_000 {
            let value = 1.0 + 3.0 * step as f32 / 40_000.0;
            for scale in [1e-6, 1.0, 1e9] {
                let exact = libm::sqrtf(value * scale);
                worst = worst.max((super::sqrt(value * scale) - exact).abs() / exact);
            }
        }
        assert!(worst < 0.062, "worst error {worst}");
        assert!(
            worst > 0.01,
            "exact after all: {worst}; the documentation is wrong"
        );
        assert_eq!(super::sqrt(0.0), 0.0);
        assert_eq!(super::sqrt(-1.0), 0.0);
    }
}
