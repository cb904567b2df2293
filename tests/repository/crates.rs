//! Rules about whole crates: the order in which they may depend on one another, and their maximum sizes.

use std::collections::BTreeMap;

use cargo_metadata::{DependencyKind, Package};
use dashpot::document::in_repository;

use crate::files::{line_count, rust_files};
use crate::workspaces::{WORKSPACES, folder_of, packages};

/// Folders of all crates, from the bottom up. A crate may use only those listed before it; tests may use any.
const ORDER: [&str; 32] = [
    "xtask",
    "core",
    "capi",
    "tests/experiment",
    "tests/no_std_consumer",
    "firmware/device",
    "firmware",
    "rail",
    "wear",
    "reference",
    "workers",
    "server",
    "files",
    "hybrid",
    "recording",
    "realtime",
    "testbench",
    "calibration",
    "vehicle-run",
    "live",
    "browser",
    "study",
    "tests/physics",
    "report",
    "page",
    "export",
    "host-link",
    // These two are libraries for other programs, so they use neither the command nor each other.
    "vehicle-model",
    "python",
    "hil-host",
    "tests",
    "fuzz",
];

/// The only crate that may handle a command line.
const COMMAND: &str = "hil-host";

/// Largest share of one crate in all lines under `src/`.
const MAX_SHARE: f64 = 0.2;

/// Folders of our packages on which a package depends when it is built.
fn own_dependencies(package: &Package) -> impl Iterator<Item = String> {
    let built = package
        .dependencies
        .iter()
        .filter(|dependency| dependency.kind != DependencyKind::Development);
    built
        .filter_map(|dependency| dependency.path.as_deref())
        .map(|path| folder_of(Some(path)))
}

#[test]
fn every_crate_is_in_the_order() {
    let mut listed = ORDER.map(str::to_owned);
    listed.sort();
    let found: Vec<String> = packages().into_keys().collect();
    assert_eq!(
        found,
        listed,
        "folders of our packages and `ORDER` of {}",
        file!()
    );
}

#[test]
fn no_crate_uses_one_above_it() {
    let level = |folder: &str| ORDER.iter().position(|listed| *listed == folder);
    let mut upward = Vec::new();
    for (folder, package) in packages() {
        let above =
            own_dependencies(package).filter(|dependency| level(dependency) >= level(&folder));
        upward.extend(above.map(|dependency| format!("{folder} uses {dependency}")));
    }
    assert!(upward.is_empty(), "{upward:#?}");
}

#[test]
fn libraries_know_no_command_line() {
    let mut found = Vec::new();
    for (folder, package) in packages() {
        let built = package
            .dependencies
            .iter()
            .filter(|dependency| dependency.kind != DependencyKind::Development);
        let has_clap = built
            .into_iter()
            .any(|dependency| dependency.name.starts_with("clap"));
        if has_clap && folder != COMMAND {
            found.push(folder);
        }
    }
    assert!(
        found.is_empty(),
        "only {COMMAND} may depend on clap, not {found:?}"
    );
}

/// Keeps crates small enough to build side by side.
#[test]
fn no_crate_has_more_than_a_fifth_of_the_lines() {
    let members = WORKSPACES[0].workspace_packages();
    let folders = members
        .iter()
        .map(|package| folder_of(package.manifest_path.parent()));
    let lines = |folder: &String| {
        let files = rust_files(&in_repository(folder).join("src"));
        files.iter().map(|file| line_count(file)).sum::<usize>()
    };
    let lines: BTreeMap<String, usize> = folders
        .map(|folder| (folder.clone(), lines(&folder)))
        .collect();
    let total: usize = lines.values().sum();
    assert!(total > 10_000, "{total} lines: the sources were not found");
    let max = MAX_SHARE * total as f64;
    let large: Vec<_> = lines
        .iter()
        .filter(|(_, lines)| **lines as f64 > max)
        .collect();
    assert!(
        large.is_empty(),
        "of {total} lines, at most {max:.0} are allowed in a crate: {large:?}"
    );
}
