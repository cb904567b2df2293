//! Checks whether a fit is plausible for a damper, however small its intervals are.

use std::fmt;

use super::loops::{LoopTest, Work};
use super::model::Model;
use super::remedy::{Advice, Remedy};
use super::residual::residual_rms_n;
use super::{Calibration, CalibrationError};

/// Default maximum residual beyond the noise, over the rms force (1).
///
/// A quadratic law misses this much of a linear damper; the laws of real dampers miss a few percent.
pub const MAX_MISFIT: f64 = 0.2;

/// Maximum amplitude of a test (m); no vehicle damper has a longer stroke.
const MAX_AMPLITUDE_M: f64 = 0.5;

/// Net work over the sum of the magnitudes of its increments beyond which its sign is certain. It is near 1 for a
/// damper and 0 for a spring.
const CERTAIN_SHARE: f64 = 0.1;

/// Reason to reject a fit or a recording.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// The recorded force drives the damper instead of resisting the motion.
    Driven {
        /// Work that the force takes from the motion; negative here (J).
        work_j: f64,
    },
    /// The recorded motion is too fast or too large for the damper.
    TooFast {
        /// Name of the test.
        test: String,
        /// Amplitude of the motion (m).
        amplitude_m: f64,
        /// Peak velocity of a harmonic motion with the same rms velocity (m/s).
        velocity_m_per_s: f64,
        /// Velocity limit of the damper (m/s).
        max_velocity_m_per_s: f64,
    },
    /// The residual of a test is larger than noise explains.
    Missed {
        /// Name of the test.
        test: String,
        /// Root mean square residual (N).
        missed_n: f64,
        /// Standard deviation of the force noise (N).
        noise_n: f64,
        /// Root mean square of the force about its mean (N).
        force_rms_n: f64,
        /// Maximum residual beyond the noise, over `force_rms_n` (1).
        max: f64,
        /// Parameters that ended at a default bound, and their bounds.
        at_bounds: Vec<(String, [f64; 2])>,
    },
    /// A parameter ended at a default bound.
    AtBound {
        /// Key of the parameter.
        key: String,
        /// Value of the bound.
        bound: f64,
        /// Lower and upper bound.
        bounds: [f64; 2],
    },
}

impl Finding {
    /// Returns the changes that accept the best fit despite this finding; `None` if nothing can.
    pub(super) fn acceptance(&self) -> Option<Advice> {
        match self {
            Self::Missed {
                missed_n,
                force_rms_n,
                at_bounds,
                ..
            } => {
                // Rounds up to the next ten percent.
                let part = (10.0 * missed_n / force_rms_n).floor() / 10.0 + 0.1;
                let bounds = at_bounds.iter().map(|(key, bounds)| Remedy::Bounds {
                    key: key.clone(),
                    bounds: *bounds,
                });
                Some(
                    [Remedy::AllowMisfit(part)]
                        .into_iter()
                        .chain(bounds)
                        .collect(),
                )
            }
            Self::AtBound { key, bounds, .. } => Some(vec![Remedy::Bounds {
                key: key.clone(),
                bounds: *bounds,
            }]),
            _ => None,
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Driven { work_j } => write!(
                f,
                "the recorded force drives the damper: it adds {:.3} J to the motion, but a damper dissipates energy",
                -work_j
            ),
            Self::TooFast {
                test,
                amplitude_m,
                velocity_m_per_s,
                max_velocity_m_per_s,
            } => write!(
                f,
                "{test}: a motion of +-{amplitude_m:.3} m at {velocity_m_per_s:.3} m/s; a damper moves by at most \
                 {MAX_AMPLITUDE_M} m, and this one follows at most {max_velocity_m_per_s} m/s (limits.rate_m_per_s)"
            ),
            Self::Missed {
                test,
                missed_n,
                noise_n,
                force_rms_n,
                max,
                at_bounds,
            } => {
                write!(
                    f,
                    "{test}: the model misses {missed_n:.3} N of {force_rms_n:.3} N (rms), and the noise of the force \
                     is {noise_n:.3} N; allowed beyond the noise: {:.0} %",
                    100.0 * max
                )?;
                at_bounds
                    .iter()
                    .try_for_each(|(key, _)| write!(f, "; {key} ended at a bound"))
            }
            Self::AtBound { key, bound, .. } => {
                write!(
                    f,
                    "{key} ended at its bound {bound:e}: the best value lies beyond it"
                )
            }
        }
    }
}

/// Misfit of a test.
pub(super) struct Misfit {
    /// Index of the test.
    test: usize,
    missed_n: f64,
    force_rms_n: f64,
    /// Residual beyond the noise over the rms force (1).
    pub(super) share: f64,
}

