//! Checks that the drawing of docs/architecture.md matches the manifests and folders, and that its table names every
//! folder.
//! `DASHPOT_BLESS=1 cargo test -p dashpot --test repository architecture` updates the drawing.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use cargo_metadata::DependencyKind;
use dashpot::document::{compare_part, in_repository, read};

use crate::workspaces::{folder_of, packages};

const DOCUMENT: &str = "docs/architecture.md";

/// Crates whose folders the document names.
const WITH_FOLDERS: [&str; 12] = [
    "core",
    "rail",
    "reference",
    "files",
    "recording",
    "realtime",
    "testbench",
    "vehicle-run",
    "study",
    "report",
    "export",
    "hil-host",
];

/// Returns the top-level folders of a crate's sources.
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
                continue; // a package from a registry
            };
            if folder_of(Some(path)) == *folder {
                continue; // its own features, for its tests
            }
            let arrow = match dependency.kind {
                DependencyKind::Development => "-.->",
                _ => "-->",
            };
            arrows.insert((node(folder), arrow, node(&folder_of(Some(path)))));
        }
    }
    // A dashed arrow for tests is left out if there is a solid one.
    let solid: BTreeSet<_> = arrows
        .iter()
        .filter(|(_, arrow, _)| *arrow == "-->")
        .cloned()
        .collect();
    arrows.retain(|(from, arrow, to)| {
        *arrow == "-->" || !solid.contains(&(from.clone(), "-->", to.clone()))
    });
    let arrows = arrows
        .iter()
        .map(|(from, arrow, to)| format!("    {from} {arrow} {to}\n"));
    let arrows: String = arrows.collect();
    format!("```mermaid\nflowchart BT\n{boxes}{arrows}```\n")
}

/// Returns the name of a folder's box; mermaid allows neither slashes nor hyphens.
fn node(folder: &str) -> String {
    folder.replace(['/', '-'], "_")
}

#[test]
fn the_drawing_matches_manifests_and_folders() {
    compare_part(DOCUMENT, "drawing", &drawing());
}

#[test]
fn the_document_names_every_source_folder_and_no_other() {
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
