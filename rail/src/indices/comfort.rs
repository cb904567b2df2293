//! Mean comfort after EN 12299.

use std::f64::consts::PI;

use super::spectrum::{SpectrumError, lines, window_samples};

/// Frequency weighting of an acceleration (EN 12299, ISO 2631-4): a band limit and a weighting of second order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weighting {
    /// `Wb`: vertical.
    Vertical,
    /// `Wd`: to the side and along.
    Horizontal,
}

/// Windows of the index, s.
const WINDOW_S: f64 = 5.0;

/// Corners of the band limit, Hz, and its quality.
const BAND_HZ: [f64; 2] = [0.4, 100.0];
const BAND_QUALITY: f64 = std::f64::consts::FRAC_1_SQRT_2;

type Complex = [f64; 2];

fn product(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn ratio(a: Complex, b: Complex) -> Complex {
    let square = b[0] * b[0] + b[1] * b[1];
    let over = product(a, [b[0], -b[1]]);
    [over[0] / square, over[1] / square]
}

/// `s^2 + w/q s + w^2` at `s = i omega`, with `w = 2 pi f`.
fn quadratic(omega: f64, corner_hz: f64, quality: f64) -> Complex {
    let w = 2.0 * PI * corner_hz;
    [w * w - omega * omega, w / quality * omega]
}

impl Weighting {
    /// Magnitude of the weighting at a frequency.
    ///
    /// ```
    /// use dashpot_rail::indices::Weighting;
    /// assert!((Weighting::Vertical.gain(8.0) - 1.05593).abs() < 1e-4);
    /// assert!((Weighting::Horizontal.gain(1.0) - 1.01102).abs() < 1e-4);
    /// ```
    pub fn gain(self, frequency_hz: f64) -> f64 {
        let omega = 2.0 * PI * frequency_hz;
        let [low, high] = BAND_HZ;
        let w_high = 2.0 * PI * high;
        let high_pass = ratio([-omega * omega, 0.0], quadratic(omega, low, BAND_QUALITY));
        let low_pass = ratio([w_high * w_high, 0.0], quadratic(omega, high, BAND_QUALITY));
        // (s + w3)/w3 over the quadratic at f4; for the vertical one a step at f5 and f6 beside.
        let (f3, f4, q4) = match self {
            Self::Vertical => (16.0, 16.0, 0.63),
            Self::Horizontal => (2.0, 2.0, 0.63),
        };
        let (w3, w4) = (2.0 * PI * f3, 2.0 * PI * f4);
        let transition = ratio([w4 * w4, w4 * w4 * omega / w3], quadratic(omega, f4, q4));
        let step = match self {
            Self::Vertical => {
                const FACTOR: f64 = 0.4;
                let (f5, q5, f6, q6) = (2.5, 0.8, 4.0, 0.8);
                let [re, im] = ratio(quadratic(omega, f5, q5), quadratic(omega, f6, q6));
                let scale = FACTOR * (f6 / f5) * (f6 / f5);
                [scale * re, scale * im]
            }
            Self::Horizontal => [1.0, 0.0],
        };
        let [re, im] = product(product(high_pass, low_pass), product(transition, step));
        re.hypot(im)
    }
}

/// Weighted root mean squares of the windows of 5 s that follow one another, of an acceleration, m/s^2, sampled at `rate_hz`.
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
    let mut spectrum: Vec<_> = lines(signal)
        .into_iter()
        .enumerate()
        .map(|(line, [re, im])| {
            let gain = weighting.gain(line as f64 * rate_hz / count as f64) / count as f64;
            realfft::num_complex::Complex::new(gain * re, gain * im)
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
    let mut sum = 0.0;
    for (signal, weighting) in [
        (along, Weighting::Horizontal),
        (lateral, Weighting::Horizontal),
        (vertical, Weighting::Vertical),
    ] {
        let percentile = percentile_95(weighted_rms(signal, rate_hz, weighting)?);
        sum += percentile * percentile;
    }
    Ok(6.0 * sum.sqrt())
}

/// Of the sorted values, linear between them.
fn percentile_95(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let place = 0.95 * (values.len().saturating_sub(1)) as f64;
    let (low, share) = (place.floor() as usize, place.fract());
    let at = |i: usize| values.get(i).or(values.last()).copied().unwrap_or(0.0);
    at(low) + share * (at(low + 1) - at(low))
}
