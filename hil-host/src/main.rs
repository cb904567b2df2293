//! The `dashpot` command.

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;
use dashpot_hil::commands::Command;
use dashpot_hil::commands::demonstrate::{self, DemonstrateArguments};
use dashpot_hil::commands::failure::Kind;
use dashpot_hil::commands::interruption;

/// Desktop tools for the Dashpot damper model. Without a command, runs the demo on a synthetic ride.
#[derive(Parser)]
#[command(
    name = "dashpot",
    version,
    args_conflicts_with_subcommands = true,
    after_help = "Examples:
  dashpot
  dashpot --output damper.html
  dashpot rig --damper paper --amplitude-m 24.875e-3 --frequency-hz 0.64

The file name `-` means standard input or standard output; reports then go to standard error.
Exit code: 0 success, 1 failure, 2 usage error."
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
        // Same code as clap uses for an invalid option.
        Kind::WrongUse => 2,
    };
    // If standard error is closed, there is nothing left to do.
    let _ = writeln!(std::io::stderr(), "error: {failure}");
    ExitCode::from(code)
}
