//! Options that say what is known of the sensors of a damper whose health is watched.

use dashpot_core::health::HealthSettings;

/// Heading of the options in the help.
const HEADING: &str = "Sensors and memory of the health";

/// What is known of the sensors; the core checks the ranges.
#[derive(Debug, Clone, Copy, PartialEq, clap::Args)]
#[command(next_help_heading = HEADING)]
pub struct SensorArguments {
    /// Standard deviation of a sample's displacement, m.
    #[arg(
        long,
        value_name = "M",
        requires = "force_noise_n",
        allow_negative_numbers = true
    )]
    displacement_noise_m: Option<f64>,
    /// Standard deviation of a sample's force, N.
    #[arg(
        long,
        value_name = "N",
        requires = "displacement_noise_m",
        allow_negative_numbers = true
    )]
    force_noise_n: Option<f64>,
    /// Time in contact after which a sample counts for 1/e, s; 1 where not given.
    #[arg(
        long,
        value_name = "S",
        requires = "force_noise_n",
        allow_negative_numbers = true
    )]
    memory_s: Option<f64>,
    /// Part by which the law of a healthy damper may be wrong within a stroke; 0.05 where not given.
    #[arg(
        long,
        value_name = "PART",
        requires = "force_noise_n",
        allow_negative_numbers = true
    )]
    law_deviation: Option<f64>,
    /// Lag of the measured force behind the measured displacement, s; 0 where not given.
    #[arg(
        long,
        value_name = "S",
        requires = "force_noise_n",
        allow_hyphen_values = true
    )]
    lag_s: Option<f64>,
    /// Standard deviation with which the lag is known, s; 0 keeps it, 0.001 where not given.
    #[arg(
        long,
        value_name = "S",
        requires = "force_noise_n",
        allow_negative_numbers = true
    )]
    lag_sd_s: Option<f64>,
}

impl SensorArguments {
    /// The settings of an estimate; `None` where no option of these is given.
    pub fn settings(&self) -> Option<HealthSettings> {
        let default = HealthSettings::new(self.displacement_noise_m?, self.force_noise_n?);
        Some(HealthSettings {
            memory_s: self.memory_s.unwrap_or(default.memory_s),
            law_deviation: self.law_deviation.unwrap_or(default.law_deviation),
            lag_s: self.lag_s.unwrap_or(default.lag_s),
            lag_sd_s: self.lag_sd_s.unwrap_or(default.lag_sd_s),
            ..default
        })
    }
}
