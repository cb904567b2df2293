//! Options describing the sensors of a damper whose health is monitored.

use dashpot_core::CheckedParameters;
use dashpot_core::health::{HealthModel, HealthSettings};

use super::failure::{Failure, Outcome};
use super::remedy::option_of;
use dashpot_testbench::health::Noise;

/// Sensor properties; the core checks the ranges.
#[derive(Debug, Clone, Copy, Default, PartialEq, clap::Args)]
pub struct SensorArguments {
    /// Standard deviation of the displacement noise, m.
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub displacement_noise_m: Option<f64>,
    /// Standard deviation of the force noise, N.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub force_noise_n: Option<f64>,
    /// Time in contact after which the weight of a sample drops to 1/e, s [default: 1].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    memory_s: Option<f64>,
    /// Relative model error of a healthy damper within a stroke [default: 0.05].
    #[arg(long, value_name = "PART", allow_negative_numbers = true)]
    law_deviation: Option<f64>,
    /// Lag of the measured force behind the measured displacement, s [default: 0].
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    lag_s: Option<f64>,
    /// Standard deviation of the lag, s; 0 fixes the lag [default: 0.001].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    lag_sd_s: Option<f64>,
}

impl SensorArguments {
    /// Returns the noise if both values are given.
    pub fn noise(&self) -> Option<Noise> {
        Some(Noise {
            displacement_m: self.displacement_noise_m?,
            force_n: self.force_noise_n?,
        })
    }

    /// Returns the noise, which `option` requires.
    ///
    /// # Errors
    /// A value is missing.
    pub fn noise_for(&self, option: &str) -> Outcome<Noise> {
        self.noise().ok_or_else(|| {
            Failure::wrong_use(format!(
                "{option} requires --displacement-noise-m and --force-noise-n, because the sensor noise is part of the \
                 model"
            ))
        })
    }

    /// Rejects options that have no effect without `option`.
    ///
    /// # Errors
    /// An option is given.
    pub fn refuse_without(&self, option: &str) -> Outcome<()> {
        let given = [
            ("--displacement-noise-m", self.displacement_noise_m),
            ("--force-noise-n", self.force_noise_n),
            ("--memory-s", self.memory_s),
            ("--law-deviation", self.law_deviation),
            ("--lag-s", self.lag_s),
            ("--lag-sd-s", self.lag_sd_s),
        ];
        match given.iter().find(|(_, value)| value.is_some()) {
            Some((name, _)) => Err(Failure::wrong_use(format!(
                "{name}: applies to health monitoring only and requires {option}"
            ))),
            None => Ok(()),
        }
    }

    /// Returns the settings of an estimate from samples with this noise.
    pub fn settings(&self, noise: Noise) -> HealthSettings {
        let default = HealthSettings::new(noise.displacement_m, noise.force_n);
        default
            .memory_s(self.memory_s.unwrap_or(default.memory_s))
            .law_deviation(self.law_deviation.unwrap_or(default.law_deviation))
            .lag(
                self.lag_s.unwrap_or(default.lag_s),
                self.lag_sd_s.unwrap_or(default.lag_sd_s),
            )
    }
}

/// Builds the health model of a damper for a step (s).
///
/// # Errors
/// A setting or the step is out of range; the message names the option.
pub fn model(
    parameters: &CheckedParameters,
    settings: &HealthSettings,
    step_s: f64,
) -> Outcome<HealthModel> {
    parameters.health_model(settings, step_s).map_err(|error| {
        Failure::wrong_use(match error.section {
            "health" => format!(
                "{} {}: allowed: {}",
                option_of(error.field),
                error.value,
                error.allowed
            ),
            _ => format!("a step of {} s: allowed: {}", error.value, error.allowed),
        })
    })
}
