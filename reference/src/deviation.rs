//! Deviation of forces from a reference.

/// Root mean square of `values`; 0 if empty.
///
/// ```
/// use dashpot_reference::deviation::root_mean_square;
/// assert_eq!(root_mean_square([3.0, -4.0]), 12.5_f64.sqrt());
/// ```
pub fn root_mean_square(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0_u64);
    for value in values {
        sum += value * value;
        count += 1;
    }
    (sum / count.max(1) as f64).sqrt()
}

/// Largest magnitude of `values`; 0 if empty.
pub fn largest_magnitude(values: impl IntoIterator<Item = f64>) -> f64 {
    values
        .into_iter()
        .fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

/// Differences `actual - expected`, sample by sample.
///
/// # Panics
/// The lengths differ.
pub fn errors(actual: &[f64], expected: &[f64]) -> impl Iterator<Item = f64> {
    assert_eq!(actual.len(), expected.len(), "one sample for each");
    actual.iter().zip(expected).map(|(a, e)| a - e)
}

/// NRMSE (1): root mean square of [`errors`] over root mean square of `expected`.
///
/// NaN if both are zero.
///
/// # Panics
/// The lengths differ.
///
/// ```
/// use dashpot_reference::deviation::nrmse;
/// assert_eq!(nrmse(&[101.0, -99.0], &[100.0, -100.0]), 0.01);
/// ```
pub fn nrmse(actual: &[f64], expected: &[f64]) -> f64 {
    nrmse_above(actual, expected, 0.0)
}

/// NRMSE (1) with a lower bound on the divisor: the root mean square of `expected` counts as at least `min_rms`.
///
/// The error of a damper with little force is thus compared with the force for which it is designed.
///
/// # Panics
/// The lengths differ.
pub fn nrmse_above(actual: &[f64], expected: &[f64], min_rms: f64) -> f64 {
    let rms = root_mean_square(expected.iter().copied());
    root_mean_square(errors(actual, expected)) / rms.max(min_rms)
}
