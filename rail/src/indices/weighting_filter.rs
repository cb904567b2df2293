//! Time-domain filters for the weightings of EN 12299.

use std::f64::consts::PI;

use super::spectrum::SpectrumError;
use super::weighting::{Section, Weighting};

/// Bounds of the sample rate, Hz. The lower bound is four times the upper corner of the band.
const RATE_HZ: [f64; 2] = [400.0, 1e6];

/// Applies a [`Weighting`] to an acceleration sample by sample.
///
/// Each factor of the transfer function is discretised by the bilinear transform, exact at its corner frequency. At 1
/// kHz the gain is within 0.5 % of that of the weighting up to 40 Hz. The filter starts in the steady state for a
/// constant input that equals the first sample.
///
/// ```
/// use dashpot_rail::indices::{Weighting, WeightingFilter};
/// let mut filter = WeightingFilter::new(Weighting::Vertical, 1000.0)?;
/// let sine = |i: i32| (2.0 * std::f64::consts::PI * 8.0 * f64::from(i) / 1000.0).sin();
/// let weighted: Vec<f64> = (0..20_000).map(|i| filter.next(sine(i))).collect();
/// let peak = weighted[10_000..].iter().fold(0.0, |peak: f64, value| peak.max(*value));
/// assert!((peak / Weighting::Vertical.gain(8.0) - 1.0).abs() < 1e-3);
/// # Ok::<(), dashpot_rail::indices::SpectrumError>(())
/// ```
#[derive(Debug, Clone)]
pub struct WeightingFilter {
    factors: Vec<Factor>,
    has_started: bool,
}

/// A factor of the transfer function in transposed direct form II.
#[derive(Debug, Clone, Copy)]
pub(super) struct Factor {
    numerator: [f64; 3],
    denominator: [f64; 2],
    state: [f64; 2],
}

impl Factor {
    pub(super) fn new(section: &Section, rate_hz: f64) -> Self {
        // s = c (z - 1)/(z + 1), where c keeps the corner frequency exact.
        let c = 2.0 * PI * section.corner_hz / libm::tan(PI * section.corner_hz / rate_hz);
        let discretise = |[constant, linear, quadratic]: [f64; 3]| {
            let (linear, quadratic) = (linear * c, quadratic * c * c);
            [
                constant + linear + quadratic,
                2.0 * (constant - quadratic),
                constant - linear + quadratic,
            ]
        };
        let numerator = discretise(section.numerator);
        let [first, denominator @ ..] = discretise(section.denominator);
        Self {
            numerator: numerator.map(|coefficient| coefficient / first),
            denominator: denominator.map(|coefficient| coefficient / first),
            state: [0.0; 2],
        }
    }

    /// Sets the steady state for a constant input of a high-pass, whose output is then 0.
    fn settle(&mut self, value: f64) {
        let [_, b1, b2] = self.numerator;
        self.state = [b1 * value + b2 * value, b2 * value];
    }

    /// Sets the steady state for a constant input of a low-pass, whose output equals it.
    pub(super) fn settle_at(&mut self, value: f64) {
        let ([b0, _, b2], [_, a2]) = (self.numerator, self.denominator);
        self.state = [(1.0 - b0) * value, (b2 - a2) * value];
    }

    pub(super) fn next(&mut self, value: f64) -> f64 {
        let ([b0, b1, b2], [a1, a2]) = (self.numerator, self.denominator);
        let [first, last] = self.state;
        let out = b0 * value + first;
        self.state = [b1 * value - a1 * out + last, b2 * value - a2 * out];
        out
    }
}

impl WeightingFilter {
    /// Returns the filter for samples at `rate_hz`.
    ///
    /// # Errors
    /// A rate outside 400 Hz to 1 MHz.
    pub fn new(weighting: Weighting, rate_hz: f64) -> Result<Self, SpectrumError> {
        if !(RATE_HZ[0]..=RATE_HZ[1]).contains(&rate_hz) {
            return Err(SpectrumError::OutOfBounds {
                name: "rate_hz",
                value: rate_hz,
                allowed: RATE_HZ,
            });
        }
        let sections = weighting.sections();
        let factors = sections
            .iter()
            .map(|section| Factor::new(section, rate_hz))
            .collect();
        Ok(Self {
            factors,
            has_started: false,
        })
    }

    /// Returns the weighted value of the next sample.
    pub fn next(&mut self, value: f64) -> f64 {
        if !self.has_started {
            self.has_started = true;
            // The first factor is the high-pass of the band, so the others rest at 0.
            if let Some(high_pass) = self.factors.first_mut() {
                high_pass.settle(value);
            }
            return 0.0;
        }
        let factors = self.factors.iter_mut();
        factors.fold(value, |value, factor| factor.next(value))
    }
}
