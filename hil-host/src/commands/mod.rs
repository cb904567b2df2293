//! The commands of `dashpot`, one a file.

pub mod budget;
pub mod contact;
pub mod demonstrate;
pub mod export;
mod gap_report;
pub mod interruption;
pub mod line;
pub mod link;
pub mod pil;
pub mod progress;
pub mod replay;
pub mod rig;
pub mod shims;
pub mod step_size;
pub mod verify;

use std::io::{self, BufWriter, Write};
use std::path::Path;

use dashpot_core::DamperParameters;
use serde::Serialize;

use crate::error::{Failure, Outcome};
use crate::files::damper;
use crate::files::input;
use crate::realtime::pacing::RealtimeOptions;

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
    /// Preset (`paper`, `in-service`, `reduced-vertical`, `reduced-lateral`) or TOML file, `-` for standard
    /// input.
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
    /// As [`damper::load`].
    pub fn load(&self) -> Outcome<DamperParameters> {
        damper::load(&self.damper, &self.overrides)
    }

    /// Refuses standard input for both the damper and the motion at `input`.
    ///
    /// # Errors
    /// Both are `-`.
    pub fn refuse_same_input(&self, input: &Path) -> Outcome<()> {
        input::refuse_second_standard_input(&[
            ("--damper", Path::new(&self.damper)),
            ("--input", input),
        ])
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

    /// The options, which only go with `option`.
    ///
    /// # Errors
    /// There are some though `option` was not `given`.
    pub fn options_under(&self, option: &str, given: bool) -> Outcome<RealtimeOptions> {
        let options = self.options();
        if !given && options != RealtimeOptions::default() {
            return Err(Failure::wrong_use(format!(
                "--fifo, --lock-memory and --core go with {option}"
            )));
        }
        Ok(options)
    }
}

/// The nearest nanosecond (s), free of the rounding of sums; the nearest microsecond from 100 days on,
/// where a clock's time in `f64` has no nanoseconds.
fn nearest_nanosecond(time_s: f64) -> f64 {
    let per_s = if time_s.abs() < 8.64e6 { 1e9 } else { 1e6 };
    (time_s * per_s).round() / per_s
}

/// `1 tick`, `2 ticks`.
fn counted(count: u64, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Prints `report` on standard output in the format asked for: what `text` writes, or one JSON object.
/// A reader that has left, such as `head`, is no failure.
///
/// # Errors
/// Standard output cannot be written.
pub fn print_report<R: Serialize>(
    format: Format,
    report: &R,
    text: impl FnOnce(&mut dyn Write, &R) -> io::Result<()>,
) -> Outcome<()> {
    print_to(io::stdout().lock(), "standard output", format, report, text)
}

/// As [`print_report`], on standard error when the data itself went to standard output as `data`.
///
/// # Errors
/// The stream cannot be written.
pub fn print_report_beside<R: Serialize>(
    data: &Path,
    format: Format,
    report: &R,
    text: impl FnOnce(&mut dyn Write, &R) -> io::Result<()>,
) -> Outcome<()> {
    if input::is_standard_stream(data) {
        print_to(io::stderr().lock(), "standard error", format, report, text)
    } else {
        print_report(format, report, text)
    }
}

fn print_to<R: Serialize>(
    stream: impl Write,
    name: &str,
    format: Format,
    report: &R,
    text: impl FnOnce(&mut dyn Write, &R) -> io::Result<()>,
) -> Outcome<()> {
    let mut out = BufWriter::new(stream);
    let printed = match format {
        Format::Text => text(&mut out, report),
        Format::Json => serde_json::to_writer_pretty(&mut out, report)
            .map_err(io::Error::from)
            .and_then(|()| writeln!(out)),
    };
    match printed.and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::new(format!("{name}: {error}")))
        }
        _ => Ok(()),
    }
}
