//! The `dashpot` command.

use std::io::Write;
use std::process::ExitCode;

use clap::FromArgMatches;
use dashpot_hil::cli::{self, Cli};
use dashpot_hil::commands::failure::Kind;
use dashpot_hil::commands::{demonstrate, interruption};

fn main() -> ExitCode {
    let given = cli::command().get_matches();
    let cli = match Cli::from_arg_matches(&given) {
        Ok(cli) => cli,
        Err(error) => error.format(&mut cli::command()).exit(),
    };
    let outcome = interruption::clean_up().and_then(|()| match &cli.command {
        None => demonstrate::run(&cli.demonstration),
        Some(command) => command.run(cli::command),
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
