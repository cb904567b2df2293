//! Every command line in the documents and in `--help` is parsed without error; on pages about other tools, the
//! `export` commands without `--case` are also run.

use std::path::{Path, PathBuf};
use std::{fs, iter};

use xtask::book::read_sources;
use xtask::run::repository;

use crate::common::dashpot;

/// Pages whose exports go into other tools.
const EXPORTS: [&str; 5] = [
    "fmu.md",
    "labview.md",
    "portable-c.md",
    "simulink.md",
    "twincat.md",
];

/// A line of a document without its indentation, and without the `$` of a console.
fn typed(line: &str) -> &str {
    line.trim().trim_start_matches("$ ")
}

/// Command lines of a document, with lines continued by a backslash joined.
fn lines(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut lines = text.lines().map(typed);
    while let Some(line) = lines.next() {
        let mut whole = line.to_owned();
        while let Some(begun) = whole.strip_suffix('\\') {
            whole = format!("{} {}", begun.trim(), lines.next().unwrap_or_default());
        }
        found.push(whole);
    }
    found
}

/// Arguments of each `dashpot` command in a line: alone, after `&&`, or of `cargo run`.
fn commands(line: &str) -> Vec<Vec<String>> {
    let words = shlex::split(line).unwrap_or_default();
    let of_one = |words: &[String]| {
        let words: Vec<String> = words
            .iter()
            .take_while(|word| ![">", "2>&1", "|", "||"].contains(&&***word))
            .cloned()
            .collect();
        let words = match words.iter().position(|word| word == "--") {
            Some(end) if words.starts_with(&["cargo".into(), "run".into()]) => {
                words[end..].to_vec()
            }
            _ if words.first().is_some_and(|word| word == "dashpot") => words,
            _ => return None,
        };
        Some(words[1..].to_vec())
    };
    words
        .split(|word| word == "&&")
        .filter_map(of_one)
        .collect()
}

fn documents() -> Vec<PathBuf> {
    let pages = read_sources(repository()).unwrap().pages;
    pages.iter().map(|page| repository().join(page)).collect()
}

/// Indented lines of a document and lines of its shell blocks.
fn indented(document: &Path) -> String {
    let text = fs::read_to_string(document).unwrap();
    // Within a block: whether it is one of the shell.
    let mut block = None;
    let mut found = String::new();
    for line in text.lines() {
        if let Some(language) = line.strip_prefix("```") {
            block = match block {
                None => Some(["sh", "bash", "console"].contains(&language)),
                Some(_) => None,
            };
        } else if block.unwrap_or(line.starts_with("    ")) {
            found += line;
            found.push('\n');
        }
    }
    found
}

#[test]
fn every_command_line_is_valid() {
    let whole = dashpot_hil::cli::command();
    let helps = whole.get_subcommands().map(|command| {
        let help = command.get_after_help().map(ToString::to_string);
        (
            format!("dashpot {} --help", command.get_name()),
            help.unwrap_or_default(),
        )
    });
    let documents = documents();
    let pages = documents
        .iter()
        .map(|path| (path.display().to_string(), indented(path)));
    let mut count = 0;
    for (place, text) in pages.chain(helps.collect::<Vec<_>>()) {
        for words in lines(&text).iter().flat_map(|line| commands(line)) {
            // Without a command, it runs the demonstration or prints help.
            if words.first().is_none_or(|word| word.starts_with('-')) {
                continue;
            }
            let line = iter::once("dashpot").chain(words.iter().map(String::as_str));
            let taken = whole.clone().try_get_matches_from(line);
            assert!(taken.is_ok(), "{place}: {words:?}: {}", taken.unwrap_err());
            count += 1;
        }
    }
    // A search that finds no lines must fail.
    assert!(count > 100, "{count}");
}

#[test]
fn exports_for_other_tools_run_as_written() {
    for page in EXPORTS {
        let folder = tempfile::tempdir().unwrap();
        let text = indented(&repository().join("docs").join(page));
        let all: Vec<_> = lines(&text)
            .iter()
            .flat_map(|line| commands(line))
            .collect();
        // The FMU tests run the line of the vehicle, because they build its library.
        let exports = all
            .iter()
            .filter(|words| words[0] == "export" && !words.contains(&"--case".to_owned()));
        let mut count = 0;
        for words in exports {
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            dashpot(&words, folder.path()).success();
            count += 1;
        }
        assert!(count > 0, "{page}");
    }
}
