//! Cubic pieces from samples.

use crate::math::Real;
use crate::table::PIECES;

/// Cubics of `sample(compression, y)`.
///
/// Each piece goes through samples at both of its ends, so neighbours share a value.
pub(crate) fn cubics<T: Real>(sample: impl Fn(bool, f64) -> f64) -> [[T; 4]; 2 * PIECES] {
    let mut table = [[T::ZERO; 4]; 2 * PIECES];
    for (place, cubic) in table.iter_mut().enumerate() {
        let (compression, index) = (place >= PIECES, place % PIECES);
        let at = |z: f64| sample(compression, index as f64 + z);
        let fitted = if index == 0 {
            from_zero([0.0, 1.0 / 6.0, 1.0 / 3.0, 0.5].map(at))
        } else {
            interpolate([-0.5, -0.25, 0.25, 0.5].map(at))
        };
        *cubic = fitted.map(T::from_f64);
    }
    table
}

/// The cubic through values at z = -1/2, -1/4, 1/4, 1/2.
fn interpolate([a, b, c, d]: [f64; 4]) -> [f64; 4] {
    let (even_near, even_far) = (0.5 * (b + c), 0.5 * (a + d));
    let (odd_near, odd_far) = (2.0 * (c - b), d - a);
    // Even part c0 + c2 z^2, odd part over z c1 + c3 z^2, at z^2 = 1/16 and 1/4.
    let c2 = (even_far - even_near) / 0.1875;
    let c3 = (odd_far - odd_near) / 0.1875;
    [even_near - 0.0625 * c2, odd_near - 0.0625 * c3, c2, c3]
}

/// The cubic through values at z = 0, 1/6, 1/3, 1/2.
fn from_zero([a, b, c, d]: [f64; 4]) -> [f64; 4] {
    // (f - a)/z = c1 + c2 z + c3 z^2.
    let (p, q, r) = (6.0 * (b - a), 3.0 * (c - a), 2.0 * (d - a));
    let c3 = 18.0 * (p - 2.0 * q + r);
    let c2 = 6.0 * (q - p) - 0.5 * c3;
    [a, p - c2 / 6.0 - c3 / 36.0, c2, c3]
}

#[cfg(test)]
mod tests {
    use super::{from_zero, interpolate};

    #[test]
    fn cubics_come_back() {
        let cubic = |z: f64| 3.0 - 2.0 * z + 5.0 * z * z - 7.0 * z * z * z;
        let found = interpolate([-0.5, -0.25, 0.25, 0.5].map(cubic));
        for (found, expected) in found.iter().zip([3.0, -2.0, 5.0, -7.0]) {
            assert!((found - expected).abs() < 1e-12);
        }
        let found = from_zero([0.0, 1.0 / 6.0, 1.0 / 3.0, 0.5].map(cubic));
        for (found, expected) in found.iter().zip([3.0, -2.0, 5.0, -7.0]) {
            assert!((found - expected).abs() < 1e-12);
        }
    }
}
