//! Largest errors of the fixed step with one damper over a fixed set of motions.
//!
//! The set is scaled to the damper so that it includes the worst cases: motions pass the damper's clearance, friction
//! and the corners of its law, at speeds from those that cause its smallest forces up to the top speed. The caller
//! supplies the forces of the fixed step, because this crate knows only the parameters, not the step.

mod errors;
mod motion;
mod set;

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_core::DamperParameters;

pub use self::errors::{MIN_RMS_FORCE_RATIO, MotionErrors};
pub use self::motion::{Kind, Motion};
use self::set::Scale;
use crate::damper::Reference;
use crate::error::ReferenceError;

/// Default top speed of the motions (m/s); a lower input rate limit of the damper reduces it.
pub const TOP_SPEED_M_PER_S: f64 = 0.6;

/// Safety factor between [`Probing::largest_errors`] and the promised errors. The promise holds for every motion of the
/// class defined in docs/numerics.md. The errors that the search for the worst motion (`cargo xtask search`) finds stay
/// below it.
pub const PROMISED_FACTOR: f64 = 3.0;

/// Smallest promised error at a tick as a fraction of the force limit (1), in double and in single precision.
pub const MIN_ERROR_RATIO: [f64; 2] = [1e-6, 1e-5];

/// Computes the force (N) of a fixed step at each displacement (m), from rest at the first one.
pub type Stepper<'a> = &'a (dyn Fn(&[f64]) -> Vec<f64> + Sync);

/// Probes one damper at one step size.
pub struct Probing<'a> {
    parameters: &'a DamperParameters,
    step_s: f64,
    top_m_per_s: f64,
}

/// A figure, and the motion that caused it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Value of the figure.
    pub value: f64,
    /// Kind of the motion.
    pub kind: Kind,
    /// Largest or RMS speed of the motion (m/s).
    pub speed_m_per_s: f64,
}

/// The largest errors of one fixed step over the set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestErrors {
    /// Largest error at a tick (N).
    pub largest_n: Worst,
    /// Largest [`MotionErrors::nrmse`] of a motion (1).
    pub nrmse: Worst,
    /// Largest force where the reference force is zero or has the opposite sign (N).
    pub wrong_sign_n: Worst,
}

impl<'a> Probing<'a> {
    /// Probes a damper with steps of `step_s` (s) at up to [`TOP_SPEED_M_PER_S`].
    pub fn new(parameters: &'a DamperParameters, step_s: f64) -> Self {
        let top_m_per_s = TOP_SPEED_M_PER_S.min(highest_speed(parameters));
        Self {
            parameters,
            step_s,
            top_m_per_s,
        }
    }

    /// Sets another top speed (m/s); it is reduced if the damper's input rate limit is lower.
    pub fn with_top_speed(self, speed_m_per_s: f64) -> Self {
        Self {
            top_m_per_s: speed_m_per_s.min(highest_speed(self.parameters)),
            ..self
        }
    }

    /// Top speed of the motions (m/s).
    pub fn top_speed_m_per_s(&self) -> f64 {
        self.top_m_per_s
    }

    /// Builds the fixed set of motions.
    ///
    /// # Errors
    /// The errors of [`Reference::new`].
    pub fn motions(&self) -> Result<Vec<Motion>, ReferenceError> {
        let reference = Reference::new(self.parameters)?;
        Ok(Scale {
            sides: reference.sides(),
            clearance_m: self.parameters.mount.clearance_m,
            step_s: self.step_s,
            top_m_per_s: self.top_m_per_s,
        }
        .motions())
    }

    /// Computes the errors of each stepper on a motion.
    ///
    /// # Errors
    /// The errors of the reference.
    pub fn errors(
        &self,
        motion: &Motion,
        steppers: &[Stepper<'_>],
    ) -> Result<Vec<MotionErrors>, ReferenceError> {
        let mut reference = Reference::new(self.parameters)?;
        let ticks = motion.compared.iter();
        let (times, displacements): (Vec<f64>, Vec<f64>) = ticks
            .map(|tick| (*tick as f64 * self.step_s, motion.displacements_m[*tick]))
            .unzip();
        let expected = reference.forces(&times, &displacements)?;
        let limit_n = reference.force_limit_n();
        let errors = steppers.iter().map(|stepper| {
            let forces = stepper(&motion.displacements_m);
            MotionErrors::new(motion, &forces, &expected, limit_n)
        });
        Ok(errors.collect())
    }

    /// Computes the largest errors of each stepper over the fixed set on several threads.
    ///
    /// # Errors
    /// The error of the reference for the first motion that it cannot solve.
    pub fn largest_errors(
        &self,
        steppers: &[Stepper<'_>],
        threads: usize,
    ) -> Result<Vec<LargestErrors>, ReferenceError> {
        let motions = self.motions()?;
        let next = AtomicUsize::new(0);
        let found = Mutex::new(Vec::with_capacity(motions.len()));
        let work = || {
            while let Some(motion) = motions.get(next.fetch_add(1, Ordering::Relaxed)) {
                let errors = self.errors(motion, steppers);
                if errors.is_err() {
                    next.store(motions.len(), Ordering::Relaxed);
                }
                if let Ok(mut found) = found.lock() {
                    found.push((motion, errors));
                }
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..threads {
                scope.spawn(work);
            }
            work();
        });
        let mut largest: Vec<Option<LargestErrors>> = vec![None; steppers.len()];
        let found = found.into_inner().unwrap_or_default();
        for (motion, errors) in found {
            for (largest, errors) in largest.iter_mut().zip(errors?) {
                *largest = Some(LargestErrors::with(*largest, motion, &errors));
            }
        }
        Ok(largest.into_iter().flatten().collect())
    }
}

/// Highest speed (m/s) that the damper's rate limit accepts, with a margin for rounding.
fn highest_speed(parameters: &DamperParameters) -> f64 {
    0.999 * parameters.limits.rate_m_per_s
}

impl LargestErrors {
    /// Returns the promised largest error at a tick (N) and largest NRMSE (1) for any motion of the class.
    /// `force_limit_n` is the damper's limit (N); `min_ratio` is the entry of [`MIN_ERROR_RATIO`] for the scalar type.
    pub fn promised(&self, force_limit_n: f64, min_ratio: f64) -> (f64, f64) {
        let largest_n = PROMISED_FACTOR * self.largest_n.value;
        (
            largest_n.max(min_ratio * force_limit_n),
            (PROMISED_FACTOR * self.nrmse.value).max(min_ratio),
        )
    }

    /// Combines the largest errors so far with the errors of a motion; NaN counts as the largest. Ties keep the slower
    /// motion, so that the result does not depend on the order in which threads finish.
    fn with(found: Option<Self>, motion: &Motion, errors: &MotionErrors) -> Self {
        let worst = |value: f64| Worst {
            value,
            kind: motion.kind,
            speed_m_per_s: motion.speed_m_per_s,
        };
        let larger = |a: Worst, value: f64| {
            let b = worst(value);
            let order = a.value.total_cmp(&b.value);
            let order = order.then(b.speed_m_per_s.total_cmp(&a.speed_m_per_s));
            if order.is_ge() { a } else { b }
        };
        match found {
            None => Self {
                largest_n: worst(errors.largest_n),
                nrmse: worst(errors.nrmse),
                wrong_sign_n: worst(errors.wrong_sign_n),
            },
            Some(found) => Self {
                largest_n: larger(found.largest_n, errors.largest_n),
                nrmse: larger(found.nrmse, errors.nrmse),
                wrong_sign_n: larger(found.wrong_sign_n, errors.wrong_sign_n),
            },
        }
    }
}
