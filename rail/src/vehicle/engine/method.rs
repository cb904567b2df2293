//! Constants of the generalised-alpha time integration.

/// Spectral radius at infinite frequency: the fraction of the fastest motion that remains after a step. Between 0.5 and
/// 0.9, the value hardly influences the errors of a simulated locomotive on straight and curved track.
const SPECTRAL_RADIUS: f64 = 0.8;

/// Fraction of the last change of acceleration that is extrapolated to predict the next acceleration.
///
/// The single correction of a step overestimates the damping of a sliding contact, which leaves the acceleration too
/// close to the predicted one. A fraction of one half minimises this error.
const EXTRAPOLATION: f64 = 0.5;

/// Maximum length of a step inside a tick, s. Flange impacts take a few milliseconds.
const MAX_STEP_S: f64 = 0.25e-3;

/// Constants of the generalised-alpha method (Chung and Hulbert, Journal of Applied Mechanics 60, 1993, 371-375) for
/// one step: `M ((1 - am) a1 + am a0) = (1 - af) f1 + af f0`, with Newmark's `beta` and `gamma`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Method {
    /// Steps per tick.
    pub substeps: usize,
    /// Length `h` of a step, s.
    pub step_s: f64,
    /// `(1 - af)/(1 - am)`.
    pub new_force: f64,
    /// `af/(1 - am)`.
    pub old_force: f64,
    /// `am/(1 - am)`.
    pub old_inertia: f64,
    /// Change of velocity per change of acceleration: `gamma h`.
    pub to_velocity: f64,
    /// Change of displacement per change of acceleration: `beta h^2`.
    pub to_displacement: f64,
}

impl Method {
    /// Returns the constants for ticks of `tick_s`.
    pub fn new(tick_s: f64) -> Self {
        let substeps = (tick_s / MAX_STEP_S - 1e-9).ceil().max(1.0);
        let step_s = tick_s / substeps;
        let rho = SPECTRAL_RADIUS;
        let (am, af) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let beta = 0.25 * (1.0 - am + af) * (1.0 - am + af);
        let gamma = 0.5 - am + af;
        Self {
            substeps: substeps as usize,
            step_s,
            new_force: (1.0 - af) / (1.0 - am),
            old_force: af / (1.0 - am),
            old_inertia: am / (1.0 - am),
            to_velocity: gamma * step_s,
            to_displacement: beta * step_s * step_s,
        }
    }

    /// Weight of damping in the equations of a step, where inertia has the weight 1.
    pub fn damping_weight(&self) -> f64 {
        self.new_force * self.to_velocity
    }

    /// Weight of stiffness in the equations of a step, where inertia has the weight 1.
    pub fn stiffness_weight(&self) -> f64 {
        self.new_force * self.to_displacement
    }

    /// Extrapolates the acceleration at the end of a step from the last two values.
    #[inline(always)]
    pub fn predicted(&self, now: f64, before: f64) -> f64 {
        now + EXTRAPOLATION * (now - before)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Newmark's method with `gamma = 1/2 - am + af` and `beta = (1 - am + af)^2/4` is of second order and has the
    /// greatest dissipation of high frequencies (Chung and Hulbert, equations 17 and 20).
    #[test]
    fn the_constants_are_those_of_chung_and_hulbert() {
        let rho = 0.8;
        let (am, af) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let h = 0.2e-3;
        let method = Method::new(3.0 * h);
        assert_eq!(method.substeps, 3);
        for (found, expected) in [
            (method.step_s, h),
            (method.new_force * (1.0 - am), 1.0 - af),
            (method.old_force * (1.0 - am), af),
            (method.old_inertia * (1.0 - am), am),
            (method.to_velocity, h * (0.5 - am + af)),
            (
                method.to_displacement,
                h * h * (1.0 - am + af).powi(2) / 4.0,
            ),
            (
                method.damping_weight(),
                method.new_force * method.to_velocity,
            ),
            (
                method.stiffness_weight(),
                method.new_force * method.to_displacement,
            ),
        ] {
            assert!(
                (found / expected - 1.0).abs() < 1e-12,
                "{found} for {expected}"
            );
        }
    }

    #[test]
    fn half_the_last_change_of_acceleration_is_extrapolated() {
        let method = Method::new(1e-3);
        assert_eq!(method.predicted(3.0, 3.0), 3.0);
        assert_eq!(method.predicted(3.0, 1.0), 4.0);
        assert_eq!(method.predicted(1.0, 3.0), 0.0);
    }
}
