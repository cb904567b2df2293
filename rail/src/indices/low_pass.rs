//! Low-pass filter of wheel forces.

use std::f64::consts::PI;

use super::weighting::Section;
use super::weighting_filter::Factor;

/// Quality factors of a Butterworth filter of order 4.
const QUALITIES: [f64; 2] = [0.541_196_1, 1.306_563];

/// Butterworth low-pass of order 4, sample by sample.
///
/// Acceptance tests (EN 14363) filter wheel forces at 20 Hz. Discretised by the bilinear transform, exact at the
/// corner. The filter starts in the steady state for a constant input that equals the first sample.
///
/// ```
/// use dashpot_rail::indices::LowPass;
/// let mut filter = LowPass::new(20.0, 1000.0);
/// let sine = |i: i32| (2.0 * std::f64::consts::PI * 20.0 * f64::from(i) / 1000.0).sin();
/// let filtered: Vec<f64> = (0..5000).map(|i| filter.next(sine(i))).collect();
/// let peak = filtered[1000..].iter().fold(0.0, |peak: f64, value| peak.max(*value));
/// assert!((peak - 0.5_f64.sqrt()).abs() < 2e-3);
/// ```
#[derive(Debug, Clone)]
pub struct LowPass {
    factors: [Factor; 2],
    has_started: bool,
}

impl LowPass {
    /// Returns the filter for a corner frequency below half the sample rate, Hz.
    pub fn new(corner_hz: f64, rate_hz: f64) -> Self {
        let w = 2.0 * PI * corner_hz;
        let factor = |quality: f64| {
            let section = Section {
                corner_hz,
                numerator: [w * w, 0.0, 0.0],
                denominator: [w * w, w / quality, 1.0],
            };
            Factor::new(&section, rate_hz)
        };
        Self {
            factors: QUALITIES.map(factor),
            has_started: false,
        }
    }

    /// Returns the filtered value of the next sample.
    pub fn next(&mut self, value: f64) -> f64 {
        if !self.has_started {
            self.has_started = true;
            for factor in &mut self.factors {
                factor.settle_at(value);
            }
        }
        let factors = self.factors.iter_mut();
        factors.fold(value, |value, factor| factor.next(value))
    }
}
