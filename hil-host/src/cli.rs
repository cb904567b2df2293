//! The command line as a whole: commands in groups, help that fits the terminal, version.

use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Args, CommandFactory, Parser};

use crate::commands::Command;
use crate::commands::demonstrate::DemonstrateArguments;
use crate::headings::with_headings;

/// Widest help, columns: as wide as the examples in it.
const WIDTH: usize = 120;

/// Commands in the order of the help.
const GROUPS: [(&str, &[&str]); 7] = [
    (
        "Recordings",
        &[
            "channels",
            "replay",
            "sheet",
            "calibrate",
            "health",
            "vehicle-sensors",
        ],
    ),
    (
        "Dampers",
        &["rig", "response", "shims", "verify", "budget", "export"],
    ),
    ("Vehicles", &["vehicle", "live", "modes", "contact"]),
    ("Studies", &["sweep", "merge", "tables"]),
    ("Targets and rigs", &["link", "pil", "hybrid"]),
    (
        "Files that ship",
        &[
            "dampers",
            "vehicles",
            "tracks",
            "cases",
            "studies",
            "actuators",
            "sheets",
            "show",
        ],
    ),
    ("This command", &["completions", "man", "help"]),
];

/// Features of this build.
const FEATURES: [(&str, bool); 3] = [
    ("mdf", cfg!(feature = "mdf")),
    ("parquet", cfg!(feature = "parquet")),
    ("serial", cfg!(feature = "serial")),
];

/// Real-time model of a rail vehicle's hydraulic damper. Without a command, runs a demonstration on a synthetic ride.
#[derive(Debug, Clone, Parser)]
#[command(
    name = "dashpot",
    version,
    override_usage = "dashpot [OPTIONS]\n       dashpot <COMMAND>",
    after_help = "Examples:
  dashpot
  dashpot --output damper.html
  dashpot rig --damper paper --amplitude-m 24.875e-3 --frequency-hz 0.64

The file name `-` means standard input or standard output; reports then go to standard error.
Exit code: 0 success, 1 failure, 2 usage error."
)]
pub struct Cli {
    /// Options without a command.
    #[command(flatten)]
    pub demonstration: DemonstrateArguments,
    /// Print no text report, note or progress; errors, lists, JSON and data on standard output remain.
    #[arg(long, short, global = true, display_order = 998)]
    pub quiet: bool,
    /// The command.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// Rejects options of the demonstration before the name of a command; `--quiet` is allowed there.
///
/// # Errors
/// There is such an option.
pub fn check_conflicts(given: &clap::ArgMatches) -> Result<(), clap::Error> {
    let Some((name, _)) = given.subcommand() else {
        return Ok(());
    };
    let is_given = |id: &str| given.value_source(id) == Some(ValueSource::CommandLine);
    let own = DemonstrateArguments::augment_args(clap::Command::new("demonstration"));
    let mut conflict = own
        .get_arguments()
        .filter(|option| is_given(option.get_id().as_str()))
        .filter_map(clap::Arg::get_long);
    match conflict.next() {
        None => Ok(()),
        Some(long) => {
            let message = format!("the subcommand '{name}' cannot be used with '--{long}'");
            Err(command().error(ErrorKind::ArgumentConflict, message))
        }
    }
}

/// The command line with its whole help.
pub fn command() -> clap::Command {
    let command = with_headings(reflowed(Cli::command())).max_term_width(WIDTH);
    let template = format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n{}\nOptions:\n{{options}}{{after-help}}",
        groups(&command)
    );
    command.long_version(version()).help_template(template)
}

/// Lists the commands in their groups, each with what its description says first.
fn groups(command: &clap::Command) -> String {
    let width = GROUPS.iter().flat_map(|(_, names)| *names);
    let width = width.map(|name| name.len()).max().unwrap_or(0);
    let about = |name: &str| match name {
        "help" => Some("Print the help of a command".to_owned()),
        _ => Some(command.find_subcommand(name)?.get_about()?.to_string()),
    };
    let mut text = String::new();
    for (group, names) in GROUPS {
        text += &format!("\n{group}:\n");
        for name in names {
            let about = about(name).unwrap_or_default();
            let first = about.split([':', ';']).next().unwrap_or_default();
            text += &format!("  {name:width$}  {first}\n");
        }
    }
    text
}

/// Joins the lines of each paragraph of every help, so that they are wrapped once, at the width of the terminal.
fn reflowed(command: clap::Command) -> clap::Command {
    let help = command
        .get_after_help()
        .map(|help| joined(&help.to_string()));
    let command = match help {
        Some(help) => command.after_help(help),
        None => command,
    };
    let names: Vec<String> = command
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .collect();
    names.into_iter().fold(command, |command, name| {
        command.mut_subcommand(name, reflowed)
    })
}

/// Joins lines that are not indented with the line before, within a paragraph. Examples are indented.
fn joined(text: &str) -> String {
    let mut joined = String::new();
    let mut is_open = false;
    for line in text.lines() {
        let is_plain = !line.is_empty() && !line.starts_with(' ') && !line.ends_with(':');
        if !joined.is_empty() {
            joined.push(if is_open && is_plain { ' ' } else { '\n' });
        }
        joined += line;
        is_open = is_plain && !line.ends_with('.');
    }
    joined
}

/// Version, commit, features and arithmetic.
fn version() -> String {
    let features = FEATURES.iter().filter(|(_, is_on)| *is_on);
    let features: Vec<&str> = features.map(|(name, _)| *name).collect();
    format!(
        "{}\ncommit: {}\nfeatures: {}\narithmetic: + - * / and libm, none fused; the same bits on every processor",
        env!("CARGO_PKG_VERSION"),
        env!("DASHPOT_COMMIT"),
        match features.is_empty() {
            true => "none".to_owned(),
            false => features.join(", "),
        }
    )
}

#[cfg(test)]
mod tests {
    use super::{GROUPS, command, joined};

    #[test]
    fn every_command_is_in_one_group() {
        let listed: Vec<&str> = GROUPS
            .iter()
            .flat_map(|(_, names)| *names)
            .copied()
            .collect();
        let command = command();
        let names = command.get_subcommands().map(clap::Command::get_name);
        for name in names.filter(|name| *name != "help") {
            let count = listed.iter().filter(|listed| **listed == name).count();
            assert_eq!(count, 1, "{name}");
        }
        assert_eq!(
            listed.len(),
            command
                .get_subcommands()
                .filter(|c| c.get_name() != "help")
                .count()
                + 1
        );
    }

    #[test]
    fn the_command_line_has_no_conflicts() {
        command().debug_assert();
    }

    #[test]
    fn lines_of_a_paragraph_are_joined_and_examples_stay() {
        let examples = "Examples:\n  dashpot a\n  dashpot b\n\n";
        let text =
            format!("{examples}One sentence that\ngoes on. And\nends.\nAnother.\n\nList:\n  x");
        assert_eq!(
            joined(&text),
            format!("{examples}One sentence that goes on. And ends.\nAnother.\n\nList:\n  x")
        );
    }
}
