//! Dampers, motions and the second solver shared by the reference tests.
#![allow(dead_code)] // each test uses its part

pub mod dampers;
pub mod motions;
pub mod radau;

/// Root of the mean square difference over the root mean square of `expected`.
pub fn nrmse(actual: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(actual.len(), expected.len());
    let (mut error, mut scale) = (0.0, 0.0);
    for (a, e) in actual.iter().zip(expected) {
        error += (a - e).powi(2);
        scale += e * e;
    }
    (error / scale).sqrt()
}
