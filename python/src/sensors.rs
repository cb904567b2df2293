//! Sensors of a damper whose health is watched, as keyword arguments.

use dashpot_core::CheckedParameters;
use dashpot_core::health::{HealthModel, HealthSettings};
use dashpot_testbench::health::Noise;

use crate::error::{Outcome, Refusal};

/// Properties of the sensors; the core checks their ranges.
#[derive(Clone, Copy)]
pub struct Sensors {
    pub displacement_noise_m: Option<f64>,
    pub force_noise_n: Option<f64>,
    pub memory_s: Option<f64>,
    pub law_deviation: Option<f64>,
    pub lag_s: Option<f64>,
    pub lag_sd_s: Option<f64>,
}

impl Sensors {
    /// Settings of an estimate from samples with this noise, unless the noise was given.
    pub fn settings(&self, noise: Noise) -> HealthSettings {
        let default = HealthSettings::new(
            self.displacement_noise_m.unwrap_or(noise.displacement_m),
            self.force_noise_n.unwrap_or(noise.force_n),
        );
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
pub fn model(
    parameters: &CheckedParameters,
    settings: &HealthSettings,
    step_s: f64,
) -> Outcome<HealthModel> {
    let model = parameters.health_model(settings, step_s);
    model.map_err(|error| {
        let name = match error.section {
            "health" => error.field,
            _ => "step_s",
        };
        Refusal::Value(format!(
            "{name}: {}, allowed: {}",
            error.value, error.allowed
        ))
    })
}
