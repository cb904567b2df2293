#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod cause;
mod determination;
mod determined;
mod diagnosis;
mod error;
mod finding;
mod fit;
mod indices;
mod influence;
mod keys;
mod loops;
mod misfit;
mod model;
mod plan;
mod plausible;
mod predicted;
mod prior;
mod profile;
mod recorded_indices;
mod remedy;
mod request;
mod residual;
mod rig;
mod varied;
pub mod vehicle_sensors;
mod warning;

pub use determination::{Determination, Determined};
pub use determined::HIGH_CORRELATION;
pub use error::CalibrationError;
pub use finding::Finding;
use fit::Fit;
pub use indices::IndexTest;
use influence::widened;
pub use influence::{DENSITY, Influence, TEMPERATURE_UNCERTAINTY_K};
pub use keys::{DISPLACEMENT_OFFSET, FORCE_OFFSET, RIG, SKEW, TEMPERATURE};
pub use loops::{LoopTest, Recorded};
pub use misfit::MAX_MISFIT;
use model::Model;
pub use plan::{PlannedTest, Promise};
pub use predicted::{Predicted, Systematic};
pub use prior::Prior;
use profile::Better;
pub use profile::{Profile, RISE_95};
pub use remedy::{Advice, Remedy};
pub use request::Request;
use residual::residual_rms_n;
pub use rig::HeldRig;
pub use varied::Varied;
pub use warning::Warning;
use warning::{AT_BOUND, Found};

use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_core::CheckedParameters;

use dashpot_files::damper::KeyedParameters;

/// Number of rounds. A round estimates the scatter and then the parameters; the second round changes both by about a
/// percent.
const ROUNDS: usize = 3;

/// Distance from a bound, as a share of the range, within which a parameter counts as at the bound regardless of its
/// interval.
const CERTAINLY_AT_BOUND: f64 = 1e-3;

/// Multiple of the allowed misfit above which the fit is rejected at once, because no weighting of the tests can help.
const HOPELESS_MISFIT: f64 = 2.0;

/// Minimum scatter of a test, divided by its peak force; no sensor is better.
const MIN_SCATTER: f64 = 1e-4;

/// Maximum number of restarts when a profile finds a better minimum.
const MAX_RESTARTS: usize = 5;

/// Two sums of squares belong to the same minimum if they differ by at most this, relatively plus absolutely.
const SAME_MINIMUM: f64 = 1e-3;

/// Reason why a search has no result.
const INVALID_COMBINATION: &str = "the combination of parameters is invalid for a damper";

/// A calibration: the damper, the parameters to vary and the tests.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// Damper at the start.
    pub damper: KeyedParameters,
    /// Parameters that vary.
    pub varied: Vec<Varied>,
    /// Recorded loops.
    pub loops: Vec<LoopTest>,
    /// Tests known only by their indices.
    pub indices: Vec<IndexTest>,
    /// Step of the model (s).
    pub step_s: f64,
    /// Number of starting points of the search.
    pub starts: usize,
    /// Rig parameters that are not varied.
    pub rig: HeldRig,
    /// Assumptions.
    pub assumed: Assumed,
}

/// Assumptions of a calibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumed {
    /// Half-width of the 95 % interval of the oil temperature (K).
    pub temperature_uncertainty_k: f64,
    /// Half-width of the 95 % interval of the oil density (kg/m3).
    pub density_uncertainty_kg_per_m3: f64,
    /// Maximum residual of a test beyond the noise, divided by the rms force (1).
    pub max_misfit: f64,
}

impl Default for Assumed {
    fn default() -> Self {
        Self {
            temperature_uncertainty_k: TEMPERATURE_UNCERTAINTY_K,
            density_uncertainty_kg_per_m3: 0.0,
            max_misfit: MAX_MISFIT,
        }
    }
}

/// Progress of a calibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Name of the current stage.
    pub stage: &'static str,
    /// Number of completed parts of the stage.
    pub done: usize,
    /// Total number of parts of the stage.
    pub total: usize,
}

