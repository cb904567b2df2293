//! The `dashpot` command.

use std::process::ExitCode;

use clap::FromArgMatches;
use dashpot_hil::cli::{self, Cli};
use dashpot_hil::commands::failure::Kind;
use dashpot_hil::commands::print::{be_quiet, print_error};
use dashpot_hil::commands::{demonstrate, interruption};

fn main() -> ExitCode {
    let given = cli::command().get_matches();
    let conflicts = cli::check_conflicts(&given);
    let cli = match conflicts.and_then(|()| Cli::from_arg_matches(&given)) {
        Ok(cli) => cli,
        Err(error) => error.format(&mut cli::command()).exit(),
    };
    if cli.quiet {
        be_quiet();
    }
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
    print_error(&failure);
    ExitCode::from(code)
}
