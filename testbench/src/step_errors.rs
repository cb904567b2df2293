//! Maximum errors of the fixed step for one damper over the fixed set of motions of `dashpot_reference::probing`.

use dashpot_core::{CheckedParameters, Damper, Real};
use dashpot_reference::probing::{
    LargestErrors, MIN_ERROR_RATIO, Motion, MotionErrors, Probing, Worst,
};
use serde::Serialize;

use super::TestbenchError;
use dashpot_files::Scalar;

/// Scalar types, in the order in which their errors are returned.
pub const SCALARS: [Scalar; 2] = [Scalar::F64, Scalar::F32];

/// Kind and speed of a motion.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct NamedMotion {
    /// Kind.
    pub kind: &'static str,
    /// Speed (m/s).
    pub speed_m_per_s: f64,
}

impl From<&Worst> for NamedMotion {
    fn from(worst: &Worst) -> Self {
        Self {
            kind: worst.kind.name(),
            speed_m_per_s: worst.speed_m_per_s,
        }
    }
}

/// Largest errors for one step size and scalar type.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct StepErrorRow {
    /// Scalar type.
    pub scalar: Scalar,
    /// Step (s).
    pub step_s: f64,
    /// Root mean square error of the worst motion over the root mean square force (1).
    pub nrmse: f64,
    /// That motion.
    pub nrmse_motion: NamedMotion,
    /// Largest error at a tick (N).
    pub largest_error_n: f64,
    /// The same over the force limit (1).
    pub largest_error_over_limit: f64,
    /// The motion with the largest error.
    pub largest_error_motion: NamedMotion,
    /// Largest force at a tick where the reference force has the opposite sign or is zero (N).
    pub largest_wrong_sign_n: f64,
    /// Promised NRMSE of any motion of the class (1).
    pub promised_nrmse: f64,
    /// Promised error at a tick of any motion of the class (N).
    pub promised_error_n: f64,
}

/// A damper built in both scalar types for one step size, and its reference solution.
pub struct StepErrors<'a> {
    single: Damper<f32>,
    double: Damper<f64>,
    probing: Probing<'a>,
    step_s: f64,
}

impl<'a> StepErrors<'a> {
    /// Builds a damper with steps of `step_s` (s). The motions reach `top_speed_m_per_s`; `None` keeps the top speed of
    /// the fixed set.
    ///
    /// # Errors
    /// Returns an error if the damper cannot be built for this step.
    pub fn new(
        parameters: &'a CheckedParameters,
        step_s: f64,
        top_speed_m_per_s: Option<f64>,
    ) -> Result<Self, TestbenchError> {
        let probing = Probing::new(parameters, step_s);
        Ok(Self {
            single: parameters.build(step_s)?,
            double: parameters.build(step_s)?,
            probing: match top_speed_m_per_s {
                Some(speed) => probing.with_top_speed(speed),
                None => probing,
            },
            step_s,
        })
    }

    /// Returns the top speed of the motions (m/s).
    pub fn top_speed_m_per_s(&self) -> f64 {
        self.probing.top_speed_m_per_s()
    }

    /// Returns the force limit of the damper (N).
    pub fn force_limit_n(&self) -> f64 {
        self.double.force_limit_n()
    }

    /// Returns the maximum errors over the fixed set for each of [`SCALARS`], computed by `threads` threads.
    ///
    /// # Errors
    /// Returns the errors of the reference solver.
    pub fn largest(&self, threads: usize) -> Result<[LargestErrors; 2], TestbenchError> {
        let [double, single] = self.steppers();
        let found = self.probing.largest_errors(&[&double, &single], threads)?;
        Ok([found[0], found[1]])
    }

    /// Returns a row for each of [`SCALARS`] with the largest errors over the fixed set, computed by `threads` threads.
    ///
    /// # Errors
    /// Returns the errors of the reference solver.
    pub fn rows(&self, threads: usize) -> Result<[StepErrorRow; 2], TestbenchError> {
        let found = self.largest(threads)?;
        let (promised, limit_n) = (self.promised(&found), self.force_limit_n());
        Ok([0, 1].map(|number| {
            let (largest, (promised_error_n, promised_nrmse)) = (&found[number], promised[number]);
            StepErrorRow {
                scalar: SCALARS[number],
                step_s: self.step_s,
                nrmse: largest.nrmse.value,
                nrmse_motion: (&largest.nrmse).into(),
                largest_error_n: largest.largest_n.value,
                largest_error_over_limit: largest.largest_n.value / limit_n,
                largest_error_motion: (&largest.largest_n).into(),
                largest_wrong_sign_n: largest.wrong_sign_n.value,
                promised_nrmse,
                promised_error_n,
            }
        }))
    }

    /// Returns the errors on one motion for each of [`SCALARS`].
    ///
    /// # Errors
    /// Returns the errors of the reference solver.
    pub fn on_motion(&self, motion: &Motion) -> Result<[MotionErrors; 2], TestbenchError> {
        let [double, single] = self.steppers();
        let found = self.probing.errors(motion, &[&double, &single])?;
        Ok([found[0], found[1]])
    }

    /// Returns the limits promised for any motion of the class, given the `largest` errors found: for each of
    /// [`SCALARS`] the maximum error at a tick (N) and the maximum NRMSE (1).
    pub fn promised(&self, largest: &[LargestErrors; 2]) -> [(f64, f64); 2] {
        let limit_n = self.force_limit_n();
        [0, 1].map(|scalar| largest[scalar].promised(limit_n, MIN_ERROR_RATIO[scalar]))
    }

    fn steppers(&self) -> [Stepper<'_>; 2] {
        [
            Box::new(|x| fixed_step_forces(&self.double, x)),
            Box::new(|x| fixed_step_forces(&self.single, x)),
        ]
    }
}

/// Function from displacements (m) at the ticks to forces (N).
type Stepper<'a> = Box<dyn Fn(&[f64]) -> Vec<f64> + Sync + 'a>;

/// Returns the force (N) at each displacement (m), starting at rest at the first one.
fn fixed_step_forces<T: Real>(damper: &Damper<T>, displacements_m: &[f64]) -> Vec<f64> {
    let start = displacements_m.first().copied().unwrap_or(0.0);
    let mut state = damper.at_rest(T::from_f64(start));
    let displacements = displacements_m.iter();
    displacements
        .map(|&x| damper.step(&mut state, T::from_f64(x)).to_f64())
        .collect()
}
