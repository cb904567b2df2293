//! A weighting of EN 12299 sample by sample.

use std::f64::consts::PI;

use super::spectrum::SpectrumError;
use super::weighting::{Section, Weighting};

/// Rates of samples, Hz: from above twice the upper end of the band.
const RATE_HZ: [f64; 2] = [400.0, 1e6];

/// A [`Weighting`] as a filter of an acceleration that is sampled at equal times: each factor of its transfer function by the bilinear
/// transform, exact at its corner. At 1 kHz the gain is within 0.5 % of the weighting's up to 40 Hz.
///
/// The signal counts as having had its first value for ever.
///
/// ```
/// use dashpot_rail::indices::{Weighting, WeightingFilter};
/// let mut filter = WeightingFilter::new(Weighting::Vertical, 1000.0)?;
/// let sine = |i: i32| (2.0 * std::f64::consts::PI * 8.0 * f64::from(i) / 1000.0).sin();
/// let weighted: Vec<f64> = (0..20_000).map(|i| filter.next(sine(i))).collect();
/// let greatest = weighted[10_000..].iter().fold(0.0, |greatest: f64, value| greatest.max(*value));
/// assert!((greatest / Weighting::Vertical.gain(8.0) - 1.0).abs() < 1e-3);
/// # Ok::<(), dashpot_rail::indices::SpectrumError>(())
/// ```
#[derive(Debug, Clone)]
pub struct WeightingFilter {
    factors: Vec<Factor>,
    has_begun: bool,
}

/// A factor in the transposed second direct form.
#[derive(Debug, Clone, Copy)]
struct Factor {
    over: [f64; 3],
    under: [f64; 2],
    state: [f64; 2],
}

impl Factor {
    fn new(section: &Section, rate_hz: f64) -> Self {
        // s = c (z - 1)/(z + 1), with c so that the corner stays in its place.
        let c = 2.0 * PI * section.corner_hz / (PI * section.corner_hz / rate_hz).tan();
        let of = |[constant, linear, quadratic]: [f64; 3]| {
            let (linear, quadratic) = (linear * c, quadratic * c * c);
            [
                constant + linear + quadratic,
                2.0 * (constant - quadratic),
                constant - linear + quadratic,
            ]
        };
        let (over, [first, under @ ..]) = (of(section.over), of(section.under));
        Self {
            over: over.map(|number| number / first),
            under: under.map(|number| number / first),
            state: [0.0; 2],
        }
    }

    /// At rest after the value for ever; what comes out then.
    fn rest(&mut self, value: f64) -> f64 {
        let ([_, b1, b2], [a1, a2]) = (self.over, self.under);
        let out = self.over.iter().sum::<f64>() / (1.0 + a1 + a2) * value;
        let last = b2 * value - a2 * out;
        self.state = [b1 * value - a1 * out + last, last];
        out
    }

    fn next(&mut self, value: f64) -> f64 {
        let ([b0, b1, b2], [a1, a2], [first, last]) = (self.over, self.under, self.state);
        let out = b0 * value + first;
        self.state = [b1 * value - a1 * out + last, b2 * value - a2 * out];
        out
    }
}

impl WeightingFilter {
    /// Of samples at `rate_hz`.
    ///
    /// # Errors
    /// A rate that is not 400 Hz to 1 MHz.
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
            has_begun: false,
        })
    }

    /// The weighted value of the next sample.
    pub fn next(&mut self, value: f64) -> f64 {
        if !self.has_begun {
            self.has_begun = true;
            let mut out = value;
            for factor in &mut self.factors {
                out = factor.rest(out);
            }
            return out;
        }
        let factors = self.factors.iter_mut();
        factors.fold(value, |value, factor| factor.next(value))
    }
}
