//! Complete elliptic integrals by the arithmetic-geometric mean (Abramowitz and Stegun 17.6).

use std::f64::consts::FRAC_PI_2;

/// Returns `K` and `E` for the complementary modulus `k1`, 0 < `k1` <= 1; for an ellipse, `k1` is the ratio of the
/// minor to the major semi-axis.
pub fn complete(k1: f64) -> (f64, f64) {
    let (mut a, mut b) = (1.0, k1);
    let mut sum = 0.5 * (1.0 - k1 * k1);
    let mut power = 0.5;
    for _ in 0..40 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        power *= 2.0;
        sum += power * c * c;
        if c.abs() < 1e-16 * a {
            break;
        }
    }
    let first = FRAC_PI_2 / a;
    (first, first * (1.0 - sum))
}
