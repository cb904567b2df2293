//! The `dashpot` command.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use dashpot_hil::commands::contact::{self, ContactArguments};
use dashpot_hil::commands::replay::{self, ReplayArguments};
use dashpot_hil::commands::verify::{self, VerifyArguments};

/// Desk host of the Dashpot damper.
#[derive(Parser)]
#[command(name = "dashpot", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Contact(ContactArguments),
    Replay(ReplayArguments),
    Verify(VerifyArguments),
}

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Contact(arguments) => contact::run(&arguments),
        Command::Replay(arguments) => replay::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::from(1)
        }
    }
}
