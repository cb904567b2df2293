//! What a result does not say by its numbers alone.

use serde::Serialize;

use super::influence::Influence;
use super::loops::LoopTest;
use super::varied::Varied;
use super::{CLOSE, Determination, LoopFit, Profile};

/// A model that misses more than so many times the noise of the force lacks something.
const MISSES: f64 = 2.0;

/// Noise below this part of the peak force is no measure of what a model may miss.
const LEAST_NOISE: f64 = 0.01;

/// Standard errors and part of the peak force by which the mean of what is missed must differ from zero.
const OFF_ZERO: (f64, f64) = (4.0, 0.005);

/// Fall of the sum of squares that chance hardly gives: of one degree of freedom, twenty times in a million, the sum being inflated by no model error.
const FITS_BETTER: f64 = 20.0;

/// Share of the way between its bounds within which a number is at one.
pub(super) const AT_BOUND: f64 = 5e-3;

/// Something that the user of a result must know.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
// Exhaustive: each front end has its own words for every one.
pub enum Warning {
    /// The model lacks something that a test has.
    Missed {
        /// The test.
        test: String,
        /// Root mean square of what the model misses (N).
        missed_n: f64,
        /// Noise of the force (N).
        noise_n: f64,
    },
    /// The zero of the force in a test differs from that in the others.
    ZeroDiffers {
        /// The test.
        test: String,
        /// Mean of what the model misses (N).
        mean_n: f64,
    },
    /// A number is at a bound that the user or the damper sets.
    AtBound {
        /// The number.
        key: String,
        /// The bound.
        bound: f64,
        /// Whether no damper goes beyond it.
        is_physical: bool,
    },
    /// Two numbers that the tests hardly tell apart.
    Close {
        /// One.
        a: String,
        /// The other.
        b: String,
        /// Their correlation.
        correlation: f64,
    },
    /// An assumed number decides a found one more than the tests' noise does.
    Assumed {
        /// The found number.
        key: String,
        /// The assumed one.
        assumed: String,
        /// Its value.
        value: f64,
        /// Half of its interval of 95 %.
        uncertainty: f64,
        /// How far the found number moves with it (%).
        shift_percent: f64,
    },
    /// The recordings fit better with another value of an assumed number.
    FitsBetter {
        /// The assumed number.
        assumed: String,
        /// Its value.
        value: f64,
        /// The value at which the recordings fit better.
        better: f64,
    },
}

/// What a calibration found, as far as warnings ask for it.
pub(super) struct Found<'a> {
    pub(super) varied: &'a [Varied],
    pub(super) values: &'a [f64],
    pub(super) profiles: &'a [Profile],
    pub(super) determination: &'a Determination,
    pub(super) influences: &'a [Influence],
    pub(super) loops: &'a [LoopTest],
    pub(super) fits: &'a [LoopFit],
}

impl Found<'_> {
    pub(super) fn warnings(&self) -> Vec<Warning> {
        let mut warnings = self.at_bounds();
        warnings.extend(self.close());
        warnings.extend(self.assumed());
        for (test, fit) in self.loops.iter().zip(self.fits) {
            warnings.extend(fit.zero_differs(test));
            if fit.misses(test) {
                warnings.push(Warning::Missed {
                    test: test.name.clone(),
                    missed_n: fit.missed_after_n,
                    noise_n: test.force_noise_n,
                });
            }
        }
        warnings
    }

    fn at_bounds(&self) -> Vec<Warning> {
        let numbers = self.varied.iter().zip(self.values).zip(self.profiles);
        let at = numbers.filter_map(|((varied, value), profile)| {
            let bound = varied.bound_at(*value, AT_BOUND)?;
            profile.is_open(bound.is_least).then(|| Warning::AtBound {
                key: varied.key.clone(),
                bound: bound.value,
                is_physical: bound.is_physical,
            })
        });
        at.collect()
    }

    fn close(&self) -> Vec<Warning> {
        let mut close = Vec::new();
        for (number, row) in self.determination.correlation.iter().enumerate() {
            for (other, &correlation) in row.iter().enumerate() {
                let [a, b] = [number, other].map(|number| &self.varied[number].key);
                if a < b && correlation.abs() > CLOSE {
                    let [a, b] = [a, b].map(Clone::clone);
                    close.push(Warning::Close { a, b, correlation });
                }
            }
        }
        close
    }

    fn assumed(&self) -> Vec<Warning> {
        let mut warnings = Vec::new();
        for influence in self.influences {
            for (number, varied) in self.varied.iter().enumerate() {
                let (shift, value) = (influence.shift(number), self.values[number]);
                let noise = self.profiles[number].half_width().unwrap_or(f64::INFINITY);
                if shift > noise && !varied.is_of_rig() {
                    warnings.push(Warning::Assumed {
                        key: varied.key.clone(),
                        assumed: influence.key.clone(),
                        value: influence.value,
                        uncertainty: influence.uncertainty,
                        shift_percent: 100.0 * shift / value.abs().max(f64::MIN_POSITIVE),
                    });
                }
            }
            let [low, high] = influence.chi_square;
            // A model that lacks something takes any number that makes up for it.
            let mut tests = self.loops.iter().zip(self.fits);
            if low.min(high) < -FITS_BETTER && !tests.any(|(test, fit)| fit.misses(test)) {
                let by = if low < high {
                    -influence.uncertainty
                } else {
                    influence.uncertainty
                };
                warnings.push(Warning::FitsBetter {
                    assumed: influence.key.clone(),
                    value: influence.value,
                    better: influence.value + by,
                });
            }
        }
        warnings
    }
}

impl LoopFit {
    /// Whether the model lacks something that the test has.
    pub fn misses(&self, test: &LoopTest) -> bool {
        self.missed_after_n > MISSES * test.force_noise_n.max(LEAST_NOISE * test.peak_force_n)
    }

    fn zero_differs(&self, test: &LoopTest) -> Option<Warning> {
        let measured = test.counted_forces_n();
        let count = measured.len().max(1) as f64;
        let missed = measured
            .iter()
            .zip(&self.after_n)
            .map(|(force, model)| force - model);
        let mean_n = missed.sum::<f64>() / count;
        let error_n = self.missed_after_n * (self.correlation_samples / count).sqrt();
        let (errors, part) = OFF_ZERO;
        let differs = mean_n.abs() > (errors * error_n).max(part * test.peak_force_n);
        differs.then(|| Warning::ZeroDiffers {
            test: test.name.clone(),
            mean_n,
        })
    }
}
