//! Checks that the licences of all dependencies are compatible with our own, MIT or Apache-2.0.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use spdx::{Expression, ParseMode};

use crate::workspaces::{WORKSPACES, packages};

/// Licences that require no more than ours does: that their text is kept.
const ALLOWED: [&str; 7] = [
    "Apache-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "ISC",
    "MIT",
    "Unicode-3.0",
    "Zlib",
];

/// Packages with other licences: package, licence, and why we may use it.
const EXCEPTIONS: [(&str, &str, &str); 6] = [
    (
        "serialport",
        "MPL-2.0",
        "behind the optional feature `serial`",
    ),
    (
        "cbindgen",
        "MPL-2.0",
        "generates the C header; not part of any product",
    ),
    (
        "tiny-keccak",
        "CC0-1.0",
        "requires nothing; behind the optional feature `parquet`; used at compile time only",
    ),
    (
        "target-lexicon",
        "Apache-2.0 WITH LLVM-exception",
        "Apache-2.0 with more permissions; finds Python at compile time only",
    ),
    ("libfuzzer-sys", "NCSA", "part of fuzz targets only"),
    ("webdriver", "MPL-2.0", "drives a browser in tests only"),
];

/// The only registry that packages come from.
const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

#[test]
fn every_package_may_be_used_under_our_licences() {
    let mut excepted = BTreeSet::new();
    for workspace in &*WORKSPACES {
        for package in &workspace.packages {
            let name: &str = package.name.as_ref();
            let Some(source) = &package.source else {
                continue; // our own
            };
            assert_eq!(source.repr, REGISTRY, "{name}: only crates.io is allowed");
            let licence = package.license.as_deref().unwrap_or_default();
            let expression = Expression::parse_mode(licence, ParseMode::LAX)
                .unwrap_or_else(|error| panic!("{name}: licence `{licence}`: {error}"));
            let may_be_used = expression.evaluate(|required| {
                let id = required.license.id().map(|id| id.name);
                let required_text = required.to_string();
                let exception = EXCEPTIONS
                    .iter()
                    .find(|(package, licence, _)| *package == name && *licence == required_text);
                excepted.extend(exception.map(|(package, ..)| package));
                required.addition.is_none() && id.is_some_and(|id| ALLOWED.contains(&id))
                    || exception.is_some()
            });
            assert!(
                may_be_used,
                "{name}: licence `{licence}`; allowed: {ALLOWED:?}, or an exception with its reason"
            );
        }
    }
    let listed = EXCEPTIONS.iter().map(|(package, ..)| package).collect();
    assert_eq!(excepted, listed, "exceptions that are not needed");
}

/// Third-party code in the repository: folder, package, licence.
const VENDORED: [(&str, &str, &str); 1] = [("report/src/page/uplot", "uplot", "MIT")];

/// The folder contains the licence, and its README names the package and the licence.
#[test]
fn vendored_code_keeps_its_licence() {
    for (folder, package, licence) in VENDORED {
        assert!(ALLOWED.contains(&licence), "{folder}");
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
