//! The commands of `dashpot`, one a file.

pub mod budget;
pub mod contact;
pub mod demonstrate;
pub mod export;
pub mod pil;
pub mod progress;
pub mod replay;
pub mod rig;
pub mod shims;
pub mod verify;

use std::io::Write;

use dashpot_core::DamperParameters;
use serde::Serialize;

use crate::damper_file;
use crate::failure::{Failure, Outcome};

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

/// Step in seconds of one in microseconds.
pub fn step_s(step_us: u32) -> f64 {
    f64::from(step_us) * 1e-6
}

/// Prints one JSON object and a line feed.
///
/// # Errors
/// Standard output cannot be written, but for a reader that has left.
pub fn print_json(value: &impl Serialize) -> Outcome<()> {
    let text =
        serde_json::to_string_pretty(value).map_err(|error| Failure::new(error.to_string()))?;
    print_lines(&[text])
}

/// Prints lines.
///
/// # Errors
/// Standard output cannot be written, but for a reader that has left.
pub fn print_lines(lines: &[impl AsRef<str>]) -> Outcome<()> {
    let mut out = std::io::stdout().lock();
    for line in lines {
        if let Err(error) = writeln!(out, "{}", line.as_ref()) {
            return match error.kind() {
                std::io::ErrorKind::BrokenPipe => Ok(()),
                _ => Err(Failure::new(format!("standard output: {error}"))),
            };
        }
    }
    Ok(())
}
