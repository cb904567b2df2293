//! Factors of the vehicle as new, to which later ones are compared.

use serde::{Deserialize, Serialize};

use super::error::SensorsError;
use super::factors::Factors;
use super::layout::Layout;
use super::limits::MAX_UNEXPLAINED;

/// Factors of the vehicle as new.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    /// Name of the vehicle.
    pub vehicle: String,
    /// SHA-256 of the numbers of the vehicle file that the balance uses.
    pub balance_sha256: String,
    /// Sensors used.
    pub sensors: Vec<String>,
    /// Names of the factors.
    pub names: Vec<String>,
    /// Factors (1).
    pub factors: Vec<f64>,
    /// Covariance of the factors, row by row.
    pub covariance: Vec<Vec<f64>>,
    /// Seconds of ride.
    pub seconds: usize,
    /// Unexplained share.
    pub unexplained: f64,
}

impl Baseline {
    /// Takes the factors of a vehicle as new.
    ///
    /// # Errors
    /// More than 3 % are unexplained, or a factor is not positive: the vehicle file or the sensors are wrong.
    pub fn new(layout: &Layout, factors: Factors) -> Result<Self, SensorsError> {
        let baseline = Self {
            vehicle: layout.vehicle.clone(),
            balance_sha256: layout.digest.clone(),
            sensors: factors.sensors,
            names: factors.names,
            factors: factors.values,
            covariance: factors.covariance,
            seconds: factors.seconds,
            unexplained: factors.unexplained,
        };
        baseline.check()?;
        Ok(baseline)
    }

    /// Checks that the baseline is one, and that it belongs to this vehicle and these sensors.
    ///
    /// # Errors
    /// The baseline is damaged, its vehicle is another, or its sensors are others.
    pub fn check_for(&self, layout: &Layout, sensors: &[String]) -> Result<(), SensorsError> {
        self.check()?;
        let other = |what, baseline: &str, now: &str| SensorsError::OtherBaseline {
            what,
            baseline: baseline.to_owned(),
            now: now.to_owned(),
        };
        if self.vehicle != layout.vehicle {
            return Err(other("vehicle", &self.vehicle, &layout.vehicle));
        }
        if self.sensors != sensors {
            return Err(other(
                "set of sensors",
                &self.sensors.join(", "),
                &sensors.join(", "),
            ));
        }
        if self.balance_sha256 != layout.digest || self.names != layout.factor_names() {
            return Err(other("vehicle file", &self.balance_sha256, &layout.digest));
        }
        Ok(())
    }

    fn check(&self) -> Result<(), SensorsError> {
        let count = self.names.len();
        let is_square =
            self.covariance.len() == count && self.covariance.iter().all(|row| row.len() == count);
        if self.factors.len() != count || !is_square {
            return Err(SensorsError::Damaged {
                what: "numbers of factors and rows differ",
            });
        }
        if !self
            .covariance
            .iter()
            .flatten()
            .all(|value| value.is_finite())
        {
            return Err(SensorsError::Damaged {
                what: "a covariance is not finite",
            });
        }
        let wrong = self
            .factors
            .iter()
            .position(|value| !(value.is_finite() && *value > 0.0));
        if !(..=MAX_UNEXPLAINED).contains(&self.unexplained) {
            return Err(SensorsError::Unexplained {
                unexplained: self.unexplained,
            });
        }
        match wrong {
            Some(factor) => Err(SensorsError::NotPositive {
                factor: self.names[factor].clone(),
                value: self.factors[factor],
            }),
            None => Ok(()),
        }
    }
}
