//! Sensors of an actuator.

use serde::Deserialize;

use super::bounds::{Bound, of_table};

/// Sensor of the displacement; the default is perfect.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DisplacementSensor {
    /// Standard deviation of the noise (m).
    pub noise_m: f64,
    /// Smallest difference between two readings (m); 0 for none.
    pub resolution_m: f64,
    /// Time constant of the lag (s).
    pub lag_s: f64,
    /// Probability that a reading does not come.
    pub dropout: f64,
}

/// Sensor of the force; the default is perfect.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ForceSensor {
    /// Standard deviation of the noise (N).
    pub noise_n: f64,
    /// Smallest difference between two readings (N); 0 for none.
    pub resolution_n: f64,
    /// Time constant of the lag (s).
    pub lag_s: f64,
    /// Probability that a reading does not come.
    pub dropout: f64,
}

impl DisplacementSensor {
    pub(super) fn bounds(&self) -> Vec<Bound> {
        of_table(
            "displacement_sensor",
            [
                ("noise_m", self.noise_m, 0.0, 0.1),
                ("resolution_m", self.resolution_m, 0.0, 0.1),
                ("lag_s", self.lag_s, 0.0, 1.0),
                ("dropout", self.dropout, 0.0, 1.0),
            ],
        )
    }
}

impl ForceSensor {
    pub(super) fn bounds(&self) -> Vec<Bound> {
        of_table(
            "force_sensor",
            [
                ("noise_n", self.noise_n, 0.0, 1e6),
                ("resolution_n", self.resolution_n, 0.0, 1e6),
                ("lag_s", self.lag_s, 0.0, 1.0),
                ("dropout", self.dropout, 0.0, 1.0),
            ],
        )
    }
}
