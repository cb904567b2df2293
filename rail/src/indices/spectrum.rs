//! Spectra of a signal that was sampled at equal times.

use std::f64::consts::PI;

use realfft::RealFftPlanner;

/// Why there is no spectrum.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpectrumError {
    /// The signal is shorter than one window.
    #[error("{samples} samples, allowed: at least those of a window, {window}")]
    Short {
        /// Samples of the signal.
        samples: usize,
        /// Samples of a window.
        window: usize,
    },
    /// A sample is not finite.
    #[error("sample {sample}: {value}, allowed: finite numbers")]
    NotFinite {
        /// Number of the sample, from 0.
        sample: usize,
        /// Its value.
        value: f64,
    },
    /// A rate, a window or a number of samples is out of bounds.
    #[error("{name}: {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Smallest and greatest allowed value.
        allowed: [f64; 2],
    },
}

/// Samples of the shortest window.
const LEAST_SAMPLES: usize = 8;

/// Checks a signal against a window, s, at a rate, Hz; the samples of the window.
pub(super) fn window_samples(
    signal: &[f64],
    rate_hz: f64,
    window_s: f64,
) -> Result<usize, SpectrumError> {
    for (name, value, allowed) in [
        ("rate_hz", rate_hz, [1e-3, 1e9]),
        ("window_s", window_s, [1e-6, 1e9]),
    ] {
        if !(allowed[0]..=allowed[1]).contains(&value) {
            return Err(SpectrumError::OutOfBounds {
                name,
                value,
                allowed,
            });
        }
    }
    if let Some(sample) = signal.iter().position(|value| !value.is_finite()) {
        return Err(SpectrumError::NotFinite {
            sample,
            value: signal[sample],
        });
    }
    let window = (window_s * rate_hz).round().max(LEAST_SAMPLES as f64) as usize;
    if signal.len() < window {
        return Err(SpectrumError::Short {
            samples: signal.len(),
            window,
        });
    }
    Ok(window)
}

/// Complex amplitudes of the lines of a window, from 0 to half the rate.
pub(super) fn lines(window: &[f64]) -> Vec<[f64; 2]> {
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(window.len());
    let mut input = window.to_vec();
    let mut output = transform.make_output_vec();
    // The lengths are the plan's own.
    match transform.process(&mut input, &mut output) {
        Ok(()) => output.iter().map(|line| [line.re, line.im]).collect(),
        Err(_) => Vec::new(),
    }
}

/// One-sided amplitudes of the lines of a window, of which line `i` is at `i rate/len`: `2/len` times the magnitude.
pub(super) fn amplitudes(window: &[f64]) -> Vec<f64> {
    let scale = 2.0 / window.len() as f64;
    let magnitude = |[re, im]: [f64; 2]| scale * re.hypot(im);
    lines(window).into_iter().map(magnitude).collect()
}

/// One-sided power spectral density after Welch (1967): Hann windows that overlap by half, each without its mean.
///
/// Returns frequency, Hz, and density, the signal's unit squared per Hz. Its integral is the variance of the signal.
///
/// # Errors
/// A signal shorter than a window, numbers that are not finite or out of bounds.
///
/// ```
/// use dashpot_rail::indices::welch;
/// let sine = |i: usize| 3.0 * (2.0 * std::f64::consts::PI * 5.0 * i as f64 / 200.0).sin();
/// let signal: Vec<f64> = (0..4000).map(sine).collect();
/// let density = welch(&signal, 200.0, 4.0)?;
/// let variance: f64 = density.iter().map(|[_, density]| density * 0.25).sum();
/// assert!((variance - 4.5).abs() < 1e-3);
/// let [peak, _] = density.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
/// assert_eq!(peak, 5.0);
/// # Ok::<(), dashpot_rail::indices::SpectrumError>(())
/// ```
pub fn welch(signal: &[f64], rate_hz: f64, window_s: f64) -> Result<Vec<[f64; 2]>, SpectrumError> {
    let length = window_samples(signal, rate_hz, window_s)?;
    let hann: Vec<f64> = (0..length)
        .map(|i| 0.5 - 0.5 * (2.0 * PI * i as f64 / length as f64).cos())
        .collect();
    let power: f64 = hann.iter().map(|weight| weight * weight).sum();
    let mut density = vec![0.0; length / 2 + 1];
    let mut windows = 0.0;
    for start in (0..=signal.len() - length).step_by((length / 2).max(1)) {
        let window = &signal[start..start + length];
        let mean = window.iter().sum::<f64>() / length as f64;
        let weighted: Vec<f64> = window
            .iter()
            .zip(&hann)
            .map(|(value, weight)| (value - mean) * weight)
            .collect();
        for (sum, [re, im]) in density.iter_mut().zip(lines(&weighted)) {
            *sum += re * re + im * im;
        }
        windows += 1.0;
    }
    let is_doubled = |line: usize| line > 0 && 2 * line != length;
    Ok(density
        .iter()
        .enumerate()
        .map(|(line, sum)| {
            let sides = if is_doubled(line) { 2.0 } else { 1.0 };
            let density = sides * sum / (windows * rate_hz * power);
            [line as f64 * rate_hz / length as f64, density]
        })
        .collect())
}
