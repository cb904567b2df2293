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

use std::io::{self, BufWriter, Write};

use dashpot_core::DamperParameters;
use serde::Serialize;

use crate::damper_file;
use crate::failure::{Failure, Outcome};
use crate::pacing::RealtimeOptions;

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

/// Real-time options of a paced run.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct RealtimeArguments {
    /// Run under SCHED_FIFO with this priority.
    #[arg(long, value_name = "PRIORITY", value_parser = clap::value_parser!(u8).range(1..=99))]
    pub fifo: Option<u8>,
    /// Lock all memory.
    #[arg(long)]
    pub lock_memory: bool,
    /// Pin to this core.
    #[arg(long, value_name = "N")]
    pub core: Option<usize>,
}

impl RealtimeArguments {
    /// The options as the pacer takes them.
    pub fn options(&self) -> RealtimeOptions {
        RealtimeOptions {
            fifo_priority: self.fifo,
            lock_memory: self.lock_memory,
            core: self.core,
        }
    }
}

/// Step in seconds of one in microseconds.
pub fn step_s(step_us: u32) -> f64 {
    f64::from(step_us) * 1e-6
}

/// Prints `report` in the format asked for: what `text` writes, or one JSON object. A reader that has
/// left, such as `head`, is no failure.
///
/// # Errors
/// Standard output cannot be written.
pub fn print_report<R: Serialize>(
    format: Format,
    report: &R,
    text: impl FnOnce(&mut dyn Write, &R) -> io::Result<()>,
) -> Outcome<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    let printed = match format {
        Format::Text => text(&mut out, report),
        Format::Json => serde_json::to_writer_pretty(&mut out, report)
            .map_err(io::Error::from)
            .and_then(|()| writeln!(out)),
    };
    match printed.and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::new(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}
