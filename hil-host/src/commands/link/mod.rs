//! `dashpot link`: sends requests to a target manually, one action per run.

mod change;
mod drive;
mod health;
mod inspect;
mod load;
mod places;
mod saved;
pub(in crate::commands) mod target;
pub(in crate::commands) mod telemetry;
mod watch;

use std::io::{self, Write};

use change::{LossOfLinkArguments, SetArguments};
use drive::DisplacementArguments;
use health::HealthArguments;
use load::LoadArguments;
use saved::{RestoreArguments, SaveArguments};
use serde::Serialize;
use telemetry::TelemetryArguments;
use watch::WatchArguments;

use super::arguments::Format;
use super::line::LineArguments;
use super::print::print_answer;
use crate::commands::failure::Outcome;

/// Control a target manually: identify and inspect it; load, change, run and watch its dampers.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot link --link serial:/dev/ttyACM0 hello
  dashpot link --link serial:/dev/ttyACM0 --baud 115200 status --format json
  dashpot link --link serial:/dev/ttyACM0 load --damper in-service --place 3
  dashpot link --link serial:/dev/ttyACM0 set --place 3 --clearance-m 0.001
  dashpot link --link tcp:localhost:5555 loss-of-link --after-ticks 60000 --output ramp=200
  dashpot link --link tcp:localhost:5555 run --displacement-m 0
  dashpot link --link tcp:localhost:5555 watch --place 0 --place 3
  dashpot link --link tcp:localhost:5555 save --output states.toml

A target has one damper per slot, numbered from 0; `hello` lists the slots. --place selects a slot.

Every run opens a new session and takes the target over from any other client: a running `dashpot pil` opens its
session again and continues; a running `dashpot link watch` ends.

With --link qemu, every run starts an emulator of its own. To use the same emulator several times, start it yourself
(see docs/link.md) and use --link tcp:HOST:PORT.

Exit code: 0 success, 1 failed or refused by the target, 2 usage error.")]
pub struct LinkArguments {
    #[command(flatten)]
    line: LineArguments,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text, global = true)]
    format: Format,
    #[command(subcommand)]
    action: Action,
}

/// Requests to a target.
#[derive(Debug, Clone, clap::Subcommand)]
enum Action {
    /// Print the target's version, step, tick and damper revisions.
    Hello,
    /// Print the status bits and rejected inputs of each damper.
    Status,
    /// Clear the status bits and rejected inputs of every damper, and print what was cleared.
    Clear,
    /// Print the target's counters since power-on.
    Counters,
    /// Print the last forces sent to the actuators.
    Outputs,
    Load(LoadArguments),
    Set(SetArguments),
    LossOfLink(LossOfLinkArguments),
    /// Put every damper at rest at a displacement and start the free-running mode.
    ///
    /// From then on, the target treats the link as lost if no displacement arrives for the number of ticks set by
    /// `loss-of-link` (default 100). Use `run` to recover from a lost link.
    Run(DisplacementArguments),
    /// Send new displacements to the dampers of a free-running target.
    Displace(DisplacementArguments),
    /// Stop the free-running mode and set the outputs to 0.
    Stop,
    Telemetry(TelemetryArguments),
    Health(Box<HealthArguments>),
    Watch(WatchArguments),
    Save(SaveArguments),
    Restore(RestoreArguments),
}

/// Runs the command.
///
/// # Errors
/// A file or damper is invalid, or the target does not answer or refuses the request.
pub fn run(arguments: &LinkArguments) -> Outcome<()> {
    match &arguments.action {
        Action::Hello => inspect::hello(arguments),
        Action::Status => inspect::status(arguments),
        Action::Clear => inspect::clear(arguments),
        Action::Counters => inspect::counters(arguments),
        Action::Outputs => inspect::outputs(arguments),
        Action::Load(load) => load::run(load, arguments),
        Action::Set(set) => change::set(set, arguments),
        Action::LossOfLink(loss) => change::loss_of_link(loss, arguments),
        Action::Run(run) => drive::run(run, arguments),
        Action::Displace(displace) => drive::displace(displace, arguments),
        Action::Stop => drive::stop(arguments),
        Action::Telemetry(telemetry) => telemetry::run(telemetry, arguments),
        Action::Health(health) => health::run(health, arguments),
        Action::Watch(watch) => watch::run(watch, arguments),
        Action::Save(save) => saved::save(save, arguments),
        Action::Restore(restore) => saved::restore(restore, arguments),
    }
}

impl LinkArguments {
    /// Prints a result in the requested format.
    fn print<R: Serialize>(
        &self,
        report: &R,
        text: impl FnOnce(&mut dyn Write, &R) -> io::Result<()>,
    ) -> Outcome<()> {
        print_answer(self.format, report, text)
    }
}
