//! Inputs of a running vehicle, which another simulation, a program or an operator sets.

use dashpot_rail::vehicle::{FRICTION_FACTOR, MAX_APPLIED, SPEED_M_PER_S, Vehicle, VehicleState};

use super::VehicleRunError;
use super::signals::slug;

/// Names and units of the applied forces and moments on a body, in the order of its coordinates.
const APPLIED: [&str; 5] = [
    "lateral_force_n",
    "vertical_force_n",
    "roll_moment_n_m",
    "pitch_moment_n_m",
    "yaw_moment_n_m",
];

/// Something that may be set while a vehicle runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// Force of an external damper, N, positive when it resists extension.
    Damper {
        /// Index of the damper in the vehicle.
        damper: usize,
    },
    /// Speed along the track, m/s.
    Speed,
    /// Factor on the friction of all wheels.
    FrictionFactor,
    /// Force or moment on the centre of a body, N or N m.
    Applied {
        /// Index of the body.
        body: usize,
        /// Index of the coordinate: lateral, vertical, roll, pitch, yaw.
        coordinate: usize,
    },
}

impl Input {
    /// Returns the inputs of a vehicle with these external dampers: their forces, then speed, friction, and forces and
    /// moments on each body but not on the wheelsets.
    pub(super) fn all<L: dashpot_rail::creep::CreepLaw>(
        vehicle: &Vehicle<L>,
        outside: &[usize],
    ) -> Vec<Self> {
        let dampers = outside
            .iter()
            .map(|damper| Self::Damper { damper: *damper });
        let bodies = 0..vehicle.names().len() - vehicle.wheelsets();
        let applied = bodies.flat_map(|body| {
            (0..APPLIED.len()).map(move |coordinate| Self::Applied { body, coordinate })
        });
        dampers
            .chain([Self::Speed, Self::FrictionFactor])
            .chain(applied)
            .collect()
    }

    /// Returns its name, which ends in the unit unless it has none.
    pub(super) fn name<L: dashpot_rail::creep::CreepLaw>(self, vehicle: &Vehicle<L>) -> String {
        let damper = |index| vehicle.damper_names().nth(index).unwrap_or_default();
        match self {
            Self::Damper { damper: index } => format!("{}_force_n", slug(damper(index))),
            Self::Speed => "speed_m_per_s".into(),
            Self::FrictionFactor => "friction_factor".into(),
            Self::Applied { body, coordinate } => {
                format!(
                    "{}_applied_{}",
                    slug(&vehicle.names()[body]),
                    APPLIED[coordinate]
                )
            }
        }
    }

    /// Describes it in a sentence.
    pub fn description(self) -> &'static str {
        match self {
            Self::Damper { .. } => {
                "Force of the external damper, positive when it resists extension"
            }
            Self::Speed => {
                "Speed along the track; there are no forces along the track, and the wheels keep rolling"
            }
            Self::FrictionFactor => "Factor on the friction of all wheels",
            Self::Applied { .. } => {
                "Applied to the centre of the body: to the right, downward; moments increase roll, pitch and yaw"
            }
        }
    }

    /// Smallest and largest allowed value.
    pub fn allowed(self) -> [f64; 2] {
        match self {
            Self::Damper { .. } => [f64::MIN, f64::MAX],
            Self::Speed => SPEED_M_PER_S,
            Self::FrictionFactor => FRICTION_FACTOR,
            Self::Applied { .. } => [-MAX_APPLIED, MAX_APPLIED],
        }
    }

    /// True if it may have this value.
    pub fn allows(self, value: f64) -> bool {
        let [min, max] = self.allowed();
        (min..=max).contains(&value)
    }

    /// Current value; zero for an external damper that has no force yet.
    pub(super) fn value(self, state: &VehicleState) -> f64 {
        match self {
            Self::Damper { damper } => state.outside_force_n(damper).unwrap_or(0.0),
            Self::Speed => state.speed_m_per_s(),
            Self::FrictionFactor => state.friction_factor(),
            Self::Applied { body, coordinate } => state.applied(body)[coordinate],
        }
    }

    /// Sets its value from the next tick on.
    ///
    /// # Errors
    /// A value outside [`Self::allowed`]. On an error, nothing changes.
    pub(super) fn set(self, state: &mut VehicleState, value: f64) -> Result<(), VehicleRunError> {
        match self {
            Self::Damper { damper } => state.set_outside_force_n(damper, Some(value))?,
            Self::Speed => state.set_speed_m_per_s(value)?,
            Self::FrictionFactor => state.set_friction_factor(value)?,
            Self::Applied { body, coordinate } => {
                let mut force = state.applied(body);
                force[coordinate] = value;
                state.apply(body, force)?;
            }
        }
        Ok(())
    }
}
