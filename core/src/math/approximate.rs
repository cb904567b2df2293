//! Cheap approximations for displays only. The force must not depend on them.

use micromath::F32Ext;

/// Returns the square root of `value` within 6.1 %; 0 for 0 and below.
///
/// micromath halves the exponent in the bits of the number. This is exact at even powers of 2. The largest error, 6.07
/// %, is half-way between two of them.
pub(crate) fn sqrt(value: f32) -> f32 {
    if value > 0.0 {
        F32Ext::sqrt(value)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    /// Checks the largest relative error over two octaves at three magnitudes.
    #[test]
    fn error_is_at_most_six_percent() {
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
            "the root is exact ({worst}) and the documentation wrong"
        );
        assert_eq!(super::sqrt(0.0), 0.0);
        assert_eq!(super::sqrt(-1.0), 0.0);
    }
}