impl Model<'_> {
    /// Returns the largest misfit of all loops; `None` if there are no loops.
    ///
    /// # Errors
    /// Same errors as [`Model::forces_n`].
    pub(super) fn worst_misfit(
        &self,
        coordinates: &[f64],
    ) -> Result<Option<Misfit>, CalibrationError> {
        let forces = self.forces_n(coordinates)?;
        let misfits = self.loops.iter().zip(&forces).enumerate();
        let misfits = misfits.map(|(index, (test, forces))| {
            let missed_n = residual_rms_n(test, forces);
            let force_rms_n = force_rms_n(test);
            let beyond = (missed_n * missed_n - test.force_noise_n.powi(2))
                .max(0.0)
                .sqrt();
            Misfit {
                test: index,
                missed_n,
                force_rms_n,
                share: beyond / force_rms_n.max(f64::MIN_POSITIVE),
            }
        });
        Ok(misfits.max_by(|a, b| a.share.total_cmp(&b.share)))
    }

    /// Rejects a fit whose largest misfit exceeds `max`.
    ///
    /// # Errors
    /// [`Finding::Missed`].
    pub(super) fn reject_misfit(
        &self,
        coordinates: &[f64],
        max: f64,
    ) -> Result<(), CalibrationError> {
        let worst = self.worst_misfit(coordinates)?;
        match worst.filter(|worst| worst.share > max || worst.share.is_nan()) {
            Some(worst) => Err(CalibrationError::implausible(Finding::Missed {
                test: self.loops[worst.test].name.clone(),
                missed_n: worst.missed_n,
                noise_n: self.loops[worst.test].force_noise_n,
                force_rms_n: worst.force_rms_n,
                max,
                at_bounds: self.at_bounds(coordinates),
            })),
            None => Ok(()),
        }
    }

    /// Returns the parameters at default bounds that are not physical limits.
    fn at_bounds(&self, coordinates: &[f64]) -> Vec<(String, [f64; 2])> {
        let parameters = self.varied.iter().zip(self.values(coordinates));
        let at = parameters.filter(|(varied, value)| {
            let bound = varied.bound_at(*value, super::warning::AT_BOUND);
            bound.is_some_and(|bound| !bound.is_physical && !bound.is_own)
        });
        at.map(|(varied, _)| (varied.key.clone(), varied.bounds))
            .collect()
    }

    /// Rejects a parameter that is at a default bound, unless the bound is a physical limit.
    ///
    /// `tolerance` is the distance from a bound that counts as at the bound, as a share of the range.
    /// `is_suspect(parameter, is_lower)` selects the bounds to check.
    ///
    /// # Errors
    /// [`Finding::AtBound`].
    pub(super) fn reject_bounds(
        &self,
        coordinates: &[f64],
        tolerance: f64,
        is_suspect: impl Fn(usize, bool) -> bool,
    ) -> Result<(), CalibrationError> {
        for (parameter, (varied, value)) in
            self.varied.iter().zip(self.values(coordinates)).enumerate()
        {
            let Some(bound) = varied.bound_at(value, tolerance) else {
                continue;
            };
            if !bound.is_physical && !bound.is_own && is_suspect(parameter, bound.is_lower) {
                return Err(CalibrationError::implausible(Finding::AtBound {
                    key: varied.key.clone(),
                    bound: bound.value,
                    bounds: varied.bounds,
                }));
            }
        }
        Ok(())
    }
}

/// Returns the root mean square of a test's forces about their mean (N).
fn force_rms_n(test: &LoopTest) -> f64 {
    let forces = test.counted_forces_n();
    let count = forces.len().max(1) as f64;
    let mean = forces.iter().sum::<f64>() / count;
    (forces
        .iter()
        .map(|force| (force - mean).powi(2))
        .sum::<f64>()
        / count)
        .sqrt()
}

impl Calibration {
    /// Returns the work of the force in all tests.
    fn work(&self) -> Work {
        let works = self.loops.iter().map(LoopTest::work);
        works.fold(Work::default(), |sum, work| Work {
            net_j: sum.net_j + work.net_j,
            magnitude_j: sum.magnitude_j + work.magnitude_j,
        })
    }

    /// Returns the sign of the work; `None` if it is uncertain.
    pub(super) fn certain_sign(&self) -> Option<f64> {
        let work = self.work();
        let share = if work.magnitude_j > 0.0 {
            work.net_j / work.magnitude_j
        } else {
            0.0
        };
        (share.abs() > CERTAIN_SHARE).then(|| share.signum())
    }

    /// Returns a finding for the first test whose motion is too fast or too large.
    pub(super) fn too_fast(&self) -> Option<Finding> {
        let max_velocity_m_per_s = self
            .damper
            .number("limits.rate_m_per_s")
            .unwrap_or(f64::INFINITY);
        self.loops.iter().find_map(|test| {
            let velocity_m_per_s = 2_f64.sqrt() * test.rms_velocity_m_per_s(self.step_s);
            let is_too_fast =
                velocity_m_per_s > max_velocity_m_per_s || test.amplitude_m > MAX_AMPLITUDE_M;
            is_too_fast.then(|| Finding::TooFast {
                test: test.name.clone(),
                amplitude_m: test.amplitude_m,
                velocity_m_per_s,
                max_velocity_m_per_s,
            })
        })
    }

    /// Rejects recordings that no damper can produce.
    ///
    /// # Errors
    /// [`Finding::TooFast`] or [`Finding::Driven`].
    pub(super) fn reject_impossible(&self) -> Result<(), CalibrationError> {
        if let Some(finding) = self.too_fast() {
            return Err(CalibrationError::implausible(finding));
        }
        match self.certain_sign() {
            Some(sign) if sign < 0.0 => {
                let work_j = self.work().net_j;
                Err(CalibrationError::implausible(Finding::Driven { work_j }))
            }
            _ => Ok(()),
        }
    }
}
