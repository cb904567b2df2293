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
        .env_remove("COLUMNS")
        .output()
        .unwrap();
    assert!(output.status.success(), "{command:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// Names of the commands that a help lists.
fn listed(help: &str) -> Vec<String> {
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    lines
        .take_while(|line| !line.is_empty())
        .filter(|line| !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| *name != "help")
        .map(str::to_owned)
        .collect()
}

/// Appends the help of a command, then that of the commands below it.
fn describe(page: &mut String, command: &[String]) {
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
    for name in listed(&text) {
        describe(page, &[command, &[name]].concat());
    }
}

#[test]
fn the_reference_has_the_help_of_every_command() {
    let mut page = INTRODUCTION.to_owned();
    describe(&mut page, &[]);
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
