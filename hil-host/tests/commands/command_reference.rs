//! docs/reference/commands.md has the help of every command.
//! `DASHPOT_BLESS=1 cargo test -p dashpot-hil --test commands command_reference` writes it.

use std::fmt::Write;
use std::process::Command;

use xtask::run::repository;

use crate::common::program;

const PAGE: &str = "docs/reference/commands.md";

const INTRODUCTION: &str = "# Commands

The help of every command, as `dashpot help COMMAND` prints it. [The command line](command-line.md) states what holds
for all of them. `hil-host/tests/commands/command_reference.rs` writes this page and fails if it differs.
";

/// The help of a command: `dashpot help link hello`.
fn help(command: &[String]) -> String {
    let output = Command::new(program())
        .arg("help")
        .args(command)
        // As on a wide terminal.
        .env("COLUMNS", "120")
        .output()
        .unwrap();
    assert!(output.status.success(), "{command:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// Appends the help of a command, then that of the commands below it.
fn describe(page: &mut String, command: &[String], known: &clap::Command) {
    let text = help(command);
    let (heading, name) = match command {
        [] => ("##", "dashpot".to_owned()),
        [one] => ("##", format!("dashpot {one}")),
        _ => ("###", format!("dashpot {}", command.join(" "))),
    };
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    let text = lines.join("\n");
    write!(
        page,
        "\n{heading} {name}\n\n```text\n{}\n```\n",
        text.trim_end()
    )
    .unwrap();
    let below = known.get_subcommands();
    for known in below.filter(|known| known.get_name() != "help") {
        let name = known.get_name().to_owned();
        describe(page, &[command, &[name]].concat(), known);
    }
}

#[test]
fn the_reference_has_the_help_of_every_command() {
    let mut page = INTRODUCTION.to_owned();
    describe(&mut page, &[], &dashpot_hil::cli::command());
    let count = page.matches("\n## ").count();
    assert!(count > 15, "{count} commands");
    let path = repository().join(PAGE);
    if std::env::var_os("DASHPOT_BLESS").is_some_and(|value| value == "1") {
        std::fs::write(path, page).unwrap();
        return;
    }
    let found = std::fs::read_to_string(path).unwrap_or_default();
    let differ = |(_, (found, expected)): &(usize, (&str, &str))| found != expected;
    let lines = found.lines().zip(page.lines()).enumerate();
    if let Some((at, (found, expected))) = lines.into_iter().find(differ) {
        panic!(
            "{PAGE}:{}: `{found}` should be `{expected}`; rewrite it with DASHPOT_BLESS=1",
            at + 1
        );
    }
    assert_eq!(found, page, "{PAGE}: rewrite it with DASHPOT_BLESS=1");
}
