//! Allowed values of an actuator file.

use std::fmt;

use super::law::ActuatorLaw;
use super::{ActuatorLimits, ActuatorParameters};

/// A value with its allowed range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bound {
    /// Table of the file.
    pub table: &'static str,
    /// Key in the table, with the unit.
    pub key: &'static str,
    /// The value.
    pub value: f64,
    /// Least allowed value.
    pub least: f64,
    /// Greatest allowed value.
    pub greatest: f64,
}

impl Bound {
    /// True if the value is allowed.
    pub fn is_kept(&self) -> bool {
        self.value >= self.least && self.value <= self.greatest
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}.{}: {}, allowed: {} to {}",
            self.table, self.key, self.value, self.least, self.greatest
        )
    }
}

/// Bounds of the keys of one table.
pub(super) fn of_table<const N: usize>(
    table: &'static str,
    keys: [(&'static str, f64, f64, f64); N],
) -> Vec<Bound> {
    let bound = |(key, value, least, greatest)| Bound {
        table,
        key,
        value,
        least,
        greatest,
    };
    keys.map(bound).into()
}

impl ActuatorParameters {
    /// All values with their allowed ranges.
    pub(super) fn bounds(&self) -> impl Iterator<Item = Bound> + use<> {
        let ActuatorLimits {
            stroke_m,
            velocity_m_per_s,
            force_n,
        } = self.limits;
        let limits = of_table(
            "limits",
            [
                ("stroke_m", stroke_m, 1e-3, 1.0),
                ("velocity_m_per_s", velocity_m_per_s, 1e-3, 10.0),
                ("force_n", force_n, 1.0, 1e7),
            ],
        );
        let law = match &self.law {
            ActuatorLaw::Coupled(law) => law.bounds(),
            ActuatorLaw::SecondOrder(law) => law.bounds(),
            ActuatorLaw::ServoHydraulic(law) => law.bounds(),
        };
        let sensors = [
            self.displacement_sensor.bounds(),
            self.force_sensor.bounds(),
        ];
        limits
            .into_iter()
            .chain(law)
            .chain(sensors.into_iter().flatten())
    }
}
