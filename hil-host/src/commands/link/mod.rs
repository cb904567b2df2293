//! `dashpot link`: requests to a target by hand, one action a run.

mod change;
mod drive;
mod health;
mod inspect;
mod load;
mod places;
mod saved;
mod target;
mod telemetry;
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
use super::print::print_report;
use crate::commands::failure::Outcome;

/// Ask a target by hand: who it is, what it holds and noticed; load, change, run and watch it.
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

The dampers of a target stand in places, numbered from 0; `hello` tells how many there are.

Every run says hello and so takes the target over from whoever asked it before: a `dashpot pil` under way says hello again \
and goes on, a `dashpot link watch` ends.

With --link qemu every run starts an emulator, which ends with it. To ask the same emulator several times, start it \
yourself as docs/link.md tells and use --link tcp:HOST:PORT.

Exit code: 0 done, 1 failed or refused by the target, 2 wrong use.")]
pub struct LinkArguments {
    #[command(flatten)]
    line: LineArguments,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text, global = true)]
    format: Format,
    #[command(subcommand)]
    action: Action,
}

/// What to ask.
#[derive(Debug, Clone, clap::Subcommand)]
enum Action {
    /// Who answers: version, step, tick, and the revision of the damper in each place.
    Hello,
    /// Status bits and rejected inputs of each damper.
    Status,
    /// Clear status bits and rejected inputs of every damper, and tell what was cleared.
    Clear,
    /// What the target counted since power on.
    Counters,
    /// What the actuators were given last.
    Outputs,
    Load(LoadArguments),
    Set(SetArguments),
    LossOfLink(LossOfLinkArguments),
    /// Put every damper at rest at a displacement and let the target's tick run free.
    ///
    /// The target then counts the link as lost when no displacement comes for the ticks that `loss-of-link` gave, 100 when
    /// it gave none; `run` ends a lost link.
    Run(DisplacementArguments),
    /// Give the dampers of a target whose tick runs free another displacement.
    Displace(DisplacementArguments),
    /// End the free-running tick; the outputs are 0.
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
/// A file or damper that cannot be used, a target that does not answer, or one that says no.
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
        print_report(self.format, report, text)
    }
}
