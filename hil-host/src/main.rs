//! The `dashpot` command.

use std::io::Write;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use dashpot_hil::commands::budget::{self, BudgetArguments};
use dashpot_hil::commands::contact::{self, ContactArguments};
use dashpot_hil::commands::demonstrate::{self, DemonstrateArguments};
use dashpot_hil::commands::export::{self, ExportArguments};
use dashpot_hil::commands::interruption;
use dashpot_hil::commands::link::{self, LinkArguments};
use dashpot_hil::commands::pil::{self, PilArguments};
use dashpot_hil::commands::replay::{self, ReplayArguments};
use dashpot_hil::commands::rig::{self, RigArguments};
use dashpot_hil::commands::shims::{self, ShimsArguments};
use dashpot_hil::commands::verify::{self, VerifyArguments};
use dashpot_hil::error::{Kind, Outcome};

/// Desk host of the Dashpot damper. Without a command: the demonstration on a made ride.
#[derive(Parser)]
#[command(
    name = "dashpot",
    version,
    args_conflicts_with_subcommands = true,
    after_help = "Examples:
  dashpot
  dashpot --output damper.html
  dashpot rig --damper paper --amplitude-m 24.875e-3 --frequency-hz 0.64

A file called `-` is standard input or standard output; reports then go to standard error.
Exit code: 0 done, 1 failed, 2 wrong use."
)]
struct Cli {
    #[command(flatten)]
    demonstration: DemonstrateArguments,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    Replay(ReplayArguments),
    Rig(RigArguments),
    Verify(VerifyArguments),
    Shims(ShimsArguments),
    Budget(BudgetArguments),
    Export(ExportArguments),
    Contact(ContactArguments),
    Pil(PilArguments),
    Link(LinkArguments),
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    let outcome = interruption::clean_up().and_then(|()| run(&cli));
    let Err(failure) = outcome else {
        return ExitCode::SUCCESS;
    };
    let code = match failure.kind() {
        Kind::ReaderGone => return ExitCode::SUCCESS,
        Kind::Failed => 1,
        // As clap's own for an option it refuses.
        Kind::WrongUse => 2,
    };
    // Nobody to tell when standard error is closed.
    let _ = writeln!(std::io::stderr(), "error: {failure}");
    ExitCode::from(code)
}

fn run(cli: &Cli) -> Outcome<()> {
    match &cli.command {
        None => demonstrate::run(&cli.demonstration),
        Some(Command::Replay(arguments)) => replay::run(arguments),
        Some(Command::Rig(arguments)) => rig::run(arguments),
        Some(Command::Verify(arguments)) => verify::run(arguments),
        Some(Command::Shims(arguments)) => shims::run(arguments),
        Some(Command::Budget(arguments)) => budget::run(arguments),
        Some(Command::Export(arguments)) => export::run(arguments),
        Some(Command::Contact(arguments)) => contact::run(arguments),
        Some(Command::Pil(arguments)) => pil::run(arguments),
        Some(Command::Link(arguments)) => link::run(arguments),
    }
}
