//! The `dashpot` command.

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;
use dashpot_hil::commands::Command;
use dashpot_hil::commands::demonstrate::{self, DemonstrateArguments};
use dashpot_hil::commands::failure::Kind;
use dashpot_hil::commands::interruption;

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

fn main() -> ExitCode {
    let cli = Cli::parse();
    let outcome = interruption::clean_up().and_then(|()| match &cli.command {
        None => demonstrate::run(&cli.demonstration),
        Some(command) => command.run(),
    });
    let Err(failure) = outcome else {
        return ExitCode::SUCCESS;
    };
    let code = match failure.kind() {
        Kind::OutputClosed => return ExitCode::SUCCESS,
        Kind::Failed => 1,
        // As clap's own for an option it refuses.
        Kind::WrongUse => 2,
    };
    // Nothing can be done when standard error is closed.
    let _ = writeln!(std::io::stderr(), "error: {failure}");
    ExitCode::from(code)
}
