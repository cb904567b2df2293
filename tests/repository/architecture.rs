//! The drawing of docs/architecture.md is made from the manifests and folders; its table names every folder.
//! `DASHPOT_BLESS=1 cargo test -p dashpot --test repository architecture` draws it anew.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use cargo_metadata::{DependencyKind, Package};
use dashpot::document::{compare_part, in_repository, read};

use crate::workspaces::WORKSPACES;

const DOCUMENT: &str = "docs/architecture.md";

/// Crates whose folders the document names.
const WITH_FOLDERS: [&str; 4] = ["core", "rail", "reference", "hil-host"];

/// Our packages by their folders; the tests across the crates, whose manifest is at the top, by `tests`.
fn packages() -> BTreeMap<String, &'static Package> {
    let all = WORKSPACES.iter().flat_map(|workspace| &workspace.packages);
    all.filter(|package| package.source.is_none())
        .map(|package| (folder_of(package.manifest_path.parent()), package))
        .collect()
}

fn folder_of(path: Option<&cargo_metadata::camino::Utf8Path>) -> String {
    let path = path.expect("a folder").as_std_path();
    let repository = in_repository("").canonicalize().expect("the repository");
    let path = path.canonicalize().expect("a folder");
    let folder = path
        .strip_prefix(repository)
        .expect("within the repository");
    match folder.to_string_lossy().replace('\\', "/") {
        top if top.is_empty() => "tests".into(),
        folder => folder,
    }
}

/// Folders right within the sources of a crate.
fn folders_of(package: &str) -> Vec<String> {
    let sources = in_repository(package).join("src");
    let mut names: Vec<String> = fs::read_dir(sources)
        .expect("sources")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_dir())
        .filter_map(|path| path.file_name()?.to_str().map(str::to_owned))
        .collect();
    names.sort();
    names
}

fn drawing() -> String {
    let packages = packages();
    let mut boxes = String::new();
    let mut arrows = BTreeSet::new();
    for (folder, package) in &packages {
        let within = if WITH_FOLDERS.contains(&&**folder) {
            format!("<br/><i>{}</i>", folders_of(folder).join(", "))
        } else {
            String::new()
        };
        boxes += &format!("    {}[\"<b>{folder}/</b>{within}\"]\n", node(folder));
        for dependency in &package.dependencies {
            let Some(path) = dependency.path.as_deref() else {
                continue; // another's package
            };
            let arrow = match dependency.kind {
                DependencyKind::Development => "-.->",
                _ => "-->",
            };
            arrows.insert((node(folder), arrow, node(&folder_of(Some(path)))));
        }
    }
    // A test's arrow beside a program's own says nothing more.
    let own: BTreeSet<_> = arrows
        .iter()
        .filter(|(_, arrow, _)| *arrow == "-->")
        .cloned()
        .collect();
    arrows.retain(|(from, arrow, to)| {
        *arrow == "-->" || !own.contains(&(from.clone(), "-->", to.clone()))
    });
    let arrows = arrows
        .iter()
        .map(|(from, arrow, to)| format!("    {from} {arrow} {to}\n"));
    let arrows: String = arrows.collect();
    format!("```mermaid\nflowchart BT\n{boxes}{arrows}```\n")
}

/// A name that mermaid takes for a box.
fn node(folder: &str) -> String {
    folder.replace(['/', '-'], "_")
}

#[test]
fn the_drawing_is_the_manifests_and_folders() {
    compare_part(DOCUMENT, "drawing", &drawing());
}

#[test]
fn every_folder_of_the_sources_is_named_and_there() {
    let text = read(DOCUMENT);
    for package in WITH_FOLDERS {
        for folder in folders_of(package) {
            let named = format!("`{package}/src/{folder}/`");
            assert!(text.contains(&named), "{DOCUMENT} does not name {named}");
        }
    }
    let named = text
        .split('`')
        .skip(1)
        .step_by(2)
        .filter(|word| word.ends_with('/'));
    for folder in named {
        assert!(
            Path::is_dir(&in_repository(folder)),
            "{DOCUMENT}: there is no {folder}"
        );
    }
}
