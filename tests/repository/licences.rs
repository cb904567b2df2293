//! Checks licences where cargo-deny does not: lists that must agree, code of others in the repository, our packages.

use std::fs;
use std::path::Path;

use toml::Table;

use crate::workspaces::packages;

/// Reads one list of licences of a file in the top folder.
fn licences(file: &str, keys: &[&str]) -> Vec<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let text = fs::read_to_string(path).unwrap();
    let table: Table = text.parse().unwrap();
    let (last, sections) = keys.split_last().unwrap();
    let section = sections
        .iter()
        .fold(&table, |table, key| table[*key].as_table().unwrap());
    let list = section[*last].as_array().unwrap();
    list.iter()
        .map(|name| name.as_str().unwrap().to_owned())
        .collect()
}

/// The licences that cargo-deny allows are those whose texts the archives have.
#[test]
fn both_lists_of_licences_are_equal() {
    let allowed = licences("deny.toml", &["licenses", "allow"]);
    assert_eq!(licences("about.toml", &["accepted"]), allowed);
    assert_eq!(
        licences("about.toml", &["serialport", "accepted"]),
        ["MPL-2.0"]
    );
}

/// Third-party code in the repository: folder, package, licence.
const VENDORED: [(&str, &str, &str); 1] = [("report/src/page/uplot", "uplot", "MIT")];

/// The folder contains the licence, and its README names the package and the licence.
#[test]
fn vendored_code_keeps_its_licence() {
    let allowed = licences("deny.toml", &["licenses", "allow"]);
    for (folder, package, licence) in VENDORED {
        assert!(allowed.iter().any(|other| other == licence), "{folder}");
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
        let text = read("LICENSE");
        assert!(
            text.starts_with(&format!("The {licence} License")),
            "{text}"
        );
        let readme = read("README.md");
        for statement in [
            format!("package `{package}`"),
            format!("Licence: {licence}"),
        ] {
            assert!(readme.contains(&statement), "{statement}");
        }
    }
}

#[test]
fn our_packages_state_one_licence_and_one_edition() {
    for (folder, package) in packages() {
        assert_eq!(
            package.license.as_deref(),
            Some("MIT OR Apache-2.0"),
            "{folder}"
        );
        assert_eq!(package.edition.as_str(), "2024", "{folder}");
    }
}
