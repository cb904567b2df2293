//! Sperling's ride index.

use realfft::num_complex::Complex;

use super::band::Band;
use super::spectrum::{SpectrumError, check_signal, mean, samples_of_window};

/// Direction of a ride acceleration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RideDirection {
    /// Across the track.
    Lateral,
    /// Up and down.
    Vertical,
}

/// Frequency band of Sperling's index, including both ends, Hz.
pub const SPERLING_BAND_HZ: [f64; 2] = [0.5, 40.0];

impl RideDirection {
    /// Returns the correction `F(f)` for human sensitivity: a rising part, a falling part, and 1 at higher frequencies
    /// (GB/T 5599).
    pub fn correction(self, frequency_hz: f64) -> f64 {
        let f = frequency_hz;
        let (rising, falling, edges) = match self {
            Self::Vertical => (0.325, 400.0, [5.9, 20.0]),
            Self::Lateral => (0.8, 650.0, [5.4, 26.0]),
        };
        if f < edges[0] {
            rising * f * f
        } else if f < edges[1] {
            falling / (f * f)
        } else {
            1.0
        }
    }
}

/// Computes Sperling's ride index of windows of one length.
///
/// ```
/// use dashpot_rail::indices::{RideDirection, Sperling};
/// let sine = |i: usize| 0.5 * (2.0 * std::f64::consts::PI * 2.0 * i as f64 / 500.0).sin();
/// let acceleration: Vec<f64> = (0..2500).map(sine).collect();
/// let mut ride = Sperling::new(500.0, 5.0)?;
/// assert!((ride.of_window(&acceleration, RideDirection::Vertical) - 2.7775).abs() < 1e-4);
/// # Ok::<(), dashpot_rail::indices::SpectrumError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Sperling {
    band: Band,
    /// A window without its mean.
    about_mean: Vec<f64>,
    /// Weight of the cubed magnitude of each line of the band, lateral.
    lateral: Vec<f64>,
    /// Weight of the cubed magnitude of each line of the band, vertical.
    vertical: Vec<f64>,
}

impl Sperling {
    /// Plans the index of accelerations sampled at `rate_hz` in windows of `window_s`.
    ///
    /// # Errors
    /// A rate or a window out of bounds.
    pub fn new(rate_hz: f64, window_s: f64) -> Result<Self, SpectrumError> {
        let length = samples_of_window(rate_hz, window_s)?;
        let frequency_hz = |line: usize| line as f64 * rate_hz / length as f64;
        let is_in_band = |line: &usize| {
            (SPERLING_BAND_HZ[0]..=SPERLING_BAND_HZ[1]).contains(&frequency_hz(*line))
        };
        let lines: Vec<usize> = (1..=length / 2).filter(is_in_band).collect();
        let first = lines.first().copied().unwrap_or(0);
        // One-sided spectrum: the amplitude is 2/length times the magnitude of a line.
        let scale = (2.0 / length as f64).powi(3);
        let weights = |direction: RideDirection| {
            let weight = |line: &usize| {
                let f = frequency_hz(*line);
                scale * direction.correction(f) / f
            };
            lines.iter().map(weight).collect()
        };
        Ok(Self {
            band: Band::new(length, first..first + lines.len()),
            about_mean: Vec::with_capacity(length),
            lateral: weights(RideDirection::Lateral),
            vertical: weights(RideDirection::Vertical),
        })
    }

    /// Returns the number of samples of a window.
    pub fn samples(&self) -> usize {
        self.band.samples()
    }

    /// Returns the index of a window of [`samples`](Self::samples) accelerations, m/s^2, without their mean.
    pub fn of_window(&mut self, acceleration_m_per_s2: &[f64], direction: RideDirection) -> f64 {
        let mean = mean(acceleration_m_per_s2);
        let about_mean = acceleration_m_per_s2.iter().map(|value| value - mean);
        self.about_mean.clear();
        self.about_mean.extend(about_mean);
        self.about_mean.resize(self.band.samples(), 0.0);
        let lines = self.band.lines(&self.about_mean);
        let weights = match direction {
            RideDirection::Lateral => &self.lateral,
            RideDirection::Vertical => &self.vertical,
        };
        let contribution = |(line, weight): (&Complex<f64>, &f64)| {
            let square = line.norm_sqr();
            weight * square * square.sqrt()
        };
        let sum: f64 = lines.iter().zip(weights).map(contribution).sum();
        3.57 * libm::pow(sum, 0.1)
    }
}

/// Returns Sperling's ride index `W` of an acceleration, m/s^2, sampled at `rate_hz`, averaged over consecutive
/// windows.
///
/// In each window of `window_s`, each line from 0.5 to 40 Hz with the amplitude `A_i` has the index
/// `W_i = 3.57 (A_i^3 F(f_i)/f_i)^0.1`, and `W = (sum W_i^10)^0.1`. The index depends on the length of the window, so
/// state it with every value; 5 s is usual.
///
/// # Errors
/// A signal shorter than a window, samples that are not finite, or a rate or window out of bounds.
///
/// ```
/// use dashpot_rail::indices::{RideDirection, sperling};
/// let sine = |i: usize| 0.5 * (2.0 * std::f64::consts::PI * 2.0 * i as f64 / 500.0).sin();
/// let acceleration: Vec<f64> = (0..2500).map(sine).collect();
/// let index = sperling(&acceleration, 500.0, 5.0, RideDirection::Vertical)?;
/// assert!((index - 2.7775).abs() < 1e-4);
/// # Ok::<(), dashpot_rail::indices::SpectrumError>(())
/// ```
pub fn sperling(
    acceleration_m_per_s2: &[f64],
    rate_hz: f64,
    window_s: f64,
    direction: RideDirection,
) -> Result<f64, SpectrumError> {
    check_signal(acceleration_m_per_s2, rate_hz, window_s)?;
    let mut ride = Sperling::new(rate_hz, window_s)?;
    let (mut sum, mut windows) = (0.0, 0.0);
    for window in acceleration_m_per_s2.chunks_exact(ride.samples()) {
        sum += ride.of_window(window, direction);
        windows += 1.0;
    }
    Ok(sum / windows)
}