/// Reports the progress of one stage; several threads may count its parts.
struct Stage<'a> {
    name: &'static str,
    total: usize,
    done: AtomicUsize,
    on_progress: &'a (dyn Fn(Progress) + Sync),
}

impl<'a> Stage<'a> {
    fn new(name: &'static str, total: usize, on_progress: &'a (dyn Fn(Progress) + Sync)) -> Self {
        let stage = Self {
            name,
            total,
            done: AtomicUsize::new(0),
            on_progress,
        };
        stage.report(0);
        stage
    }

    fn report(&self, done: usize) {
        (self.on_progress)(Progress {
            stage: self.name,
            done,
            total: self.total,
        });
    }

    fn complete_one(&self) {
        self.report(self.done.fetch_add(1, Ordering::Relaxed) + 1);
    }
}

/// Result of a calibration.
#[derive(Clone)]
pub struct Calibrated {
    /// Calibrated damper.
    pub damper: CheckedParameters,
    /// Values of the varied parameters, in their order.
    pub values: Vec<f64>,
    /// How well the tests determine each parameter.
    pub determination: Determination,
    /// Likelihood profiles, with intervals from the noise of the tests alone; the assumed parameters count as exact.
    pub profiles: Vec<Profile>,
    /// 95 % intervals, including the uncertainty of the assumed parameters; `None` for an end beyond a bound.
    pub intervals: Vec<[Option<f64>; 2]>,
    /// Effect of each assumed parameter on the calibrated ones.
    pub influences: Vec<Influence>,
    /// Warnings that the user must read along with the values.
    pub warnings: Vec<Warning>,
    /// Fit of each loop.
    pub loops: Vec<LoopFit>,
    /// Outcome of the searches from all starting points.
    pub searches: Searches,
}

/// Outcome of the searches from all starting points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Searches {
    /// Searches that converged.
    pub converged: usize,
    /// Searches that converged to the best minimum.
    pub at_best_minimum: usize,
}

/// Fit of one recorded loop.
#[derive(Clone)]
pub struct LoopFit {
    /// Forces of the damper at the start of the calibration, at the samples that count (N).
    pub before_n: Vec<f64>,
    /// Forces of the calibrated damper at these samples (N).
    pub after_n: Vec<f64>,
    /// Root mean square residual of the damper at the start (N).
    pub missed_before_n: f64,
    /// Root mean square residual of the calibrated damper (N).
    pub missed_after_n: f64,
    /// Correlation length of the calibrated damper's residual in samples; 1 for white noise.
    pub correlation_samples: f64,
}

impl Calibration {
    /// Runs the calibration, reporting progress through `on_progress`.
    ///
    /// # Errors
    /// Returns an error if there is nothing to calibrate, if the damper is invalid, or if the tests do not determine
    /// the parameters.
    pub fn run(
        &self,
        on_progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<Calibrated, CalibrationError> {
        self.run_cancellable(on_progress, &|| false)
    }

    /// Same as [`run`](Self::run), but stops once `is_cancelled` returns true; from then on it must always return true.
    ///
    /// # Errors
    /// Same errors as [`run`](Self::run), and [`CalibrationError::Cancelled`].
    pub fn run_cancellable(
        &self,
        on_progress: &(dyn Fn(Progress) + Sync),
        is_cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<Calibrated, CalibrationError> {
        self.check()?;
        match self.attempt(on_progress, is_cancelled) {
            Err(CalibrationError::Implausible { finding, .. }) => {
                let _stage = Stage::new("causes", 1, on_progress);
                let advice = self.advice(&finding, is_cancelled);
                if advice.is_empty() && !is_cancelled() {
                    // The cause may be a parameter without effect, which the user can remove.
                    self.reject_without_effect(is_cancelled)?;
                }
                match is_cancelled() {
                    true => Err(CalibrationError::Cancelled),
                    false => Err(CalibrationError::Implausible { finding, advice }),
                }
            }
            other => other,
        }
    }

    /// Builds the model of the tests; the scatter of each test is the noise of its force.
    fn model<'a>(&self, is_cancelled: &'a (dyn Fn() -> bool + Sync)) -> Model<'a> {
        let scatter = |test: &LoopTest| test.force_noise_n.max(MIN_SCATTER * test.peak_force_n);
        Model {
            damper: self.damper.clone(),
            varied: self.varied.clone(),
            rig: self.rig,
            loops: self.loops.clone(),
            indices: self.indices.clone(),
            step_s: self.step_s,
            scatter_n: self.loops.iter().map(scatter).collect(),
            is_cancelled,
        }
    }

