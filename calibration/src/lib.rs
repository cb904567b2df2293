#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod determined;
mod diagnosis;
mod error;
mod fit;
mod indices;
mod influence;
mod left;
mod loops;
mod misfit;
mod model;
mod plausible;
mod profile;
mod remedy;
mod request;
mod rig;
mod varied;
mod warning;

pub use determined::{CLOSE, Determination, Determined};
pub use error::CalibrationError;
use fit::Fit;
pub use indices::IndexTest;
use influence::widened;
pub use influence::{DENSITY, Influence, TEMPERATURE, TEMPERATURE_UNCERTAINTY_K};
use left::missed_n;
pub use loops::{LoopTest, Recorded};
pub use misfit::{Finding, MOST_MISSED};
use model::Model;
use profile::Better;
pub use profile::{Profile, RISE_95};
pub use remedy::{Advice, Remedy};
pub use request::Request;
pub use rig::{DISPLACEMENT_OFFSET, FORCE_OFFSET, HeldRig, RIG, SKEW};
pub use varied::{Prior, Varied};
pub use warning::Warning;
use warning::{AT_BOUND, Found};

use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_core::CheckedParameters;

use dashpot_files::damper::Keyed;

/// Rounds in which the scatter of the tests and the numbers are found in turn: the second changes both by a percent.
const ROUNDS: usize = 3;

/// Share of the way between its bounds within which a number is at one, whatever its interval.
const AT_BOUND_CERTAINLY: f64 = 1e-3;

/// A model that misses so many times what is allowed does so with any weights of the tests.
const HOPELESS: f64 = 2.0;

/// Least scatter of a test, of its peak force: no sensor is better.
const LEAST_SCATTER: f64 = 1e-4;

/// Better minima that are taken up while intervals are searched, at most.
const ANEW: usize = 5;

/// Two sums of squares are the same minimum within this, relative and absolute.
const SAME_MINIMUM: f64 = 1e-3;

/// What is calibrated, and from what.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// The damper before.
    pub damper: Keyed,
    /// Numbers that vary.
    pub varied: Vec<Varied>,
    /// Recorded loops.
    pub loops: Vec<LoopTest>,
    /// Tests of which the indices are known.
    pub indices: Vec<IndexTest>,
    /// The step of the model (s).
    pub step_s: f64,
    /// Starts of the search.
    pub starts: usize,
    /// The rig's numbers where they are not varied.
    pub rig: HeldRig,
    /// What is taken for granted.
    pub assumed: Assumed,
}

/// What a calibration takes for granted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumed {
    /// Half of the interval of 95 % of the oil's temperature (K).
    pub temperature_uncertainty_k: f64,
    /// Half of the interval of 95 % of the oil's density (kg/m3).
    pub density_uncertainty_kg_per_m3: f64,
    /// Part of the force's root mean square that the model may miss of a test, beyond the noise.
    pub most_missed: f64,
}

impl Default for Assumed {
    fn default() -> Self {
        Self {
            temperature_uncertainty_k: TEMPERATURE_UNCERTAINTY_K,
            density_uncertainty_kg_per_m3: 0.0,
            most_missed: MOST_MISSED,
        }
    }
}

/// How far a calibration is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// What is done.
    pub stage: &'static str,
    /// Parts of it that are done.
    pub done: usize,
    /// Parts that it has.
    pub of: usize,
}

/// The parts of a stage, counted by whoever does them.
struct Stage<'a> {
    name: &'static str,
    of: usize,
    done: AtomicUsize,
    tell: &'a (dyn Fn(Progress) + Sync),
}

impl<'a> Stage<'a> {
    fn new(name: &'static str, of: usize, tell: &'a (dyn Fn(Progress) + Sync)) -> Self {
        let stage = Self {
            name,
            of,
            done: AtomicUsize::new(0),
            tell,
        };
        stage.tell(0);
        stage
    }

    fn tell(&self, done: usize) {
        (self.tell)(Progress {
            stage: self.name,
            done,
            of: self.of,
        });
    }

    fn one_more(&self) {
        self.tell(self.done.fetch_add(1, Ordering::Relaxed) + 1);
    }
}

/// What was found.
#[derive(Clone)]
pub struct Calibrated {
    /// The damper.
    pub damper: CheckedParameters,
    /// The varied numbers, in their order.
    pub values: Vec<f64>,
    /// What the tests tell of them.
    pub determination: Determination,
    /// Their intervals by the noise of the tests, the assumed numbers being exact.
    pub profiles: Vec<Profile>,
    /// Their intervals of 95 %, the uncertainty of the assumed numbers included; `None` where a bound comes first.
    pub intervals: Vec<[Option<f64>; 2]>,
    /// What the assumed numbers do to them.
    pub influences: Vec<Influence>,
    /// What the numbers alone do not say.
    pub warnings: Vec<Warning>,
    /// Of each loop.
    pub loops: Vec<LoopFit>,
    /// Starts that led to the same minimum, of those that led to one.
    pub same_minimum: [usize; 2],
}

