//! Checks that packages on which a user may depend contain all that they need: licences, a README, and the files they
//! include.

use std::collections::BTreeSet;

use dashpot::document::{in_repository, read};

use crate::files::{self, rust_files};
use crate::source::{Token, tokens};
use crate::workspaces::published;

#[test]
fn published_packages_contain_licences_and_readme() {
    let mut missing = Vec::new();
    for folder in published().keys() {
        for name in ["LICENSE-MIT", "LICENSE-APACHE"] {
            let text = std::fs::read_to_string(in_repository(folder).join(name));
            if text.ok() != Some(read(name)) {
                missing.push(format!("{folder}/{name}, as at the top of the repository"));
            }
        }
        if !in_repository(folder).join("README.md").is_file() {
            missing.push(format!("{folder}/README.md"));
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}

#[test]
fn ci_rehearses_publishing_every_package() {
    let rehearsed = xtask::packages::published().expect("the manifests");
    let rehearsed: BTreeSet<_> = rehearsed
        .into_iter()
        .map(|package| (package.folder, package.name))
        .collect();
    let published = published()
        .into_iter()
        .map(|(folder, package)| (folder, package.name.to_string()));
    assert_eq!(rehearsed, published.collect());
}

/// A registry requires a description and displays the README.
#[test]
fn published_packages_say_what_they_are() {
    for (folder, package) in published() {
        assert!(package.description.is_some(), "{folder}: no description");
        for address in [
            &package.repository,
            &package.homepage,
            &package.documentation,
        ] {
            let is_invented = address
                .as_ref()
                .is_some_and(|address| address.contains(".invalid"));
            assert!(!is_invented, "{folder}: {address:?} does not exist");
        }
        let readme = package.readme.as_ref().map(|readme| readme.as_str());
        assert_eq!(readme, Some("README.md"), "{folder}");
    }
}

#[test]
fn dependencies_of_published_packages_have_versions() {
    let published = published();
    for (folder, package) in &published {
        for dependency in &package.dependencies {
            let is_own = dependency.path.is_some()
                && dependency.kind != cargo_metadata::DependencyKind::Development;
            if !is_own {
                continue;
            }
            let name = &dependency.name;
            assert_ne!(
                dependency.req.to_string(),
                "*",
                "{folder}: {name} has no version"
            );
            let is_published = published.values().any(|other| *other.name == *name);
            assert!(is_published, "{folder}: {name} has `publish = false`");
        }
    }
}

/// A package contains only the files in its own folder.
#[test]
fn published_packages_include_no_file_from_outside() {
    let mut outside = Vec::new();
    for folder in published().keys() {
        let package = in_repository(folder);
        let sources = package.join("src");
        for file in rust_files(&sources) {
            let below = file.strip_prefix(&package).expect("a file of the package");
            let depth = below.components().count() - 1;
            let tokens = tokens(&files::read(&file));
            let steps_up = included(&tokens).filter(|path| path.matches("../").count() > depth);
            outside.extend(steps_up.map(|path| format!("{folder}/{}: {path}", below.display())));
        }
    }
    assert!(outside.is_empty(), "{outside:#?}");
}

/// Text within `include_str!(..)` and `include_bytes!(..)`: paths relative to the file that has the macro, or to the
/// package's folder after `env!("CARGO_MANIFEST_DIR")`.
fn included(tokens: &[Token]) -> impl Iterator<Item = String> {
    let starts = (0..tokens.len()).filter(|at| {
        let name = tokens[*at].name().unwrap_or_default();
        matches!(name, "include_str" | "include_bytes" | "include")
            && tokens.get(at + 1).is_some_and(|token| token.is('!'))
    });
    starts.map(|start| {
        let mut depth = 0;
        let mut text = String::new();
        for token in &tokens[start + 2..] {
            match token {
                Token::Symbol('(' | '[' | '{') => depth += 1,
                Token::Symbol(')' | ']' | '}') => depth -= 1,
                Token::Text(part) => text += part,
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
        // The package contains nothing from above its folder.
        text.replace("CARGO_MANIFEST_DIR/../", &"../".repeat(99))
    })
}

#[test]
fn included_files_are_found() {
    let code = r#"const A: &str = include_str!("../a.txt"); // include_str!("b")
        const C: &[u8] = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/../c.bin"));"#;
    let paths: Vec<String> = included(&tokens(code)).collect();
    assert_eq!(paths[0], "../a.txt");
    assert_eq!(paths[1], format!("{}c.bin", "../".repeat(99)));
    assert_eq!(paths.len(), 2);
}

#[test]
fn the_citation_has_the_version_and_the_licences() {
    let citation = read("CITATION.cff");
    let package = &published()["core"];
    let version = format!("\nversion: {}\n", package.version);
    assert!(
        citation.contains(&version),
        "CITATION.cff: expected{version}"
    );
    let licence = package.license.as_deref().expect("a licence");
    for name in licence.split(" OR ") {
        assert!(citation.contains(&format!("\n  - {name}\n")), "{name}");
    }
}
