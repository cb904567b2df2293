//! Power spectral density by Welch's method.

use std::f64::consts::PI;

use super::spectrum::{SpectrumError, Transform, check_signal, mean, samples_of_window};

/// Estimates the one-sided power spectral density of a signal sample by sample (Welch 1967): Hann windows with 50 %
/// overlap, each without its mean. It stores a single window, however long the signal is.
///
/// ```
/// use dashpot_rail::indices::Welch;
/// let mut welch = Welch::new(200.0, 4.0)?;
/// for i in 0..4000 {
///     welch.add(3.0 * (2.0 * std::f64::consts::PI * 5.0 * f64::from(i) / 200.0).sin());
/// }
/// // 4000 samples are nine windows of 800.
/// assert_eq!(welch.windows(), 9);
/// let variance: f64 = welch.density().iter().map(|[_, density]| density * 0.25).sum();
/// assert!((variance - 4.5).abs() < 1e-3);
/// # Ok::<(), dashpot_rail::indices::SpectrumError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Welch {
    rate_hz: f64,
    hann: Vec<f64>,
    transform: Transform,
    window: Vec<f64>,
    sums: Vec<f64>,
    windows: u64,
}

impl Welch {
    /// Plans the estimate for a signal sampled at `rate_hz` in windows of `window_s`.
    ///
    /// # Errors
    /// A rate or a window out of bounds.
    pub fn new(rate_hz: f64, window_s: f64) -> Result<Self, SpectrumError> {
        let length = samples_of_window(rate_hz, window_s)?;
        let hann = (0..length).map(|i| 0.5 - 0.5 * libm::cos(2.0 * PI * i as f64 / length as f64));
        Ok(Self {
            rate_hz,
            hann: hann.collect(),
            transform: Transform::new(length),
            window: Vec::with_capacity(length),
            sums: vec![0.0; length / 2 + 1],
            windows: 0,
        })
    }

    /// Adds a sample.
    pub fn add(&mut self, value: f64) {
        self.window.push(value);
        let length = self.transform.samples();
        if self.window.len() < length {
            return;
        }
        let mean = mean(&self.window);
        let weighted = self.window.iter().zip(&self.hann);
        let weighted = weighted.map(|(value, weight)| (value - mean) * weight);
        for (sum, line) in self.sums.iter_mut().zip(self.transform.lines(weighted)) {
            *sum += line.norm_sqr();
        }
        self.windows += 1;
        self.window.drain(..length / 2);
    }

    /// Returns the number of complete windows.
    pub fn windows(&self) -> u64 {
        self.windows
    }

    /// Returns frequencies, Hz, and densities, in the unit of the signal squared per Hz, averaged over the windows.
    ///
    /// The integral is the variance of the signal. The densities are NaN before the first complete window.
    pub fn density(&self) -> Vec<[f64; 2]> {
        let length = self.transform.samples();
        let power: f64 = self.hann.iter().map(|weight| weight * weight).sum();
        let is_doubled = |line: usize| line > 0 && 2 * line != length;
        let density = |(line, sum): (usize, &f64)| {
            let sides = if is_doubled(line) { 2.0 } else { 1.0 };
            let density = sides * sum / (self.windows as f64 * self.rate_hz * power);
            [line as f64 * self.rate_hz / length as f64, density]
        };
        self.sums.iter().enumerate().map(density).collect()
    }
}

/// Returns the one-sided power spectral density of a whole signal, estimated by [`Welch`].
///
/// The pairs are frequency, Hz, and density, in the unit of the signal squared per Hz. The integral is the variance of
/// the signal.
///
/// # Errors
/// A signal shorter than a window, samples that are not finite, or a rate or window out of bounds.
///
/// ```
/// use dashpot_rail::indices::welch;
/// let sine = |i: usize| 3.0 * (2.0 * std::f64::consts::PI * 5.0 * i as f64 / 200.0).sin();
/// let signal: Vec<f64> = (0..4000).map(sine).collect();
/// let density = welch(&signal, 200.0, 4.0)?;
/// let [peak, _] = density.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
/// assert_eq!(peak, 5.0);
/// # Ok::<(), dashpot_rail::indices::SpectrumError>(())
/// ```
pub fn welch(signal: &[f64], rate_hz: f64, window_s: f64) -> Result<Vec<[f64; 2]>, SpectrumError> {
    check_signal(signal, rate_hz, window_s)?;
    let mut sums = Welch::new(rate_hz, window_s)?;
    for value in signal {
        sums.add(*value);
    }
    Ok(sums.density())
}
