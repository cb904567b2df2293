//! Options shared by several commands.

use std::path::Path;

use dashpot_core::CheckedParameters;

use super::failure::{Failure, Outcome};
use super::streams;
use dashpot_files::damper;
use dashpot_realtime::options::RealtimeOptions;

/// Output format of results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Format {
    /// Readable lines and tables.
    #[default]
    Text,
    /// One JSON object for programs, with SI units in key names.
    Json,
}

/// Returns the help text of an option that selects a damper, followed by `more`.
pub(super) fn damper_help(more: &str) -> String {
    let presets = damper::PRESETS.map(|(preset, _)| format!("`{preset}`"));
    format!(
        "Preset ({}) or TOML file, `-` for standard input{more}",
        presets.join(", ")
    )
}

/// Damper selection.
#[derive(Debug, Clone, clap::Args)]
pub struct DamperArguments {
    /// Preset or file.
    #[arg(help = damper_help(""), long, default_value = "paper", value_name = "NAME|FILE")]
    pub damper: String,
    /// Override a key of the damper: table.key=value, such as mount.clearance_m=1e-3.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}

impl DamperArguments {
    /// Reads and checks the damper.
    ///
    /// # Errors
    /// See [`damper::load`].
    pub fn load(&self) -> Outcome<CheckedParameters> {
        Ok(damper::load(&self.damper, &self.overrides)?)
    }

    /// Rejects standard input for both the damper and the motion at `input`.
    ///
    /// # Errors
    /// Both paths are `-`.
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
    /// Keep the processors out of sleep states from which they wake slowly.
    #[arg(long)]
    pub no_deep_sleep: bool,
}

impl RealtimeArguments {
    /// Converts the options for the pacer.
    pub fn options(&self) -> RealtimeOptions {
        RealtimeOptions {
            fifo_priority: self.fifo,
            lock_memory: self.lock_memory,
            core: self.core,
            no_deep_sleep: self.no_deep_sleep,
        }
    }

    /// Returns the options, which require `option`.
    ///
    /// # Errors
    /// Options are set although `option` is not `given`.
    pub fn options_under(&self, option: &str, given: bool) -> Outcome<RealtimeOptions> {
        let options = self.options();
        if !given && options != RealtimeOptions::default() {
            return Err(Failure::wrong_use(format!(
                "--fifo, --lock-memory, --core and --no-deep-sleep require {option}"
            )));
        }
        Ok(options)
    }
}

/// Limits on the times of ticks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, clap::Args)]
pub struct TickLimitArguments {
    /// Stop with exit code 1 at the first tick that takes longer than this, ns.
    #[arg(long, value_name = "NS", value_parser = clap::value_parser!(u64).range(1..))]
    pub stop_above_ns: Option<u64>,
    /// Exit with code 1 if a deadline was missed.
    #[arg(long)]
    pub fail_on_miss: bool,
}

impl TickLimitArguments {
    /// Returns the limits, which require `option`.
    ///
    /// # Errors
    /// Limits are set although `option` is not `given`.
    pub fn limits_under(&self, option: &str, given: bool) -> Outcome<Self> {
        if !given && *self != Self::default() {
            return Err(Failure::wrong_use(format!(
                "--stop-above-ns and --fail-on-miss require {option}"
            )));
        }
        Ok(*self)
    }

    /// Checks that the run has deadlines, which `option` gives it, if none may be missed.
    ///
    /// # Errors
    /// `--fail-on-miss` is set although `option` is not `given`.
    pub fn require_deadlines(&self, option: &str, given: bool) -> Outcome<()> {
        if self.fail_on_miss && !given {
            return Err(Failure::wrong_use(format!(
                "--fail-on-miss requires {option}: a free run has no deadlines"
            )));
        }
        Ok(())
    }
}
