//! The `dashpot` command.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use dashpot_hil::commands::budget::{self, BudgetArguments};
use dashpot_hil::commands::contact::{self, ContactArguments};
use dashpot_hil::commands::export::{self, ExportArguments};

/// Desk host of the Dashpot damper.
#[derive(Parser)]
#[command(name = "dashpot", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Budget(BudgetArguments),
    Contact(ContactArguments),
    Export(ExportArguments),
}

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Budget(arguments) => budget::run(&arguments),
        Command::Contact(arguments) => contact::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::from(1)
        }
    }
}
