//! What shows that a fit is no damper's, however small its intervals are.

use std::fmt;

use super::loops::LoopTest;
use super::model::Model;
use super::remedy::{Advice, Remedy};
use super::{Calibration, CalibrationError, left};

/// Largest part of the force's root mean square that a model may miss beyond the noise, by default. A quadratic law misses this much of a linear
/// damper; laws of real dampers miss some percent.
pub const MOST_MISSED: f64 = 0.2;

/// Largest amplitude of a test (m): no damper of a vehicle has such a stroke.
const LARGEST_AMPLITUDE_M: f64 = 0.5;

/// Work of the recorded force over the sum of its parts' magnitudes, beyond which its sign is certain. That of a damper is near 1, that of a spring 0.
const CERTAIN: f64 = 0.1;

/// Why a fit, or the search for one, is refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// The recorded force drives the damper.
    Driven {
        /// Work that the force takes from the motion (J).
        work_j: f64,
    },
    /// The recorded motion is faster or longer than the damper can follow.
    TooFast {
        /// The test.
        test: String,
        /// Its amplitude (m).
        amplitude_m: f64,
        /// Its largest velocity (m/s).
        velocity_m_per_s: f64,
        /// The fastest motion that the damper follows (m/s).
        most_m_per_s: f64,
    },
    /// The model misses more of a test than noise explains.
    Missed {
        /// The test.
        test: String,
        /// Root mean square of what the model misses (N).
        missed_n: f64,
        /// Noise of the force (N).
        noise_n: f64,
        /// Root mean square of the force about its mean (N).
        force_rms_n: f64,
        /// The largest part of that which may be missed.
        most: f64,
        /// Numbers that ended at a bound that nobody asked for, and their bounds.
        at_bounds: Vec<(String, [f64; 2])>,
    },
    /// A number ended at a bound that nobody asked for.
    AtBound {
        /// The number.
        key: String,
        /// The bound.
        bound: f64,
        /// Both bounds.
        bounds: [f64; 2],
    },
}