/// A loop beside the model.
#[derive(Clone)]
pub struct LoopFit {
    /// Forces of the model at the samples that count, before (N).
    pub before_n: Vec<f64>,
    /// After (N).
    pub after_n: Vec<f64>,
    /// Root mean square of what the model misses, before (N).
    pub missed_before_n: f64,
    /// After (N).
    pub missed_after_n: f64,
    /// Correlation time of that (samples).
    pub correlation_samples: f64,
}

impl Calibration {
    /// Finds the numbers; `tell` is told how far it is.
    ///
    /// # Errors
    /// Nothing to do, a damper that cannot be, or numbers that the tests do not determine: then none are told.
    pub fn run(&self, tell: &(dyn Fn(Progress) + Sync)) -> Result<Calibrated, CalibrationError> {
        self.run_cancellable(tell, &|| false)
    }

    /// As [`run`](Self::run), until the numbers are unwanted, as they then stay.
    ///
    /// # Errors
    /// As [`run`](Self::run); numbers that have become unwanted.
    pub fn run_cancellable(
        &self,
        tell: &(dyn Fn(Progress) + Sync),
        is_cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<Calibrated, CalibrationError> {
        self.check()?;
        match self.attempt(tell, is_cancelled) {
            Err(CalibrationError::Implausible { finding, .. }) => {
                let _stage = Stage::new("causes", 1, tell);
                let advice = self.advice(&finding, is_cancelled);
                if advice.is_empty() && !is_cancelled() {
                    // A number in vain is a cause that a user can remove.
                    self.refuse_unfelt(is_cancelled)?;
                }
                match is_cancelled() {
                    true => Err(CalibrationError::Cancelled),
                    false => Err(CalibrationError::Implausible { finding, advice }),
                }
            }
            other => other,
        }
    }

    /// The model of the tests, which scatter by the noise of their forces.
    fn model<'a>(&self, is_cancelled: &'a (dyn Fn() -> bool + Sync)) -> Model<'a> {
        let scatter = |test: &LoopTest| test.force_noise_n.max(LEAST_SCATTER * test.peak_force_n);
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

    /// Whether a force of the tests, or a prior, depends on a number.
    fn is_felt(&self, determination: &Determination, number: usize) -> bool {
        determination.numbers[number].is_felt || self.varied[number].prior.is_some()
    }

    /// Refuses numbers that the tests do not determine. Those of the rig are not what is asked for.
    fn refuse_undetermined(
        &self,
        determination: &Determination,
        is_determined: &dyn Fn(usize) -> bool,
    ) -> Result<(), CalibrationError> {
        let all = 0..self.varied.len();
        let refused =
            all.filter(|&number| !self.varied[number].is_of_rig() && !is_determined(number));
        let numbers: Vec<(String, Determined)> = refused
            .map(|number| {
                let key = self.varied[number].key.clone();
                (key, determination.numbers[number].clone())
            })
            .collect();
        match numbers.is_empty() {
            true => Ok(()),
            false => Err(CalibrationError::Undetermined { numbers }),
        }
    }

