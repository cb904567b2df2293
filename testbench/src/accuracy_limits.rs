//! The accuracy that the shipped dampers keep over the shipped motions at 1 kHz and at 10 kHz: docs/numerics.md, "What
//! the accuracy promise covers". What is promised for any other damper is in [`super::step_errors`].

use dashpot_core::DamperParameters;
use dashpot_reference::deviation::root_mean_square;

use dashpot_files::Scalar;

/// Largest NRMSE of the fixed step for shipped dampers and motions with a relaxation time of at least so much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccuracyLimits {
    /// Least relaxation time (s), see [`relaxation_time_s`].
    pub least_relaxation_time_s: f64,
    /// Largest NRMSE at 1 kHz, in either scalar (1).
    pub nrmse_1_khz: f64,
    /// Largest NRMSE at 10 kHz in `f64` (1).
    pub nrmse_10_khz_f64: f64,
    /// Largest NRMSE at 10 kHz in `f32` (1).
    pub nrmse_10_khz_f32: f64,
}

/// The limits, the longest relaxation time first; there is none below the last.
pub const ACCURACY_LIMITS: [AccuracyLimits; 2] = [
    AccuracyLimits {
        least_relaxation_time_s: 3e-3,
        nrmse_1_khz: 1e-3,
        nrmse_10_khz_f64: 3e-5,
        nrmse_10_khz_f32: 6e-5,
    },
    AccuracyLimits {
        least_relaxation_time_s: 1.5e-3,
        nrmse_1_khz: 3e-3,
        nrmse_10_khz_f64: 3e-5,
        nrmse_10_khz_f32: 6e-5,
    },
];

impl AccuracyLimits {
    /// The limits for a relaxation time (s); `None` where there are none.
    pub fn of(relaxation_time_s: f64) -> Option<&'static Self> {
        ACCURACY_LIMITS
            .iter()
            .find(|promise| relaxation_time_s >= promise.least_relaxation_time_s)
    }

    /// Largest NRMSE with a step of `step_s` (s) in `scalar`: that at 10 kHz up to 100 us, that at 1 kHz up to 1 ms,
    /// `None` above.
    ///
    /// ```
    /// use dashpot_files::Scalar;
    /// use dashpot_testbench::accuracy_limits::ACCURACY_LIMITS;
    /// assert_eq!(ACCURACY_LIMITS[0].nrmse(1e-4, Scalar::F32), Some(6e-5));
    /// assert_eq!(ACCURACY_LIMITS[0].nrmse(250e-6, Scalar::F32), Some(1e-3));
    /// assert_eq!(ACCURACY_LIMITS[0].nrmse(2e-3, Scalar::F32), None);
    /// ```
    pub fn nrmse(&self, step_s: f64, scalar: Scalar) -> Option<f64> {
        // 1/10000 s may be written in several ways.
        let is_up_to = |longest_s: f64| step_s <= longest_s * (1.0 + 1e-9);
        match scalar {
            Scalar::F64 if is_up_to(1e-4) => Some(self.nrmse_10_khz_f64),
            Scalar::F32 if is_up_to(1e-4) => Some(self.nrmse_10_khz_f32),
            _ => is_up_to(1e-3).then_some(self.nrmse_1_khz),
        }
    }
}

/// Relaxation time of a damper on a motion (s): rms force over rms velocity and stiffness of the springs in
/// series, `F/(v Ke)`. The motion has `displacements_m` (m) at ticks of `step_s` (s), and `forces_n` (N) there.
pub fn relaxation_time_s(
    parameters: &DamperParameters,
    step_s: f64,
    displacements_m: &[f64],
    forces_n: &[f64],
) -> f64 {
    let velocities = displacements_m.windows(2).map(|x| (x[1] - x[0]) / step_s);
    root_mean_square(forces_n.iter().copied()) / root_mean_square(velocities)
        * parameters.mount.compliance_m_per_n()
}
