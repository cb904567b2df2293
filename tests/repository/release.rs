//! Every place that states the version of a release states the same.

use dashpot::document::read;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Files and the text in which each states the version.
const PLACES: [(&str, &str); 7] = [
    ("CITATION.cff", "version: {}\n"),
    ("capi/Cargo.toml", "version = \"{}\"\nedition"),
    ("firmware/Cargo.toml", "version = \"{}\"\nedition"),
    (
        "firmware/nucleo-h753zi/Cargo.toml",
        "version = \"{}\"\nedition",
    ),
    ("cluster/Containerfile", "dashpot-{}-x86-64-linux.tar.gz\n"),
    ("docs/install.md", "dashpot-{}-x86-64-linux.tar.gz\n"),
    ("docs/tutorials/cortex-m7.md", "version = \"{}\""),
];

#[test]
fn all_files_state_one_version() {
    for (file, text) in PLACES {
        let expected = text.replace("{}", VERSION);
        assert!(read(file).contains(&expected), "{file}: lacks `{expected}`");
    }
}

/// The changes of a version are below a heading with its date. Those after it are below `Unreleased`.
#[test]
fn the_changelog_has_the_version() {
    let text = read("CHANGELOG.md");
    let headings = text.lines().filter_map(|line| line.strip_prefix("## "));
    let headings: Vec<&str> = headings
        .filter(|heading| *heading != "Unreleased")
        .collect();
    let (version, date) = headings[0]
        .split_once(" - ")
        .expect("a version and its date");
    assert_eq!(version, VERSION);
    let is_date = date.len() == 10 && date.split('-').all(|part| part.parse::<u16>().is_ok());
    assert!(is_date, "{date}");
}