    /// Refuses numbers that no force near the best coarse fit depends on.
    fn refuse_unfelt(
        &self,
        is_cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<(), CalibrationError> {
        let model = self.model(is_cancelled);
        let Some(fit) = model.quick_fit() else {
            return Ok(());
        };
        let determination = model.determination(&fit.places)?;
        self.refuse_undetermined(&determination, &|number| {
            self.is_felt(&determination, number)
        })
    }

    /// The numbers, without a search for what else may be wrong where they are no damper's.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    fn attempt(
        &self,
        tell: &(dyn Fn(Progress) + Sync),
        is_cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<Calibrated, CalibrationError> {
        self.refuse_impossible()?;
        let mut model = self.model(is_cancelled);
        let start: Vec<f64> = self.varied.iter().map(|v| v.place(v.start)).collect();
        let searches = Stage::new("searches", self.starts, tell);
        let fits = model.fits(self.starts, &|| searches.one_more());
        let Some(first) = fits.first() else {
            // What fails at the start fails everywhere.
            let reason = model
                .deviations(&start)
                .err()
                .map(|error| error.to_string());
            return Err(CalibrationError::NoFit(
                reason.unwrap_or_else(|| "numbers that no damper has together".into()),
            ));
        };
        let is_same =
            |fit: &&Fit| fit.chi_square <= first.chi_square * (1.0 + SAME_MINIMUM) + SAME_MINIMUM;
        let same_minimum = [fits.iter().filter(is_same).count(), fits.len()];
        let mut best = first.clone();
        let most = self.assumed.most_missed;
        let worst = model.worst_misfit(&best.places)?;
        if worst.is_some_and(|worst| worst.share > HOPELESS * most) {
            model.refuse_misfit(&best.places, most)?;
        }
        let all: Vec<usize> = (0..self.varied.len()).collect();
        let mut left = Vec::new();
        for _ in 0..if self.loops.is_empty() { 0 } else { ROUNDS } {
            left = model.left(&best.places)?;
            for ((scatter, left), test) in model.scatter_n.iter_mut().zip(&left).zip(&self.loops) {
                let rms = left.rms_n.max(LEAST_SCATTER * test.peak_force_n);
                *scatter = rms * left.correlation_samples.sqrt();
            }
            best = model.fit(&best.places, &all).ok_or_else(|| {
                CalibrationError::NoFit("numbers that no damper has together".into())
            })?;
        }
        model.refuse_misfit(&best.places, self.assumed.most_missed)?;
        model.refuse_bounds(&best.places, AT_BOUND_CERTAINLY, |_, _| true)?;
        let determination = model.determination(&best.places)?;
        let refuse = |is_determined: &dyn Fn(usize) -> bool| {
            self.refuse_undetermined(&determination, is_determined)
        };
        refuse(&|number| self.is_felt(&determination, number))?;
        let (best, profiles) = self.profiles(&model, best, &determination, tell)?;
        let values = model.values(&best.places);
        model.refuse_bounds(&best.places, AT_BOUND, |number, is_least| {
            profiles[number].is_open(is_least)
        })?;
        refuse(&|number| profiles[number].is_narrow(&self.varied[number], values[number]))?;
        let before = model.forces_n(&start)?;
        let after = model.forces_n(&best.places)?;
        let forces = before.into_iter().zip(after);
        let loops = forces.zip(&self.loops).zip(&left);
        let loops = loops.map(|(((before_n, after_n), test), left)| LoopFit {
            missed_before_n: missed_n(test, &before_n),
            missed_after_n: missed_n(test, &after_n),
            before_n,
            after_n,
            correlation_samples: left.correlation_samples,
        });
        let fits: Vec<LoopFit> = loops.collect();
        let influences = self.influences(&model, &best.places)?;
        let intervals = profiles.iter().zip(&values).enumerate();
        let intervals = intervals.map(|(number, (profile, value))| {
            let shifts = influences
                .iter()
                .map(move |influence| influence.shifts[number]);
            widened(*value, [profile.least, profile.greatest], shifts)
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
            damper: model.damper_at(&best.places)?,
            loops: fits,
            values,
            determination,
            profiles,
            intervals,
            influences,
            warnings,
            same_minimum,
        })
    }

    /// The profiles of all numbers about the best fit, begun anew from a better one where a profile meets that.
    fn profiles(
        &self,
        model: &Model<'_>,
        mut best: Fit,
        determination: &Determination,
        tell: &(dyn Fn(Progress) + Sync),
    ) -> Result<(Fit, Vec<Profile>), CalibrationError> {
        let all: Vec<usize> = (0..self.varied.len()).collect();
        for _ in 0..ANEW {
            let intervals = Stage::new("intervals", all.len(), tell);
            let found = dashpot_workers::map(&all, |&number| {
                let profile = model.profile(&best, number, &determination.numbers[number]);
                intervals.one_more();
                profile
            });
            match found {
                Ok(profiles) => return Ok((best, profiles)),
                Err(Better(fit)) => {
                    best = model
                        .fit(&fit.places, &all)
                        .filter(|refined| refined.chi_square < fit.chi_square)
                        .unwrap_or(fit);
                }
            }
        }
        Err(CalibrationError::FewStarts {
            starts: self.starts,
        })
    }

    fn check(&self) -> Result<(), CalibrationError> {
        if self.varied.is_empty() {
            return Err(CalibrationError::Nothing("number to vary"));
        }
        if self.loops.is_empty() && self.indices.is_empty() {
            return Err(CalibrationError::Nothing("test"));
        }
        for (number, varied) in self.varied.iter().enumerate() {
            if self.varied[..number]
                .iter()
                .any(|other| other.key == varied.key)
            {
                let key = varied.key.clone();
                return Err(CalibrationError::Twice { key });
            }
        }
        for (number, test) in self.indices.iter().enumerate() {
            let test_number = number + 1;
            test.check().map_err(|reason| CalibrationError::Index {
                test: test_number,
                reason,
            })?;
        }
        Ok(())
    }
}
