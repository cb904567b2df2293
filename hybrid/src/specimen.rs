//! A damper in small motion.

use dashpot_core::CheckedParameters;
use dashpot_core::characteristic::Characteristic;
use nalgebra::Complex;

/// A dashpot in series with a spring, as a damper behaves in motion with a small velocity and its clearance taken up.
///
/// ```
/// use dashpot_hybrid::Specimen;
///
/// let damper = dashpot_files::damper::load("reduced-lateral", &[])?;
/// let specimen = Specimen::at_velocity(&damper, 0.01);
/// assert!((specimen.damping_n_s_per_m - 90e3).abs() < 1.0);
/// assert!((specimen.stiffness_n_per_m - 7e6).abs() < 1.0);
/// # Ok::<(), dashpot_files::damper::DamperError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Specimen {
    /// Secant of the characteristic (N s/m).
    pub damping_n_s_per_m: f64,
    /// Stiffness of oil and mounts in series (N/m).
    pub stiffness_n_per_m: f64,
}

impl Specimen {
    /// The damper for which compensators are made: at 1 mm/s.
    pub fn nominal(parameters: &CheckedParameters) -> Self {
        Self::at_velocity(parameters, 1e-3)
    }

    /// The damper at a velocity (m/s).
    pub fn at_velocity(parameters: &CheckedParameters, velocity_m_per_s: f64) -> Self {
        let characteristic = Characteristic::new(parameters);
        let v = velocity_m_per_s;
        Self {
            damping_n_s_per_m: (characteristic.force_n(v) - characteristic.force_n(-v)) / (2.0 * v),
            stiffness_n_per_m: 1.0 / parameters.mount.compliance_m_per_n(),
        }
    }

    /// The damper at the velocity up to `fastest_m_per_s` at which its secant is largest: there the loop of a hybrid
    /// test has its largest gain.
    pub fn at_largest_secant(parameters: &CheckedParameters, fastest_m_per_s: f64) -> Self {
        const VELOCITIES: i32 = 60;
        let slowest: f64 = 1e-4;
        let ratio = fastest_m_per_s.max(slowest) / slowest;
        let at = |number: i32| {
            let share = f64::from(number) / f64::from(VELOCITIES);
            Self::at_velocity(parameters, slowest * libm::pow(ratio, share))
        };
        let all = (0..=VELOCITIES).map(at);
        let stiffer = |a: Self, b: Self| {
            if b.damping_n_s_per_m > a.damping_n_s_per_m {
                b
            } else {
                a
            }
        };
        all.reduce(stiffer).unwrap_or_else(|| at(0))
    }

    /// Dynamic stiffness `k c s/(k + c s)` (N/m) at `s` (rad/s).
    pub fn dynamic_stiffness(&self, s: Complex<f64>) -> Complex<f64> {
        let dashpot = s * self.damping_n_s_per_m;
        dashpot * self.stiffness_n_per_m / (dashpot + self.stiffness_n_per_m)
    }
}
