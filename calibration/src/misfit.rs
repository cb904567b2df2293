//! Checks whether a fit is plausible for a damper, however small its intervals are.

use super::finding::{Finding, MAX_AMPLITUDE_M};
use super::loops::{LoopTest, Work};
use super::model::Model;
use super::residual::residual_rms_n;
use super::{Calibration, CalibrationError};

/// Default maximum residual beyond the noise, divided by the rms force (1).
///
/// A quadratic law leaves a residual of this size on a linear damper; the laws of this model leave a few percent on
/// real dampers.
pub const MAX_MISFIT: f64 = 0.2;

/// Net work, divided by the sum of the magnitudes of its increments, above which its sign is certain. The quotient is
/// near 1 for a damper and near 0 for a spring.
const CERTAIN_SHARE: f64 = 0.1;

/// Misfit of a test.
pub(super) struct Misfit {
    /// Index of the test.
    test: usize,
    missed_n: f64,
    force_rms_n: f64,
    /// Residual beyond the noise, divided by the rms force (1).
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
    /// Returns [`Finding::Missed`].
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
    /// `tolerance` is the maximum distance from a bound at which a value counts as at the bound, as a share of the
    /// range. `is_suspect(parameter, is_lower)` selects the bounds to check.
    ///
    /// # Errors
    /// Returns [`Finding::AtBound`].
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
pub(super) fn force_rms_n(test: &LoopTest) -> f64 {
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
    /// Returns [`Finding::TooFast`] or [`Finding::Driven`].
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
