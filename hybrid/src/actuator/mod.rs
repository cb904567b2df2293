//! Actuators of rigs in motion, from their files.

mod coupled;
mod delay;
mod inverse;
mod response;
mod second_order;
mod servo;
mod stability;

use coupled::MovingCoupled;
use dashpot_files::actuator::{ActuatorLaw, ActuatorLimits, ActuatorParameters};
use delay::DelayLine;
pub use inverse::inverse_series;
pub(crate) use response::measured_gain;
pub use response::response;
use second_order::MovingSecondOrder;
use servo::MovingServo;
pub use stability::is_stable;

/// An actuator in motion, stepped with a constant command and the force of its specimen.
///
/// ```
/// use dashpot_files::actuator::ActuatorParameters;
/// use dashpot_hybrid::actuator::Actuator;
///
/// let mut actuator = Actuator::new(&ActuatorParameters::load("servo")?, 1e-4);
/// for _ in 0..5000 {
///     actuator.step(0.01, 0.0);
/// }
/// assert!((actuator.displacement_m() - 0.01).abs() < 1e-5);
/// # Ok::<(), dashpot_files::actuator::ActuatorFileError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Actuator {
    motion: MovingLaw,
    limits: ActuatorLimits,
    delay: DelayLine,
    /// Last command of a linear law, limited in stroke and rate (m).
    limited_m: f64,
    step_s: f64,
    is_saturated: bool,
}

/// Displacement (m) and velocity of a piston that the ends of its cylinder stop.
fn stopped([displacement_m, velocity_m_per_s]: [f64; 2], end_m: f64) -> [f64; 2] {
    if displacement_m.abs() > end_m {
        [displacement_m.clamp(-end_m, end_m), 0.0]
    } else {
        [displacement_m, velocity_m_per_s]
    }
}

#[derive(Clone, Debug)]
enum MovingLaw {
    Coupled(MovingCoupled),
    SecondOrder(MovingSecondOrder),
    ServoHydraulic(MovingServo),
}

impl Actuator {
    /// The actuator at rest in the middle of its stroke, for steps of `step_s`.
    pub fn new(parameters: &ActuatorParameters, step_s: f64) -> Self {
        let (motion, delay_s) = match &parameters.law {
            ActuatorLaw::Coupled(law) => (MovingLaw::Coupled(MovingCoupled::new(law, step_s)), 0.0),
            ActuatorLaw::SecondOrder(law) => (
                MovingLaw::SecondOrder(MovingSecondOrder::new(law, step_s)),
                law.delay_s,
            ),
            ActuatorLaw::ServoHydraulic(law) => (
                MovingLaw::ServoHydraulic(MovingServo::new(law, step_s)),
                law.delay_s,
            ),
        };
        Self {
            motion,
            limits: parameters.limits,
            delay: DelayLine::new(delay_s / step_s),
            limited_m: 0.0,
            step_s,
            is_saturated: false,
        }
    }

    /// Takes a step with the command (m) and the force (N) of the specimen that resists extension. The displacement
    /// stays within 1.1 times the stroke.
    pub fn step(&mut self, command_m: f64, force_n: f64) {
        let ActuatorLimits {
            stroke_m,
            velocity_m_per_s,
            force_n: largest_n,
        } = self.limits;
        // The stops of the cylinder lie a little beyond the stroke.
        let end_m = 1.1 * stroke_m;
        let delayed_m = self.delay.push(command_m.clamp(-stroke_m, stroke_m));
        let travel_m = velocity_m_per_s * self.step_s;
        let limited_m = delayed_m.clamp(self.limited_m - travel_m, self.limited_m + travel_m);
        self.is_saturated = match &mut self.motion {
            MovingLaw::Coupled(law) => {
                self.limited_m = limited_m;
                law.step(limited_m, force_n, [end_m, largest_n]) || limited_m != delayed_m
            }
            MovingLaw::SecondOrder(law) => {
                self.limited_m = limited_m;
                law.step(limited_m, end_m);
                limited_m != delayed_m || force_n.abs() > largest_n
            }
            // Its valve limits the velocity, its pressure the force.
            MovingLaw::ServoHydraulic(law) => law.step(delayed_m, force_n, end_m),
        };
    }

    /// Lets the supply fall to a share of its pressure: the flow falls with its root.
    pub fn weaken(&mut self, share: f64) {
        self.limits.velocity_m_per_s *= libm::sqrt(share);
        self.limits.force_n *= share;
        if let MovingLaw::ServoHydraulic(law) = &mut self.motion {
            law.weaken(share);
        }
    }

    /// Moving mass (kg) that feels the force of the specimen, and the stiffness (N/m) that holds it; `None` for an
    /// actuator that no force disturbs.
    pub(crate) fn moving(parameters: &ActuatorParameters) -> Option<[f64; 2]> {
        match &parameters.law {
            ActuatorLaw::Coupled(law) => Some([
                law.moving_mass_kg,
                law.interaction_n_per_m + law.frame_stiffness_n_per_m,
            ]),
            ActuatorLaw::SecondOrder(_) => None,
            ActuatorLaw::ServoHydraulic(law) => {
                Some([law.moving_mass_kg, law.oil_stiffness_n_per_m()])
            }
        }
    }

    /// Displacement of the specimen (m), positive in extension.
    pub fn displacement_m(&self) -> f64 {
        match &self.motion {
            MovingLaw::Coupled(law) => law.displacement_m(),
            MovingLaw::SecondOrder(law) => law.displacement_m(),
            MovingLaw::ServoHydraulic(law) => law.displacement_m(),
        }
    }

    /// Displacement that a perfect sensor reads (m).
    pub fn measured_m(&self) -> f64 {
        match &self.motion {
            MovingLaw::Coupled(law) => law.measured_m(),
            _ => self.displacement_m(),
        }
    }

    /// True if a limit of valve, velocity or force held in the last step.
    pub fn is_saturated(&self) -> bool {
        self.is_saturated
    }
}
