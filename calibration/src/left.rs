//! What a model leaves of a test, and how many samples of it count once.

use dashpot_rail::indices::Welch;

use super::CalibrationError;
use super::loops::LoopTest;
use super::model::Model;

/// What a model leaves of a test.
pub(super) struct Left {
    /// Root mean square (N).
    pub(super) rms_n: f64,
    /// Samples that count once, 1 of white noise.
    pub(super) correlation_samples: f64,
}

impl Model<'_> {
    /// Of each loop.
    ///
    /// # Errors
    /// As [`Model::deviations`].
    pub(super) fn left(&self, places: &[f64]) -> Result<Vec<Left>, CalibrationError> {
        let forces = self.forces_n(places)?;
        let left = self.loops.iter().zip(&forces).map(|(test, forces)| {
            let measured = test.counted_forces_n().iter();
            let left: Vec<f64> = measured.zip(forces).map(|(f, model)| model - f).collect();
            Left {
                rms_n: missed_n(test, forces),
                correlation_samples: correlation_samples(&left),
            }
        });
        Ok(left.collect())
    }
}

/// Root mean square of what `forces_n` of a model miss of a test (N).
pub(super) fn missed_n(test: &LoopTest, forces_n: &[f64]) -> f64 {
    let pairs = test.counted_forces_n().iter().zip(forces_n);
    let square: f64 = pairs.map(|(f, model)| (model - f).powi(2)).sum();
    (square / forces_n.len().max(1) as f64).sqrt()
}

/// How many samples of a series count once: the density of its spectrum in the octave where that is highest, over what it would be were the
/// series white. What a number does to a force lies in a band about the motion's lines; where in the spectrum that is, is not asked, so
/// that intervals are rather too wide than too narrow.
fn correlation_samples(series: &[f64]) -> f64 {
    /// Windows of the spectrum: enough for an octave of one line.
    const WINDOWS: usize = 8;
    /// Samples of a window at most.
    const LONGEST: usize = 1 << 14;
    let square: f64 = series.iter().map(|value| value * value).sum();
    let length = (series.len() / WINDOWS).min(LONGEST);
    let Ok(mut welch) = Welch::new(1.0, length as f64) else {
        return 1.0;
    };
    series.iter().for_each(|value| welch.add(*value));
    let density = welch.density();
    // One-sided, at one sample a second.
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
    fn white_noise_counts_each_sample_and_slow_noise_few() {
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
