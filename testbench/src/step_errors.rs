//! Maximum errors of the fixed step for one damper over the fixed set of motions of `dashpot_reference::probing`.

use dashpot_core::{CheckedParameters, Damper, Real};
use dashpot_reference::probing::{LargestErrors, MIN_ERROR_RATIO, Motion, MotionErrors, Probing};

use super::TestbenchError;
use dashpot_files::Scalar;

/// Scalar types, in the order in which their errors are returned.
pub const SCALARS: [Scalar; 2] = [Scalar::F64, Scalar::F32];

/// A damper built in both scalar types for one step size, and its reference solution.
pub struct StepErrors<'a> {
    single: Damper<f32>,
    double: Damper<f64>,
    probing: Probing<'a>,
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
