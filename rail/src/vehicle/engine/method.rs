//! Constants of the generalised-alpha time integration.

use crate::vehicle::error::VehicleError;

/// Constants of a generalised-alpha method (Chung and Hulbert, Journal of Applied Mechanics 60, 1993, 371-375):
/// `M ((1 - am) a1 + am a0) = (1 - af) f1 + af f0` with Newmark's `beta`, and `gamma = 1/2 - am + af`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Family {
    am: f64,
    af: f64,
    beta: f64,
}

/// Phase of fourth order: the impact of a wheel keeps its height and its time. Newmark's `beta = 1/12` is that of Fox
/// and Goodwin; `am = -1/8` damps fast motion. Stable up to `w h = 2.3`.
const EXACT_PHASE: Family = Family {
    am: -0.125,
    af: 0.0,
    beta: 1.0 / 12.0,
};

/// Stable for any stiffness. The spectral radius at infinite frequency is 0.8: the fraction of the fastest motion that
/// remains after a step.
const ANY_STIFFNESS: Family = Family {
    am: 1.0 / 3.0,
    af: 4.0 / 9.0,
    beta: 25.0 / 81.0,
};

/// Maximum phase of the fastest oscillation on springs during a step of [`EXACT_PHASE`], rad. The contact adds to it.
const MAX_EXACT_PHASE_RAD: f64 = 1.2;

/// Fraction of the last change of acceleration that is extrapolated to predict the next acceleration.
///
/// The single correction of a step overestimates the damping of a sliding contact, which leaves the acceleration too
/// close to the predicted one. Half the change leaves larger errors in the wear numbers of a hunting locomotive; the
/// whole change moves the wheelsets of a curving one by up to 1 um.
const EXTRAPOLATION: f64 = 0.75;

/// Maximum length of a step inside a tick, s. Flange impacts take a few milliseconds.
const MAX_STEP_S: f64 = 0.25e-3;

/// Maximum number of steps for which the equations are factorised once.
///
/// The factors contain an estimate of the contact's stiffness and damping, and a step corrects only the difference from
/// the prediction. With factors of each step, the errors of a hunting locomotive's wheel loads are the same to a tenth.
const STEPS_OF_FACTORS: usize = 5;

/// Maximum number of steps in a tick.
const MAX_STEPS: f64 = 200.0;

/// Maximum phase of the oscillation of a mass on the contact's spring during a step, rad. At this value the greatest
/// wheel loads of a hunting locomotive differ by 0.4 % on average, and by at most 2 %, from the reference.
const MAX_PHASE_RAD: f64 = 0.7;

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
    /// Creep force per creepage, N.
    pub creep_n: f64,
}

impl OnContact {
    /// Returns the longest step that follows the mass on the contact, s.
    fn step_s(&self) -> f64 {
        let oscillation = MAX_PHASE_RAD * (self.mass_kg / self.stiffness_n_per_m).sqrt();
        let decay = MAX_DECAY * self.mass_kg / self.damping_n_s_per_m;
        oscillation.min(decay)
    }

    /// Returns the speed below which the damping of creep, `creep/speed`, is too strong for a step that neglects it,
    /// which is stable up to `2 m/h`, m/s.
    fn slow_m_per_s(&self, step_s: f64) -> f64 {
        0.5 * self.creep_n * step_s / self.mass_kg
    }
}

/// Constants of a generalised-alpha method for one step.
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
    /// Below this speed the equations are factorised in every step, m/s: a contact that closes or opens would otherwise
    /// be corrected with factors that lack the strong damping of creep, or still have it.
    slow_m_per_s: f64,
}

impl Method {
    /// Returns the constants for ticks of `tick_s`, with steps that follow every mass on its contact. On springs, the
    /// fastest oscillation of the vehicle has the angular frequency `on_springs_rad_per_s`.
    ///
    /// # Errors
    /// A mass would need too many steps in a tick.
    pub fn new(
        tick_s: f64,
        on_contacts: &[OnContact],
        on_springs_rad_per_s: f64,
    ) -> Result<Self, VehicleError> {
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
        let family = if on_springs_rad_per_s * step_s <= MAX_EXACT_PHASE_RAD {
            EXACT_PHASE
        } else {
            ANY_STIFFNESS
        };
        let Family { am, af, beta } = family;
        let gamma = 0.5 - am + af;
        let slow_m_per_s = on_contacts.iter().map(|mass| mass.slow_m_per_s(step_s));
        Ok(Self {
            slow_m_per_s: slow_m_per_s.fold(0.0, f64::max),
            substeps: substeps as usize,
            step_s,
            new_force: (1.0 - af) / (1.0 - am),
            old_force: af / (1.0 - am),
            old_inertia: am / (1.0 - am),
            to_velocity: gamma * step_s,
            to_displacement: beta * step_s * step_s,
        })
    }

