//! How far forces are from those of a reference.

/// Root mean square of `values`; 0 where there are none.
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

/// Largest magnitude of `values`; 0 where there are none.
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
/// NaN where both roots are zero.
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

/// As [`nrmse`], with `least_rms` in place of a smaller root mean square of `expected`: where there is nearly
/// no force, an error is judged by the force that the damper is made for.
///
/// # Panics
/// The lengths differ.
pub fn nrmse_above(actual: &[f64], expected: &[f64], least_rms: f64) -> f64 {
    let rms = root_mean_square(expected.iter().copied());
    root_mean_square(errors(actual, expected)) / rms.max(least_rms)
}
