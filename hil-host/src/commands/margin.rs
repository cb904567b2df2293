//! The delay that a damper position bears, and the margin that an actuator leaves.

use dashpot_core::CheckedParameters;
use dashpot_files::actuator::ActuatorParameters;
use dashpot_files::case::Case;
use dashpot_hybrid::actuator::is_stable;
use dashpot_hybrid::plan::{
    CriticalDelay, LoopStability, PlanError, PlantWithoutDamper, critical_delay, stability,
};
use dashpot_hybrid::{Compensation, LoopFactor, Specimen};
use dashpot_rail::vehicle::Running;
use dashpot_vehicle_run::contact::ContactSetup;
use serde::Serialize;

use crate::commands::failure::{Failure, Outcome};

/// Fastest motion at which the damper's secant is taken, m/s.
const FASTEST_M_PER_S: f64 = 0.3;

/// Additional delay that a loop bears.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub(in crate::commands) enum Margin {
    /// Any delay.
    Any,
    /// Less than this delay.
    Below {
        /// The delay, s.
        delay_s: f64,
        /// Frequency of the motion that then grows, Hz.
        frequency_hz: f64,
    },
    /// Motion grows without additional delay.
    None {
        /// Unstable roots; a growing oscillation counts twice.
        unstable_roots: usize,
    },
    /// It cannot be computed.
    Unknown {
        /// Why.
        reason: String,
    },
}

impl Margin {
    /// True if the loop bears an additional delay of `delay_s`.
    pub(in crate::commands) fn bears(&self, least_s: f64) -> bool {
        match self {
            Self::Any => true,
            Self::Below { delay_s, .. } => *delay_s >= least_s,
            Self::None { .. } | Self::Unknown { .. } => false,
        }
    }

    /// Describes the margin in a few words.
    pub(in crate::commands) fn text(&self) -> String {
        match self {
            Self::Any => "any".into(),
            Self::Below { delay_s, .. } => format!("{:.1} ms", 1e3 * delay_s),
            Self::None { .. } => "UNSTABLE".into(),
            Self::Unknown { reason } => format!("unknown: {reason}"),
        }
    }

    /// The margin with the smaller delay.
    fn smaller(self, other: Self) -> Self {
        let rank = |margin: &Self| match margin {
            Self::Unknown { .. } => -2.0,
            Self::None { .. } => -1.0,
            Self::Below { delay_s, .. } => *delay_s,
            Self::Any => f64::INFINITY,
        };
        if rank(&other) < rank(&self) {
            other
        } else {
            self
        }
    }

    fn of_critical(found: Result<Option<CriticalDelay>, PlanError>) -> Self {
        match found {
            Ok(None) => Self::Any,
            Ok(Some(critical)) => Self::Below {
                delay_s: critical.delay_s,
                frequency_hz: critical.frequency_hz,
            },
            Err(error) => Self::Unknown {
                reason: error.to_string(),
            },
        }
    }

    fn of_loop(found: Result<LoopStability, PlanError>) -> Self {
        match found {
            Ok(LoopStability::Stable { margin }) => Self::of_critical(Ok(margin)),
            Ok(LoopStability::Unstable { roots }) => Self::None {
                unstable_roots: roots,
            },
            Err(error) => Self::Unknown {
                reason: error.to_string(),
            },
        }
    }
}

/// The linear vehicle of a case: on straight track, with rigid rails.
pub(in crate::commands) struct LinearVehicle<'a> {
    case: &'a Case,
    running: Running,
}

impl<'a> LinearVehicle<'a> {
    /// Linearises the vehicle at the speed of the case.
    ///
    /// # Errors
    /// The contact or the vehicle is invalid.
    pub(in crate::commands) fn new(case: &'a Case) -> Outcome<Self> {
        let refused = |error: String| Failure::new(format!("{}: {error}", case.name));
        let setup = ContactSetup::of_case(case).map_err(|error| refused(error.to_string()))?;
        let contacts = setup.exact().map_err(|error| refused(error.to_string()))?;
        let contacts: Vec<_> = contacts.iter().map(AsRef::as_ref).collect();
        let running = Running::with_contacts(&case.vehicle, &contacts, case.speed_m_per_s)
            .map_err(|error| refused(error.to_string()))?;
        Ok(Self { case, running })
    }

