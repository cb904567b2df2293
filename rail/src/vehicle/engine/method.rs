//! Constants of the generalised-alpha time integration.

use crate::vehicle::error::VehicleError;

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

/// Maximum number of steps in a tick.
const MAX_STEPS: f64 = 200.0;

/// Maximum phase of the oscillation of a mass on the contact's spring during a step, rad. At this value the greatest
/// wheel loads of flange impacts differ by less than 3 % from those of much shorter steps.
const MAX_PHASE_RAD: f64 = 0.5;

/// Maximum decay of a mass against the contact's damping during a step, under the load at standstill. Impacts reach
/// several times this load and decay, so the bound is far below 1.
const MAX_DECAY: f64 = 0.06;

/// A mass on the contact of a wheel at standstill. It limits the length of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OnContact {
    /// The lighter of wheel and rail, kg.
    pub mass_kg: f64,
    /// Stiffness of the contact, N/m.
    pub stiffness_n_per_m: f64,
    /// Damping of the contact, N s/m.
    pub damping_n_s_per_m: f64,
}

impl OnContact {
    /// Returns the longest step that follows the mass on the contact, s.
    fn step_s(&self) -> f64 {
        let oscillation = MAX_PHASE_RAD * (self.mass_kg / self.stiffness_n_per_m).sqrt();
        let decay = MAX_DECAY * self.mass_kg / self.damping_n_s_per_m;
        oscillation.min(decay)
    }
}

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
    /// Returns the constants for ticks of `tick_s`, with steps that follow every mass on its contact.
    ///
    /// # Errors
    /// A mass would need too many steps in a tick.
    pub fn new(tick_s: f64, on_contacts: &[OnContact]) -> Result<Self, VehicleError> {
        let needed_s = on_contacts.iter().map(OnContact::step_s);
        let longest_s = needed_s.fold(MAX_STEP_S, f64::min);
        let substeps = (tick_s / longest_s - 1e-9).ceil().max(1.0);
        if substeps > MAX_STEPS {
            return Err(VehicleError::ContactTooFast {
                needed_s: longest_s,
                least_s: tick_s / MAX_STEPS,
            });
        }
        let step_s = tick_s / substeps;
        let rho = SPECTRAL_RADIUS;
        let (am, af) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let beta = 0.25 * (1.0 - am + af) * (1.0 - am + af);
        let gamma = 0.5 - am + af;
        Ok(Self {
            substeps: substeps as usize,
            step_s,
            new_force: (1.0 - af) / (1.0 - am),
            old_force: af / (1.0 - am),
            old_inertia: am / (1.0 - am),
            to_velocity: gamma * step_s,
            to_displacement: beta * step_s * step_s,
        })
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
        let method = Method::new(0.6e-3, &[]).unwrap();
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
        let method = Method::new(1e-3, &[]).unwrap();
        assert_eq!(method.predicted(3.0, 3.0), 3.0);
        assert_eq!(method.predicted(3.0, 1.0), 4.0);
        assert_eq!(method.predicted(1.0, 3.0), 0.0);
    }

    /// A rail of 60 kg on a contact of 1.2 GN/m oscillates with 4472 rad/s.
    #[test]
    fn steps_follow_the_rail_on_the_contact() {
        let mut rail = OnContact {
            mass_kg: 60.0,
            stiffness_n_per_m: 1.2e9,
            damping_n_s_per_m: 0.0,
        };
        let substeps = |tick_s: f64, rail: OnContact| {
            Method::new(tick_s, &[rail]).map(|method| method.substeps)
        };
        assert_eq!(substeps(1e-3, rail), Ok(9));
        rail.mass_kg = 245.0;
        assert_eq!(substeps(1e-3, rail), Ok(5));
        // 500 kN s/m brake the rail with a time constant of 0.49 ms.
        rail.damping_n_s_per_m = 500e3;
        assert_eq!(substeps(1e-3, rail), Ok(35));
        assert_eq!(substeps(25e-6, rail), Ok(1));
        rail.mass_kg = 40.0;
        let error = substeps(1e-3, rail).unwrap_err().to_string();
        assert!(
            error.starts_with("contact of wheel and rail: needs steps of 4.8e-6 s"),
            "{error}"
        );
    }
}
