//! Mean comfort index of EN 12299.

use super::spectrum::{SpectrumError, Transform, check_signal};
use super::weighting::Weighting;

/// Length of a window, s.
const WINDOW_S: f64 = 5.0;

/// Returns the weighted root mean squares of consecutive 5 s windows of an acceleration, m/s^2, sampled at `rate_hz`.
///
/// The weighting is applied to the spectrum, without phase shift. To weight a signal sample by sample, use
/// [`WeightingFilter`](super::WeightingFilter).
///
/// # Errors
/// A signal shorter than a window, samples that are not finite, or a rate out of bounds.
pub fn weighted_rms(
    acceleration_m_per_s2: &[f64],
    rate_hz: f64,
    weighting: Weighting,
) -> Result<Vec<f64>, SpectrumError> {
    let length = check_signal(acceleration_m_per_s2, rate_hz, WINDOW_S)?;
    // The signal is weighted as a whole, so windows have no end effects.
    let count = acceleration_m_per_s2.len();
    let mut weighted = Vec::with_capacity(count / length);
    let whole = weigh(acceleration_m_per_s2, rate_hz, weighting);
    for window in whole.chunks_exact(length) {
        let square: f64 = window.iter().map(|value| value * value).sum();
        weighted.push((square / length as f64).sqrt());
    }
    Ok(weighted)
}

fn weigh(signal: &[f64], rate_hz: f64, weighting: Weighting) -> Vec<f64> {
    let count = signal.len();
    let mut transform = Transform::new(count);
    let lines = transform.lines(signal.iter().copied()).iter().enumerate();
    let mut spectrum: Vec<_> = lines
        .map(|(line, amplitude)| {
            let gain = weighting.gain(line as f64 * rate_hz / count as f64) / count as f64;
            amplitude * gain
        })
        .collect();
    // The first and, for an even count, the last line have no imaginary part.
    if let Some(first) = spectrum.first_mut() {
        first.im = 0.0;
    }
    if count.is_multiple_of(2)
        && let Some(last) = spectrum.last_mut()
    {
        last.im = 0.0;
    }
    let mut weighted = vec![0.0; count];
    let inverse = realfft::RealFftPlanner::<f64>::new().plan_fft_inverse(count);
    // Cannot fail: the lengths match the plan.
    let _ = inverse.process(&mut spectrum, &mut weighted);
    weighted
}

/// Returns the mean comfort `N_MV = 6 sqrt(x^2 + y^2 + z^2)` (EN 12299, standard method on the floor).
///
/// `x`, `y` and `z` are the 95th percentiles of the weighted root mean squares of the longitudinal, lateral and
/// vertical accelerations. The standard requires five minutes; a shorter ride gives an estimate.
///
/// # Errors
/// The same as for [`weighted_rms`].
pub fn mean_comfort(
    [along, lateral, vertical]: [&[f64]; 3],
    rate_hz: f64,
) -> Result<f64, SpectrumError> {
    Ok(mean_comfort_of_windows([
        &weighted_rms(along, rate_hz, Weighting::Horizontal)?,
        &weighted_rms(lateral, rate_hz, Weighting::Horizontal)?,
        &weighted_rms(vertical, rate_hz, Weighting::Vertical)?,
    ]))
}

/// Returns the [`mean_comfort`] from the weighted root mean squares of the windows, m/s^2. A direction without windows
/// counts as zero.
pub fn mean_comfort_of_windows(weighted_rms_m_per_s2: [&[f64]; 3]) -> f64 {
    let percentiles = weighted_rms_m_per_s2.map(|rms| percentile_95(rms.to_vec()));
    let square: f64 = percentiles.iter().map(|rms| rms * rms).sum();
    6.0 * square.sqrt()
}

/// 95th percentile, with linear interpolation between the sorted values.
fn percentile_95(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let position = 0.95 * (values.len().saturating_sub(1)) as f64;
    let (low, fraction) = (position.floor() as usize, position.fract());
    let at = |i: usize| values.get(i).or(values.last()).copied().unwrap_or(0.0);
    at(low) + fraction * (at(low + 1) - at(low))
}
