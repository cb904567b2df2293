//! Options that several commands have.

use std::path::Path;

use dashpot_core::CheckedParameters;

use super::failure::{Failure, Outcome};
use super::streams;
use dashpot_files::damper;
use dashpot_realtime::options::RealtimeOptions;

/// How a command prints its results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Format {
    /// Lines and tables for people.
    #[default]
    Text,
    /// One JSON object with SI names for programs.
    Json,
}

/// The help of an option that names a damper, with `more`.
pub(super) fn damper_help(more: &str) -> String {
    let presets = damper::PRESETS.map(|(preset, _)| format!("`{preset}`"));
    format!(
        "Preset ({}) or TOML file, `-` for standard input{more}",
        presets.join(", ")
    )
}

/// Which damper a command works on.
#[derive(Debug, Clone, clap::Args)]
pub struct DamperArguments {
    /// A preset or a file.
    #[arg(help = damper_help(""), long, default_value = "paper", value_name = "NAME|FILE")]
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
    pub fn load(&self) -> Outcome<CheckedParameters> {
        Ok(damper::load(&self.damper, &self.overrides)?)
    }

    /// Refuses standard input for both the damper and the motion at `input`.
    ///
    /// # Errors
    /// Both are `-`.
    pub fn refuse_same_input(&self, input: &Path) -> Outcome<()> {
        streams::refuse_second_standard_input(&[
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
