//! Accuracy limits of the shipped dampers on the shipped motions at 1 kHz and at 10 kHz; see docs/numerics.md, "What
//! the accuracy promise covers". For any other damper, see [`super::step_errors`].

use dashpot_core::DamperParameters;
use dashpot_reference::deviation::root_mean_square;

use dashpot_files::Scalar;

/// Maximum NRMSE of the fixed step on shipped motions, for shipped dampers whose relaxation time is above a minimum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccuracyLimits {
    /// Minimum relaxation time (s), see [`relaxation_time_s`].
    pub min_relaxation_time_s: f64,
    /// Maximum NRMSE at 1 kHz, in either scalar type (1).
    pub nrmse_1_khz: f64,
    /// Maximum NRMSE at 10 kHz in `f64` (1).
    pub nrmse_10_khz_f64: f64,
    /// Maximum NRMSE at 10 kHz in `f32` (1).
    pub nrmse_10_khz_f32: f64,
}

/// Limits in order of falling relaxation time; there is no promise for relaxation times below the last one.
pub const ACCURACY_LIMITS: [AccuracyLimits; 2] = [
    AccuracyLimits {
        min_relaxation_time_s: 3e-3,
        nrmse_1_khz: 1e-3,
        nrmse_10_khz_f64: 3e-5,
        nrmse_10_khz_f32: 6e-5,
    },
    AccuracyLimits {
        min_relaxation_time_s: 1.5e-3,
        nrmse_1_khz: 3e-3,
        nrmse_10_khz_f64: 3e-5,
        nrmse_10_khz_f32: 6e-5,
    },
];

impl AccuracyLimits {
    /// Returns the limits for a relaxation time (s); `None` if it is below all limits.
    pub fn for_relaxation_time(relaxation_time_s: f64) -> Option<&'static Self> {
        ACCURACY_LIMITS
            .iter()
            .find(|promise| relaxation_time_s >= promise.min_relaxation_time_s)
    }

    /// Returns the maximum NRMSE for a step of `step_s` (s) in `scalar`: the 10 kHz limit for steps up to 100 us, the
    /// 1 kHz limit up to 1 ms, `None` above.
    ///
    /// ```
    /// use dashpot_files::Scalar;
    /// use dashpot_testbench::accuracy_limits::ACCURACY_LIMITS;
    /// assert_eq!(ACCURACY_LIMITS[0].nrmse(1e-4, Scalar::F32), Some(6e-5));
    /// assert_eq!(ACCURACY_LIMITS[0].nrmse(250e-6, Scalar::F32), Some(1e-3));
    /// assert_eq!(ACCURACY_LIMITS[0].nrmse(2e-3, Scalar::F32), None);
    /// ```
    pub fn nrmse(&self, step_s: f64, scalar: Scalar) -> Option<f64> {
        // The slack absorbs the rounding of a step such as 1/10000 s.
        let is_up_to = |max_s: f64| step_s <= max_s * (1.0 + 1e-9);
        match scalar {
            Scalar::F64 if is_up_to(1e-4) => Some(self.nrmse_10_khz_f64),
            Scalar::F32 if is_up_to(1e-4) => Some(self.nrmse_10_khz_f32),
            _ => is_up_to(1e-3).then_some(self.nrmse_1_khz),
        }
    }
}

/// Returns the relaxation time of a damper on a motion (s), `F/(v Ke)`, with the rms force F, the rms velocity v and
/// the stiffness Ke of the mounts in series.
///
/// `displacements_m` (m) and `forces_n` (N) are sampled every `step_s` (s).
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
