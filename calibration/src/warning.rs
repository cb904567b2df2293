//! Warnings about a result.

use serde::Serialize;

use super::influence::Influence;
use super::loops::LoopTest;
use super::varied::Varied;
use super::{Determination, HIGH_CORRELATION, LoopFit, Profile};

/// Ratio of residual to noise above which the model counts as lacking an effect that the test shows.
const MAX_RESIDUAL_OVER_NOISE: f64 = 2.0;

/// Smaller noise counts as this share of the peak force in the comparison.
const MIN_NOISE: f64 = 0.01;

/// Minimum mean residual, in standard errors, for the force zero of a test to count as different.
const ZERO_STANDARD_ERRORS: f64 = 4.0;

/// Minimum mean residual, as a share of the peak force, for the force zero of a test to count as different.
const ZERO_SHARE_OF_PEAK: f64 = 0.005;

/// Significant decrease of the sum of squares: with one degree of freedom and no model error, chance causes it with a
/// probability below 1e-5.
const SIGNIFICANT_DECREASE: f64 = 20.0;

/// Distance from a bound, as a share of the range, within which a parameter counts as at the bound.
pub(super) const AT_BOUND: f64 = 5e-3;

/// A warning about a result.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
// Exhaustive, because each front end has its own words for every variant.
pub enum Warning {
    /// The model lacks an effect that a test shows.
    Missed {
        /// Name of the test.
        test: String,
        /// Root mean square residual (N).
        missed_n: f64,
        /// Standard deviation of the force noise (N).
        noise_n: f64,
    },
    /// The force zero of one test differs from that of the others.
    ZeroDiffers {
        /// Name of the test.
        test: String,
        /// Mean residual (N).
        mean_n: f64,
    },
    /// A parameter is at a bound that the user chose or that is a physical limit.
    AtBound {
        /// Key of the parameter.
        key: String,
        /// Value of the bound.
        bound: f64,
        /// True for a physical limit.
        is_physical: bool,
    },
    /// The tests hardly distinguish two parameters.
    Close {
        /// Key of one parameter.
        a: String,
        /// Key of the other parameter.
        b: String,
        /// Correlation of the two.
        correlation: f64,
    },
    /// The uncertainty of an assumed parameter affects a calibrated one more than the noise of the tests does.
    Assumed {
        /// Key of the calibrated parameter.
        key: String,
        /// Key of the assumed parameter.
        assumed: String,
        /// Value of the assumed parameter.
        value: f64,
        /// Half-width of the assumed parameter's 95 % interval.
        uncertainty: f64,
        /// Shift of the calibrated parameter over the interval (%).
        shift_percent: f64,
    },
    /// The recordings fit better with a different value of an assumed parameter.
    FitsBetter {
        /// Key of the assumed parameter.
        assumed: String,
        /// Assumed value.
        value: f64,
        /// Value at which the recordings fit better.
        better: f64,
    },
}

/// Parts of a result that warnings depend on.
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
        let parameters = self.varied.iter().zip(self.values).zip(self.profiles);
        let at = parameters.filter_map(|((varied, value), profile)| {
            let bound = varied.bound_at(*value, AT_BOUND)?;
            profile.is_open(bound.is_lower).then(|| Warning::AtBound {
                key: varied.key.clone(),
                bound: bound.value,
                is_physical: bound.is_physical,
            })
        });
        at.collect()
    }

    fn close(&self) -> Vec<Warning> {
        let mut close = Vec::new();
        for (parameter, row) in self.determination.correlation.iter().enumerate() {
            for (other, &correlation) in row.iter().enumerate() {
                let [a, b] = [parameter, other].map(|parameter| &self.varied[parameter].key);
                if a < b && correlation.abs() > HIGH_CORRELATION {
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
            for (parameter, varied) in self.varied.iter().enumerate() {
                let (shift, value) = (influence.shift(parameter), self.values[parameter]);
                let noise = self.profiles[parameter]
                    .half_width()
                    .unwrap_or(f64::INFINITY);
                if shift > noise && !varied.is_rig_parameter() {
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
            // If the model lacks an effect, a wrong assumed value may compensate for it.
            let mut tests = self.loops.iter().zip(self.fits);
            if low.min(high) < -SIGNIFICANT_DECREASE && !tests.any(|(test, fit)| fit.misses(test)) {
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
    /// True if the model lacks an effect that the test shows.
    pub fn misses(&self, test: &LoopTest) -> bool {
        self.missed_after_n
            > MAX_RESIDUAL_OVER_NOISE * test.force_noise_n.max(MIN_NOISE * test.peak_force_n)
    }

    fn zero_differs(&self, test: &LoopTest) -> Option<Warning> {
        let measured = test.counted_forces_n();
        let count = measured.len().max(1) as f64;
        let residuals = measured
            .iter()
            .zip(&self.after_n)
            .map(|(force, model)| force - model);
        let mean_n = residuals.sum::<f64>() / count;
        let error_n = self.missed_after_n * (self.correlation_samples / count).sqrt();
        let threshold_n =
            (ZERO_STANDARD_ERRORS * error_n).max(ZERO_SHARE_OF_PEAK * test.peak_force_n);
        let differs = mean_n.abs() > threshold_n;
        differs.then(|| Warning::ZeroDiffers {
            test: test.name.clone(),
            mean_n,
        })
    }
}
