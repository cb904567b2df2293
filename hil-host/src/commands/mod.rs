//! The commands of `dashpot`, one a file.

pub mod budget;
pub mod contact;
pub mod export;

use dashpot_core::DamperParameters;

use crate::damper_file;
use crate::failure::Outcome;

/// How a command prints its results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Format {
    /// Lines and tables for people.
    #[default]
    Text,
    /// One JSON object with SI names for programs.
    Json,
}

/// Floating-point type of the step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Scalar {
    /// Single precision, as on the target.
    #[default]
    F32,
    /// Double precision.
    F64,
}

/// Which damper a command works on.
#[derive(Debug, Clone, clap::Args)]
pub struct DamperArguments {
    /// Preset (`paper`, `in-service`, `reduced-vertical`, `reduced-lateral`) or TOML file.
    #[arg(long, default_value = "paper", value_name = "NAME|FILE")]
    pub damper: String,
    /// Overrides a key of the damper: table.key=value, such as mount.clearance_m=1e-3.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}

impl DamperArguments {
    /// The damper, read and checked.
    ///
    /// # Errors
    /// As [`damper_file::load`].
    pub fn load(&self) -> Outcome<DamperParameters> {
        damper_file::load(&self.damper, &self.overrides)
    }
}
