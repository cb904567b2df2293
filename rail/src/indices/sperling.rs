//! Sperling's ride index.

use super::spectrum::{SpectrumError, amplitudes, window_samples};

/// Direction of an acceleration across the track.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RideDirection {
    /// To the side.
    Lateral,
    /// Up and down.
    Vertical,
}

/// Band whose lines count, Hz.
const BAND_HZ: [f64; 2] = [0.5, 40.0];

impl RideDirection {
    /// Correction `F(f)` for what people feel: a rising part, a falling part, 1 beyond (GB/T 5599).
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

/// Sperling's ride index `W` of an acceleration, m/s^2, sampled at `rate_hz`: `W_i = 3.57 (A_i^3 F(f_i)/f_i)^0.1` of each line of
/// amplitude `A_i` from 0.5 to 40 Hz, `W = (sum W_i^10)^0.1`; the mean over windows of `window_s` that follow one another.
///
/// The sum depends on the length of the window, which belongs to every value: 5 s is usual.
///
/// # Errors
/// A signal shorter than a window, numbers that are not finite or out of bounds.
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
    let length = window_samples(acceleration_m_per_s2, rate_hz, window_s)?;
    let (mut sum, mut windows) = (0.0, 0.0);
    for window in acceleration_m_per_s2.chunks_exact(length) {
        let mean = window.iter().sum::<f64>() / length as f64;
        let about_mean: Vec<f64> = window.iter().map(|value| value - mean).collect();
        let of_lines: f64 = amplitudes(&about_mean)
            .into_iter()
            .enumerate()
            .map(|(line, amplitude)| (line as f64 * rate_hz / length as f64, amplitude))
            .filter(|(f, _)| (BAND_HZ[0]..=BAND_HZ[1]).contains(f))
            .map(|(f, amplitude)| amplitude.powi(3) * direction.correction(f) / f)
            .sum();
        sum += 3.57 * of_lines.powf(0.1);
        windows += 1.0;
    }
    Ok(sum / windows)
}