    /// Critical delay of a damper position.
    pub(in crate::commands) fn critical(&self, damper: usize) -> Margin {
        self.smallest(damper, |plant, _| {
            Margin::of_critical(critical_delay(plant))
        })
    }

    /// Margin of a damper position with an actuator.
    pub(in crate::commands) fn margin(
        &self,
        damper: usize,
        actuator: &ActuatorParameters,
        compensation: Compensation,
    ) -> Margin {
        self.smallest(damper, |plant, specimen| {
            if !is_stable(actuator, &specimen) {
                return Margin::Unknown {
                    reason: "the actuator itself is unstable with this damper".into(),
                };
            }
            let compensator = (compensation, self.nominal(damper));
            let factor = LoopFactor::new(actuator, specimen, compensator, self.case.step_s);
            Margin::of_loop(stability(plant, |s| factor.at(s)))
        })
    }

    /// Delay (s) and gain of the actuator at a frequency (Hz).
    pub(in crate::commands) fn actuator_at(
        &self,
        damper: usize,
        actuator: &ActuatorParameters,
        frequency_hz: f64,
    ) -> (f64, f64) {
        let step_s = self.case.step_s;
        let [specimen, _] = self.specimens(damper);
        let compensator = (Compensation::None, specimen);
        LoopFactor::new(actuator, specimen, compensator, step_s).actuator_at(frequency_hz)
    }

    /// The smallest margin over the damper in small motion and at its largest secant.
    fn smallest(
        &self,
        damper: usize,
        margin: impl Fn(&PlantWithoutDamper, Specimen) -> Margin,
    ) -> Margin {
        let Some(without) = self.running.without_damper(damper) else {
            return Margin::Unknown {
                reason: "there is no such damper".into(),
            };
        };
        let of_specimen = |specimen: Specimen| {
            let plant = PlantWithoutDamper::new(
                without.state_matrix.clone(),
                without.input.clone(),
                without.output.clone(),
                specimen.damping_n_s_per_m,
                specimen.stiffness_n_per_m,
            );
            match plant {
                Ok(plant) => margin(&plant, specimen),
                Err(error) => Margin::Unknown {
                    reason: error.to_string(),
                },
            }
        };
        let [small, largest] = self.specimens(damper);
        let found = of_specimen(small);
        // A damper that saturates is stiffest in small motion.
        if largest.damping_n_s_per_m <= 1.001 * small.damping_n_s_per_m {
            return found;
        }
        found.smaller(of_specimen(largest))
    }

    /// The damper in small motion and at its largest secant.
    fn specimens(&self, damper: usize) -> [Specimen; 2] {
        self.checked(damper).map_or([NO_SPECIMEN; 2], |damper| {
            [
                Specimen::at_velocity(&damper, 1e-4),
                Specimen::at_largest_secant(&damper, FASTEST_M_PER_S),
            ]
        })
    }

    /// The damper for which the compensator is made.
    fn nominal(&self, damper: usize) -> Specimen {
        let checked = self.checked(damper);
        checked.map_or(NO_SPECIMEN, |damper| Specimen::nominal(&damper))
    }

    fn checked(&self, damper: usize) -> Option<CheckedParameters> {
        let element = self.case.vehicle.dampers().nth(damper)?;
        self.case.damper(&element.name)?.clone().check().ok()
    }
}

/// In place of a damper that does not exist.
const NO_SPECIMEN: Specimen = Specimen {
    damping_n_s_per_m: 0.0,
    stiffness_n_per_m: 0.0,
};