impl Finding {
    /// What a user can do who wants the nearest fit all the same; `None` where there is none.
    pub(super) fn acceptance(&self) -> Option<Advice> {
        match self {
            Self::Missed {
                missed_n,
                force_rms_n,
                at_bounds,
                ..
            } => {
                // Up to the next ten percent.
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
                "the recorded force drives the damper: it gives {:.3} J to the motion, where a damper takes energy",
                -work_j
            ),
            Self::TooFast {
                test,
                amplitude_m,
                velocity_m_per_s,
                most_m_per_s,
            } => write!(
                f,
                "{test}: a motion of +-{amplitude_m:.3} m at {velocity_m_per_s:.3} m/s; a damper moves by at most \
                 {LARGEST_AMPLITUDE_M} m, and this one follows at most {most_m_per_s} m/s (limits.rate_m_per_s)"
            ),
            Self::Missed {
                test,
                missed_n,
                noise_n,
                force_rms_n,
                most,
                at_bounds,
            } => {
                write!(
                    f,
                    "{test}: the model misses {missed_n:.3} N of {force_rms_n:.3} N (rms) where the force has {noise_n:.3} N of noise; \
                     allowed beyond the noise: {:.0} %",
                    100.0 * most
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

/// How much of a test a model misses.
pub(super) struct Misfit {
    /// The test's number.
    test: usize,
    missed_n: f64,
    force_rms_n: f64,
    /// What is missed beyond the noise, over the force.
    pub(super) share: f64,
}

impl Model<'_> {
    /// The test of which the model misses the largest share; `None` without loops.
    ///
    /// # Errors
    /// As [`Model::forces_n`].
    pub(super) fn worst_misfit(&self, places: &[f64]) -> Result<Option<Misfit>, CalibrationError> {
        let forces = self.forces_n(places)?;
        let misfits = self.loops.iter().zip(&forces).enumerate();
        let misfits = misfits.map(|(number, (test, forces))| {
            let missed_n = left::missed_n(test, forces);
            let force_rms_n = force_rms_n(test);
            let beyond = (missed_n * missed_n - test.force_noise_n.powi(2))
                .max(0.0)
                .sqrt();
            Misfit {
                test: number,
                missed_n,
                force_rms_n,
                share: beyond / force_rms_n.max(f64::MIN_POSITIVE),
            }
        });
        Ok(misfits.max_by(|a, b| a.share.total_cmp(&b.share)))
    }

    /// # Errors
    /// The model misses more than the part `most` of a test.
    pub(super) fn refuse_misfit(&self, places: &[f64], most: f64) -> Result<(), CalibrationError> {
        let worst = self.worst_misfit(places)?;
        match worst.filter(|worst| worst.share > most || worst.share.is_nan()) {
            Some(worst) => Err(CalibrationError::implausible(Finding::Missed {
                test: self.loops[worst.test].name.clone(),
                missed_n: worst.missed_n,
                noise_n: self.loops[worst.test].force_noise_n,
                force_rms_n: worst.force_rms_n,
                most,
                at_bounds: self.at_bounds(places),
            })),
            None => Ok(()),
        }
    }

    /// Numbers at bounds that neither a damper nor the user sets.
    fn at_bounds(&self, places: &[f64]) -> Vec<(String, [f64; 2])> {
        let numbers = self.varied.iter().zip(self.values(places));
        let at = numbers.filter(|(varied, value)| {
            let bound = varied.bound_at(*value, super::warning::AT_BOUND);
            bound.is_some_and(|bound| !bound.is_physical && !bound.is_own)
        });
        at.map(|(varied, _)| (varied.key.clone(), varied.bounds))
            .collect()
    }

    /// # Errors
    /// A number, of those that `is_suspect`, is at a bound that neither a damper nor the user sets, within the share `part` of the way between its
    /// bounds.
    pub(super) fn refuse_bounds(
        &self,
        places: &[f64],
        part: f64,
        is_suspect: impl Fn(usize, bool) -> bool,
    ) -> Result<(), CalibrationError> {
        for (number, (varied, value)) in self.varied.iter().zip(self.values(places)).enumerate() {
            let Some(bound) = varied.bound_at(value, part) else {
                continue;
            };
            if !bound.is_physical && !bound.is_own && is_suspect(number, bound.is_least) {
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

/// Root mean square of a test's forces about their mean (N).
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
    /// Work of the force in all tests (J), and that over the sum of the magnitudes of its parts.
    pub(super) fn work(&self) -> [f64; 2] {
        let works = self.loops.iter().map(LoopTest::work_j);
        let [work, size] = works.fold([0.0; 2], |sum, work| [sum[0] + work[0], sum[1] + work[1]]);
        [work, if size > 0.0 { work / size } else { 0.0 }]
    }

    /// Whether the sign of the work is certain.
    pub(super) fn certain_sign(&self) -> Option<f64> {
        let [_, share] = self.work();
        (share.abs() > CERTAIN).then(|| share.signum())
    }

    /// The first test whose motion no damper makes.
    pub(super) fn too_fast(&self) -> Option<Finding> {
        let most_m_per_s = self
            .damper
            .number("limits.rate_m_per_s")
            .unwrap_or(f64::INFINITY);
        self.loops.iter().find_map(|test| {
            let velocity_m_per_s = 2_f64.sqrt() * test.rms_velocity_m_per_s(self.step_s);
            let is_too_fast =
                velocity_m_per_s > most_m_per_s || test.amplitude_m > LARGEST_AMPLITUDE_M;
            is_too_fast.then(|| Finding::TooFast {
                test: test.name.clone(),
                amplitude_m: test.amplitude_m,
                velocity_m_per_s,
                most_m_per_s,
            })
        })
    }

    /// # Errors
    /// Recordings that no damper can have made.
    pub(super) fn refuse_impossible(&self) -> Result<(), CalibrationError> {
        if let Some(finding) = self.too_fast() {
            return Err(CalibrationError::implausible(finding));
        }
        match self.certain_sign() {
            Some(sign) if sign < 0.0 => {
                let [work_j, _] = self.work();
                Err(CalibrationError::implausible(Finding::Driven { work_j }))
            }
            _ => Ok(()),
        }
    }
}