    /// True if a force of the tests, or a prior, depends on a parameter.
    fn has_effect(&self, determination: &Determination, parameter: usize) -> bool {
        determination.parameters[parameter].has_effect || self.varied[parameter].prior.is_some()
    }

    /// Rejects damper parameters that the tests do not determine; rig parameters may stay undetermined.
    fn reject_undetermined(
        &self,
        determination: &Determination,
        is_determined: &dyn Fn(usize) -> bool,
    ) -> Result<(), CalibrationError> {
        let all = 0..self.varied.len();
        let undetermined = all.filter(|&parameter| {
            !self.varied[parameter].is_rig_parameter() && !is_determined(parameter)
        });
        let parameters: Vec<(String, Determined)> = undetermined
            .map(|parameter| {
                let key = self.varied[parameter].key.clone();
                (key, determination.parameters[parameter].clone())
            })
            .collect();
        match parameters.is_empty() {
            true => Ok(()),
            false => Err(CalibrationError::Undetermined { parameters }),
        }
    }

    /// Rejects parameters on which no force depends near the best coarse fit.
    fn reject_without_effect(
        &self,
        is_cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<(), CalibrationError> {
        let model = self.model(is_cancelled);
        let Some(fit) = model.quick_fit() else {
            return Ok(());
        };
        let determination = model.determination(&fit.coordinates)?;
        self.reject_undetermined(&determination, &|parameter| {
            self.has_effect(&determination, parameter)
        })
    }

    /// Runs the calibration without searching for the cause of an implausible fit.
    ///
    /// # Errors
    /// Same errors as [`run`](Self::run).
    fn attempt(
        &self,
        on_progress: &(dyn Fn(Progress) + Sync),
        is_cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<Calibrated, CalibrationError> {
        self.reject_impossible()?;
        let mut model = self.model(is_cancelled);
        let start: Vec<f64> = self.varied.iter().map(|v| v.coordinate(v.start)).collect();
        let stage = Stage::new("searches", self.starts, on_progress);
        let fits = model.fits(self.starts, &|| stage.complete_one());
        let Some(first) = fits.first() else {
            // All searches failed; the error at the starting values is the reason.
            let reason = model
                .deviations(&start)
                .err()
                .map(|error| error.to_string());
            return Err(CalibrationError::NoFit(
                reason.unwrap_or_else(|| INVALID_COMBINATION.into()),
            ));
        };
        let is_same =
            |fit: &&Fit| fit.chi_square <= first.chi_square * (1.0 + SAME_MINIMUM) + SAME_MINIMUM;
        let searches = Searches {
            converged: fits.len(),
            at_best_minimum: fits.iter().filter(is_same).count(),
        };
        let mut best = first.clone();
        let max_misfit = self.assumed.max_misfit;
        let worst = model.worst_misfit(&best.coordinates)?;
        if worst.is_some_and(|worst| worst.share > HOPELESS_MISFIT * max_misfit) {
            model.reject_misfit(&best.coordinates, max_misfit)?;
        }
        let all: Vec<usize> = (0..self.varied.len()).collect();
        let mut residuals = Vec::new();
        for _ in 0..if self.loops.is_empty() { 0 } else { ROUNDS } {
            residuals = model.residuals(&best.coordinates)?;
            for ((scatter, residual), test) in
                model.scatter_n.iter_mut().zip(&residuals).zip(&self.loops)
            {
                let rms = residual.rms_n.max(MIN_SCATTER * test.peak_force_n);
                *scatter = rms * residual.correlation_samples.sqrt();
            }
            best = model
                .fit(&best.coordinates, &all)
                .ok_or_else(|| CalibrationError::NoFit(INVALID_COMBINATION.into()))?;
        }
        model.reject_misfit(&best.coordinates, max_misfit)?;
        model.reject_bounds(&best.coordinates, CERTAINLY_AT_BOUND, |_, _| true)?;
        let determination = model.determination(&best.coordinates)?;
        let reject = |is_determined: &dyn Fn(usize) -> bool| {
            self.reject_undetermined(&determination, is_determined)
        };
        reject(&|parameter| self.has_effect(&determination, parameter))?;
        let (best, profiles) = self.profiles(&model, best, &determination, on_progress)?;
        let values = model.values(&best.coordinates);
        model.reject_bounds(&best.coordinates, AT_BOUND, |parameter, is_lower| {
            profiles[parameter].is_open(is_lower)
        })?;
        reject(&|parameter| {
            profiles[parameter].is_narrow(&self.varied[parameter], values[parameter])
        })?;
        let before = model.forces_n(&start)?;
        let after = model.forces_n(&best.coordinates)?;
        let forces = before.into_iter().zip(after);
        let loops = forces.zip(&self.loops).zip(&residuals);
        let loops = loops.map(|(((before_n, after_n), test), residual)| LoopFit {
            missed_before_n: residual_rms_n(test, &before_n),
            missed_after_n: residual_rms_n(test, &after_n),
            before_n,
            after_n,
            correlation_samples: residual.correlation_samples,
        });
        let fits: Vec<LoopFit> = loops.collect();
        let influences = self.influences(&model, &best.coordinates)?;
        let intervals = profiles.iter().zip(&values).enumerate();
        let intervals = intervals.map(|(parameter, (profile, value))| {
            let shifts = influences
                .iter()
                .map(move |influence| influence.shifts[parameter]);
            widened(*value, [profile.lower, profile.upper], shifts)
        });
        let intervals = intervals.collect();
        let warnings = Found {
            varied: &self.varied,
            values: &values,
            profiles: &profiles,
            determination: &determination,
            influences: &influences,
            loops: &self.loops,
            fits: &fits,
        }
        .warnings();
        Ok(Calibrated {
            damper: model.damper_at(&best.coordinates)?,
            loops: fits,
            values,
            determination,
            profiles,
            intervals,
            influences,
            warnings,
            searches,
        })
    }

    /// Computes the profiles of all parameters about the best fit; restarts when a profile finds a better minimum.
    fn profiles(
        &self,
        model: &Model<'_>,
        mut best: Fit,
        determination: &Determination,
        on_progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<(Fit, Vec<Profile>), CalibrationError> {
        let all: Vec<usize> = (0..self.varied.len()).collect();
        for _ in 0..MAX_RESTARTS {
            let intervals = Stage::new("intervals", all.len(), on_progress);
            let found = dashpot_workers::map(&all, |&parameter| {
                let profile = model.profile(&best, parameter, &determination.parameters[parameter]);
                intervals.complete_one();
                profile
            });
            match found {
                Ok(profiles) => return Ok((best, profiles)),
                Err(Better(fit)) => {
                    best = model
                        .fit(&fit.coordinates, &all)
                        .filter(|refined| refined.chi_square < fit.chi_square)
                        .unwrap_or(fit);
                }
            }
        }
        Err(CalibrationError::FewStarts {
            starts: self.starts,
        })
    }

    /// Checks that there is something to calibrate, and checks every index test.
    fn check(&self) -> Result<(), CalibrationError> {
        if self.varied.is_empty() {
            return Err(CalibrationError::Nothing("parameter to vary"));
        }
        if self.loops.is_empty() && self.indices.is_empty() {
            return Err(CalibrationError::Nothing("test"));
        }
        for (parameter, varied) in self.varied.iter().enumerate() {
            if self.varied[..parameter]
                .iter()
                .any(|other| other.key == varied.key)
            {
                let key = varied.key.clone();
                return Err(CalibrationError::Twice { key });
            }
        }
        for (test_number, test) in (1..).zip(&self.indices) {
            test.check().map_err(|reason| CalibrationError::Index {
                test: test_number,
                reason,
            })?;
        }
        Ok(())
    }
}
