//! Mean comfort after EN 12299.

use super::spectrum::{SpectrumError, Transform, window_samples};
use super::weighting::Weighting;

/// Windows of the index, s.
const WINDOW_S: f64 = 5.0;

/// Weighted root mean squares of the windows of 5 s that follow one another, of an acceleration, m/s^2, sampled at `rate_hz`: weighted by
/// its spectrum, without a phase. [`WeightingFilter`](super::WeightingFilter) weighs a signal that is still coming.
///
/// # Errors
/// A signal shorter than a window, numbers that are not finite or out of bounds.
pub fn weighted_rms(
    acceleration_m_per_s2: &[f64],
    rate_hz: f64,
    weighting: Weighting,
) -> Result<Vec<f64>, SpectrumError> {
    let length = window_samples(acceleration_m_per_s2, rate_hz, WINDOW_S)?;
    // Weighted as a whole, so that windows have no ends of their own.
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
    // Neither has an imaginary part.
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
    // The lengths are the plan's own.
    let _ = inverse.process(&mut spectrum, &mut weighted);
    weighted
}

/// Mean comfort `N_MV = 6 sqrt(x^2 + y^2 + z^2)` of the 95th percentiles of the weighted root mean squares along, to the side and up and down
/// (EN 12299, standard method on the floor, which takes five minutes; of a shorter ride it is an estimate).
///
/// # Errors
/// As [`weighted_rms`].
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

/// [`mean_comfort`] of the weighted root mean squares of the windows, m/s^2; a direction without windows counts as zero.
pub fn mean_comfort_of_windows(weighted_rms_m_per_s2: [&[f64]; 3]) -> f64 {
    let percentiles = weighted_rms_m_per_s2.map(|rms| percentile_95(rms.to_vec()));
    let square: f64 = percentiles.iter().map(|rms| rms * rms).sum();
    6.0 * square.sqrt()
}

/// Of the sorted values, linear between them.
fn percentile_95(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let place = 0.95 * (values.len().saturating_sub(1)) as f64;
    let (low, share) = (place.floor() as usize, place.fract());
    let at = |i: usize| values.get(i).or(values.last()).copied().unwrap_or(0.0);
    at(low) + share * (at(low + 1) - at(low))
}
