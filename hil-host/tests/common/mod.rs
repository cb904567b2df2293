//! Runs `dashpot` as a user does.

// Each test binary uses only some of these functions.
#![allow(dead_code)]

pub mod advice;
pub mod bench;
pub mod library;
pub mod live;
pub mod page;

use std::path::Path;
use std::process::Command;

use assert_cmd::assert::Assert;
use assert_cmd::cargo::{cargo_bin, cargo_bin_cmd};
use sha2::{Digest, Sha256};

/// The path of the command.
pub fn program() -> &'static Path {
    cargo_bin!("dashpot")
}

/// Builds the command in `folder`; the test starts it.
pub fn command(arguments: &[&str], folder: &Path) -> Command {
    let mut command = Command::new(program());
    command.args(arguments).current_dir(folder);
    command
}

/// Runs the command in `folder` to its end.
pub fn dashpot(arguments: &[&str], folder: &Path) -> Assert {
    dashpot_reading(b"", arguments, folder)
}

/// Like [`dashpot`], with `input` on its standard input.
pub fn dashpot_reading(input: &[u8], arguments: &[&str], folder: &Path) -> Assert {
    let mut command = cargo_bin_cmd!("dashpot");
    command
        .args(arguments)
        .current_dir(folder)
        // Contact tables are kept in the target folder, not in the home folder of whoever runs the tests.
        .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"))
        .write_stdin(input)
        .assert()
}

/// Text that the command wrote to standard error.
pub fn error_of(ended: &Assert) -> String {
    String::from_utf8_lossy(&ended.get_output().stderr).into_owned()
}

/// Text that the command wrote to standard output.
pub fn text_of(ended: &Assert) -> String {
    String::from_utf8_lossy(&ended.get_output().stdout).into_owned()
}

/// Parses the report of the command: the only JSON object on standard output.
pub fn json_of(ended: &Assert) -> serde_json::Value {
    json(&ended.get_output().stdout)
}

/// Parses the report of a command whose data went to standard output: the only JSON object on standard error.
pub fn json_on_stderr(ended: &Assert) -> serde_json::Value {
    json(&ended.get_output().stderr)
}

fn json(bytes: &[u8]) -> serde_json::Value {
    serde_json::from_slice(bytes).unwrap_or_else(|error| {
        panic!("{error} in `{}`", String::from_utf8_lossy(bytes));
    })
}

/// Names of the files in `folder`, sorted.
pub fn files_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// Compares the vendored files in a folder with the table in its README.md: name, path in the package, SHA-256.
pub fn are_as_their_readme_says(folder: &Path) {
    let readme = std::fs::read_to_string(folder.join("README.md")).unwrap();
    let rows: Vec<Vec<&str>> = readme
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| {
            line.split('|')
                .map(|cell| cell.trim().trim_matches('`'))
                .collect()
        })
        .collect();
    for row in &rows {
        let digest = Sha256::digest(std::fs::read(folder.join(row[1])).unwrap());
        let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(digest, row[3], "{}", row[1]);
    }
    let mut listed: Vec<&str> = rows.iter().map(|row| row[1]).chain(["README.md"]).collect();
    let mut there: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    listed.sort_unstable();
    there.sort_unstable();
    assert_eq!(there, listed);
}
