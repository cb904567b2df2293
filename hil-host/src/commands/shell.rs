//! `dashpot completions` and `dashpot man`: what shells and `man` know about the command.

use std::path::PathBuf;

use clap_complete::Shell;
use dashpot_files::output::cannot_write;

use super::failure::{Failure, Outcome};
use super::print::print_data;

/// Print what a shell needs to complete commands and options.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot completions bash > ~/.local/share/bash-completion/completions/dashpot
  dashpot completions zsh > ~/.zfunc/_dashpot
  dashpot completions fish > ~/.config/fish/completions/dashpot.fish")]
pub struct CompletionsArguments {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

/// Write a manual page for each command.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot man --output ~/.local/share/man/man1")]
pub struct ManArguments {
    /// Folder of the pages, which exists.
    #[arg(long, value_name = "FOLDER")]
    output: PathBuf,
}

/// Prints completions of `command`, the whole command line.
///
/// # Errors
/// Standard output cannot be written.
pub fn completions(arguments: &CompletionsArguments, mut command: clap::Command) -> Outcome<()> {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "dashpot", &mut text);
    print_data(&text)
}

/// Writes the pages of `command`, the whole command line.
///
/// # Errors
/// The folder cannot be written.
pub fn man(arguments: &ManArguments, command: clap::Command) -> Outcome<()> {
    if !arguments.output.is_dir() {
        return Err(Failure::new(format!(
            "{}: no such folder",
            arguments.output.display()
        )));
    }
    let written = clap_mangen::generate_to(command, &arguments.output);
    Ok(written.map_err(|error| cannot_write(&arguments.output, error))?)
}
