//! Residual of a test: its rms and correlation length.

use dashpot_rail::indices::Welch;

use super::CalibrationError;
use super::loops::LoopTest;
use super::model::Model;

/// Residual of a test.
pub(super) struct Residual {
    /// Root mean square (N).
    pub(super) rms_n: f64,
    /// Correlation length in samples; 1 for white noise.
    pub(super) correlation_samples: f64,
}

impl Model<'_> {
    /// Returns the residual of each loop.
    ///
    /// # Errors
    /// Same errors as [`Model::deviations`].
    pub(super) fn residuals(&self, coordinates: &[f64]) -> Result<Vec<Residual>, CalibrationError> {
        let forces = self.forces_n(coordinates)?;
        let residuals = self.loops.iter().zip(&forces).map(|(test, forces)| {
            let measured = test.counted_forces_n().iter();
            let residual: Vec<f64> = measured.zip(forces).map(|(f, model)| model - f).collect();
            Residual {
                rms_n: residual_rms_n(test, forces),
                correlation_samples: correlation_samples(&residual),
            }
        });
        Ok(residuals.collect())
    }
}

/// Returns the root mean square of the test's forces minus the model's `forces_n` (N).
pub(super) fn residual_rms_n(test: &LoopTest, forces_n: &[f64]) -> f64 {
    let pairs = test.counted_forces_n().iter().zip(forces_n);
    let square: f64 = pairs.map(|(f, model)| (model - f).powi(2)).sum();
    (square / forces_n.len().max(1) as f64).sqrt()
}

/// Returns the correlation length of a series in samples: the mean of its spectral density in the octave where it is
/// highest, divided by the density of white noise with the same rms.
///
/// The effect of a parameter on the force lies in a band around the spectral lines of the motion. The highest octave is
/// used even if it lies outside that band, so intervals are too wide rather than too narrow.
pub(super) fn correlation_samples(series: &[f64]) -> f64 {
    /// Number of windows to average over: enough even for the lowest octave, which contains only one spectral line.
    const WINDOWS: usize = 8;
    /// Maximum samples per window.
    const MAX_WINDOW: usize = 1 << 14;
    let square: f64 = series.iter().map(|value| value * value).sum();
    let length = (series.len() / WINDOWS).min(MAX_WINDOW);
    let Ok(mut welch) = Welch::new(1.0, length as f64) else {
        return 1.0;
    };
    series.iter().for_each(|value| welch.add(*value));
    let density = welch.density();
    // One-sided density at one sample per second.
    let white = 2.0 * square / series.len() as f64;
    if welch.windows() == 0 || white <= 0.0 {
        return 1.0;
    }
    let mut highest = 1.0_f64;
    let mut from = 1;
    while from < density.len() {
        let octave = &density[from..(2 * from).min(density.len())];
        let mean = octave.iter().map(|[_, density]| density).sum::<f64>() / octave.len() as f64;
        highest = highest.max(mean / white);
        from *= 2;
    }
    highest
}

#[cfg(test)]
mod tests {
    use fastrand::Rng;

    use super::*;

    #[test]
    fn white_noise_is_uncorrelated_and_slow_noise_is_correlated() {
        let mut rng = Rng::with_seed(9);
        // x_k = p x_(k-1) + e_k has (1 + p)/(1 - p) times the density of white noise at low frequency.
        for (p, expected) in [(0.0, 1.0), (0.5, 3.0), (0.9, 19.0)] {
            let mut value = 0.0;
            let series: Vec<f64> = (0..20_000)
                .map(|_| {
                    value = p * value + rng.f64() - 0.5;
                    value
                })
                .collect();
            let found = correlation_samples(&series);
            assert!((0.8..1.7).contains(&(found / expected)), "{p}: {found}");
        }
        assert_eq!(correlation_samples(&[0.0; 1000]), 1.0);
        assert_eq!(correlation_samples(&[]), 1.0);
    }
}
