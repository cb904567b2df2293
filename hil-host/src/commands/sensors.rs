//! Options that say what is known of the sensors of a damper whose health is watched.

use dashpot_core::CheckedParameters;
use dashpot_core::health::{HealthModel, HealthSettings};

use super::failure::{Failure, Outcome};
use super::remedy::option_of;
use dashpot_testbench::health::Noise;

/// Heading of the options in the help.
const HEADING: &str = "Sensors and memory of the health";

/// What is known of the sensors; the core checks the ranges.
#[derive(Debug, Clone, Copy, Default, PartialEq, clap::Args)]
#[command(next_help_heading = HEADING)]
pub struct SensorArguments {
    /// Standard deviation of a sample's displacement, m.
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub displacement_noise_m: Option<f64>,
    /// Standard deviation of a sample's force, N.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub force_noise_n: Option<f64>,
    /// Time in contact after which a sample counts for 1/e, s; 1 where not given.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    memory_s: Option<f64>,
    /// Part by which the law of a healthy damper may be wrong within a stroke; 0.05 where not given.
    #[arg(long, value_name = "PART", allow_negative_numbers = true)]
    law_deviation: Option<f64>,
    /// Lag of the measured force behind the measured displacement, s; 0 where not given.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    lag_s: Option<f64>,
    /// Standard deviation with which the lag is known, s; 0 keeps it, 0.001 where not given.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    lag_sd_s: Option<f64>,
}

impl SensorArguments {
    /// The noise, where both numbers are given.
    pub fn noise(&self) -> Option<Noise> {
        Some(Noise {
            displacement_m: self.displacement_noise_m?,
            force_n: self.force_noise_n?,
        })
    }

    /// The noise, which `option` needs.
    ///
    /// # Errors
    /// A number that is not given.
    pub fn noise_for(&self, option: &str) -> Outcome<Noise> {
        self.noise().ok_or_else(|| {
            Failure::wrong_use(format!(
                "{option}: the noise of the sensors is part of its model, allowed: with --displacement-noise-m and --force-noise-n"
            ))
        })
    }

    /// Refuses options that mean nothing without `option`.
    ///
    /// # Errors
    /// One is given.
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
                "{name}: it says what watches the health of a damper, allowed: with {option}"
            ))),
            None => Ok(()),
        }
    }

    /// The settings of an estimate from samples with this noise.
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

/// The model of a damper's health at every step (s).
///
/// # Errors
/// A setting or a step out of its range, in the words of the options.
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
