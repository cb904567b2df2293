//! The largest errors of the fixed step for one damper, over the fixed set of motions of `dashpot_reference::probing`.

use dashpot_core::{CheckedParameters, Damper, Real};
use dashpot_reference::probing::{LargestErrors, MIN_ERROR_RATIO, Motion, MotionErrors, Probing};

use super::TestbenchError;
use dashpot_files::Scalar;

/// The scalars, in the order in which their errors are found.
pub const SCALARS: [Scalar; 2] = [Scalar::F64, Scalar::F32];

/// A damper built in both scalars for one step size, beside the reference.
pub struct StepErrors<'a> {
    single: Damper<f32>,
    double: Damper<f64>,
    probing: Probing<'a>,
}

impl<'a> StepErrors<'a> {
    /// A damper with steps of `step_s` (s), whose motions have a top speed (m/s), or the set's own.
    ///
    /// # Errors
    /// A step that the damper cannot be built for.
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

    /// Top speed of the motions (m/s).
    pub fn top_speed_m_per_s(&self) -> f64 {
        self.probing.top_speed_m_per_s()
    }

    /// Force at which the damper yields (N).
    pub fn force_limit_n(&self) -> f64 {
        self.double.force_limit_n()
    }

    /// The largest errors over the fixed set in each of [`SCALARS`], found by several threads.
    ///
    /// # Errors
    /// What the reference reports.
    pub fn largest(&self, threads: usize) -> Result<[LargestErrors; 2], TestbenchError> {
        let [double, single] = self.steppers();
        let found = self.probing.largest_errors(&[&double, &single], threads)?;
        Ok([found[0], found[1]])
    }

    /// Errors on one motion in each of [`SCALARS`].
    ///
    /// # Errors
    /// What the reference reports.
    pub fn on(&self, motion: &Motion) -> Result<[MotionErrors; 2], TestbenchError> {
        let [double, single] = self.steppers();
        let found = self.probing.errors(motion, &[&double, &single])?;
        Ok([found[0], found[1]])
    }

    /// What `largest` promises for any motion of the class in each of [`SCALARS`]: the largest error at a tick (N) and
    /// the largest NRMSE (1).
    pub fn promised(&self, largest: &[LargestErrors; 2]) -> [(f64, f64); 2] {
        let limit_n = self.force_limit_n();
        [0, 1].map(|scalar| largest[scalar].promised(limit_n, MIN_ERROR_RATIO[scalar]))
    }

    fn steppers(&self) -> [Stepper<'_>; 2] {
        [
            Box::new(|x| stepped(&self.double, x)),
            Box::new(|x| stepped(&self.single, x)),
        ]
    }
}

/// From displacements (m) at the ticks to forces (N).
type Stepper<'a> = Box<dyn Fn(&[f64]) -> Vec<f64> + Sync + 'a>;

/// Forces (N) at each displacement (m), from rest at the first.
fn stepped<T: Real>(damper: &Damper<T>, displacements_m: &[f64]) -> Vec<f64> {
    let start = displacements_m.first().copied().unwrap_or(0.0);
    let mut state = damper.at_rest(T::from_f64(start));
    let displacements = displacements_m.iter();
    displacements
        .map(|&x| damper.step(&mut state, T::from_f64(x)).to_f64())
        .collect()
}