    /// Returns true if the equations are factorised in a step of a tick, counted from 0.
    #[inline(always)]
    pub fn factorises(&self, step: usize, speed_m_per_s: f64) -> bool {
        step.is_multiple_of(STEPS_OF_FACTORS) || speed_m_per_s < self.slow_m_per_s
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

    /// A mass that moves slowly is limited by [`MAX_STEP_S`] only.
    fn unlimited(tick_s: f64, on_springs_rad_per_s: f64) -> Method {
        Method::new(tick_s, &[], on_springs_rad_per_s).unwrap()
    }

    #[track_caller]
    fn assert_equal(found: f64, expected: f64) {
        let error = (found / expected - 1.0).abs();
        assert!(error < 1e-12, "{found} for {expected}");
    }

    /// Stiff springs: `gamma = 1/2 - am + af` and `beta = (1 - am + af)^2/4` are of second order and have the greatest
    /// dissipation of high frequencies (Chung and Hulbert, equations 17 and 20).
    #[test]
    fn on_stiff_springs_the_constants_are_those_of_chung_and_hulbert() {
        let rho = 0.8;
        let (am, af) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let h = 0.2e-3;
        let method = unlimited(0.6e-3, 1.21 / h);
        assert_eq!(method.substeps, 3);
        let sum = 1.0 - am + af;
        assert_equal(method.step_s, h);
        assert_equal(method.new_force * (1.0 - am), 1.0 - af);
        assert_equal(method.old_force * (1.0 - am), af);
        assert_equal(method.old_inertia * (1.0 - am), am);
        assert_equal(method.to_velocity, h * (0.5 - am + af));
        assert_equal(method.to_displacement, h * h * sum * sum / 4.0);
        let [velocity, displacement] = [method.to_velocity, method.to_displacement];
        assert_equal(method.damping_weight(), method.new_force * velocity);
        assert_equal(method.stiffness_weight(), method.new_force * displacement);
    }

    /// The phase of `q'' = -w^2 q` over thirty periods, in steps of `q`, `h v` and `h^2 a`.
    #[test]
    fn on_soft_springs_the_phase_is_of_fourth_order() {
        let method = unlimited(1e-3, 100.0);
        let h = method.step_s;
        let (gamma, beta) = (method.to_velocity / h, method.to_displacement / (h * h));
        assert_equal(beta, 1.0 / 12.0);
        let phase_error = |phase: f64| {
            let weight = 1.0 + beta * method.new_force * phase * phase;
            let next = |[q, v, a]: [f64; 3]| {
                let (to, speed) = (q + v + (0.5 - beta) * a, v + (1.0 - gamma) * a);
                let force = -phase * phase * (method.new_force * to + method.old_force * q);
                let a = (force - method.old_inertia * a) / weight;
                [to + beta * a, speed + gamma * a, a]
            };
            let mut motion = [1.0, 0.0, -phase * phase];
            let steps = (60.0 * std::f64::consts::PI / phase).round() as usize;
            let angle = |[q, v, _]: [f64; 3]| (-v / phase).atan2(q);
            let (mut turned, mut before) = (0.0, angle(motion));
            for _ in 0..steps {
                motion = next(motion);
                let now = angle(motion);
                turned += (now - before).rem_euclid(2.0 * std::f64::consts::PI);
                before = now;
            }
            (turned / (steps as f64 * phase) - 1.0).abs()
        };
        // Half the step divides an error of fourth order by 16.
        let (coarse, fine) = (phase_error(0.6), phase_error(0.3));
        assert!(coarse < 3e-3 && coarse > 10.0 * fine, "{coarse}, {fine}");
    }

    #[test]
    fn a_part_of_the_last_change_of_acceleration_is_extrapolated() {
        let method = unlimited(1e-3, 0.0);
        assert_eq!(method.predicted(3.0, 3.0), 3.0);
        assert_eq!(method.predicted(3.0, 1.0), 4.5);
        assert_eq!(method.predicted(1.0, 3.0), -0.5);
    }

    /// With a creep coefficient of 12 MN, the damping of 245 kg exceeds `2 m/h` below 4.9 m/s.
    #[test]
    fn a_slow_vehicle_is_factorised_in_every_step() {
        let rail = OnContact {
            mass_kg: 245.0,
            stiffness_n_per_m: 2.5e9,
            damping_n_s_per_m: 0.0,
            creep_n: 12e6,
        };
        let method = Method::new(2e-3, &[rail], 0.0).unwrap();
        assert_eq!(method.substeps, 10);
        let steps = |speed| (0..10).filter(move |step| method.factorises(*step, speed));
        assert_eq!(steps(4.8).count(), 10);
        assert_eq!(steps(5.0).collect::<Vec<_>>(), [0, 5]);
    }

    /// A rail of 60 kg on a contact of 1.2 GN/m oscillates with 4472 rad/s.
    #[test]
    fn steps_follow_the_rail_on_the_contact() {
        let mut rail = OnContact {
            mass_kg: 60.0,
            stiffness_n_per_m: 1.2e9,
            damping_n_s_per_m: 0.0,
            creep_n: 12e6,
        };
        let substeps = |tick_s: f64, rail: OnContact| {
            Method::new(tick_s, &[rail], 0.0).map(|method| method.substeps)
        };
        assert_eq!(substeps(1e-3, rail), Ok(7));
        rail.mass_kg = 120.0;
        assert_eq!(substeps(1e-3, rail), Ok(5));
        rail.mass_kg = 245.0;
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
