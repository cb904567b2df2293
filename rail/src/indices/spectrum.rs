//! Fourier transforms of uniformly sampled signals.

use std::fmt;
use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};

/// Errors of spectra and of the indices based on them.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpectrumError {
    /// The signal is shorter than one window.
    #[error("{samples} samples, allowed: at least the {window} samples of a window")]
    Short {
        /// Number of samples of the signal.
        samples: usize,
        /// Number of samples of a window.
        window: usize,
    },
    /// A sample is not finite.
    #[error("sample {sample}: {value}, allowed: finite numbers")]
    NotFinite {
        /// Index of the sample, from 0.
        sample: usize,
        /// Its value.
        value: f64,
    },
    /// A rate or the length of a window is out of bounds.
    #[error("{name}: {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Name of the quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Smallest and largest allowed value.
        allowed: [f64; 2],
    },
}

/// Minimum number of samples of a window.
const MIN_SAMPLES: usize = 8;

/// Number of samples of a window.
pub(super) fn samples_of_window(rate_hz: f64, window_s: f64) -> Result<usize, SpectrumError> {
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
    Ok((window_s * rate_hz).round().max(MIN_SAMPLES as f64) as usize)
}

/// Checks that a signal is finite and not shorter than a window. Returns the number of samples of the window.
pub(super) fn check_signal(
    signal: &[f64],
    rate_hz: f64,
    window_s: f64,
) -> Result<usize, SpectrumError> {
    let window = samples_of_window(rate_hz, window_s)?;
    if let Some(sample) = signal.iter().position(|value| !value.is_finite()) {
        return Err(SpectrumError::NotFinite {
            sample,
            value: signal[sample],
        });
    }
    if signal.len() < window {
        return Err(SpectrumError::Short {
            samples: signal.len(),
            window,
        });
    }
    Ok(window)
}

/// Fourier transform of windows of one length. It is planned once and does not allocate per window.
#[derive(Clone)]
pub(super) struct Transform {
    plan: Arc<dyn RealToComplex<f64>>,
    input: Vec<f64>,
    lines: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl fmt::Debug for Transform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut debug = f.debug_struct("Transform");
        debug.field("samples", &self.plan.len());
        debug.finish_non_exhaustive()
    }
}

impl Transform {
    /// Plans the transform of windows of `samples` values.
    pub fn new(samples: usize) -> Self {
        let plan = RealFftPlanner::<f64>::new().plan_fft_forward(samples);
        Self {
            input: plan.make_input_vec(),
            lines: plan.make_output_vec(),
            scratch: plan.make_scratch_vec(),
            plan,
        }
    }

    /// Number of samples of a window.
    pub fn samples(&self) -> usize {
        self.plan.len()
    }

    /// Returns the complex amplitudes of the lines from 0 to half the rate, for a window of [`samples`](Self::samples)
    /// values.
    pub fn lines(&mut self, window: impl Iterator<Item = f64>) -> &[Complex<f64>] {
        for (input, value) in self.input.iter_mut().zip(window) {
            *input = value;
        }
        // Cannot fail: the lengths match the plan.
        let _ = self
            .plan
            .process_with_scratch(&mut self.input, &mut self.lines, &mut self.scratch);
        &self.lines
    }
}

/// Arithmetic mean.
pub(super) fn mean(window: &[f64]) -> f64 {
    window.iter().sum::<f64>() / window.len() as f64
}
