//! Licences of all packages that anything here is built from: each may be used under MIT or Apache-2.0, our own.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use spdx::{Expression, ParseMode};

use crate::workspaces::WORKSPACES;

/// Licences that ask for no more than ours do: that their text is kept.
const ALLOWED: [&str; 7] = [
    "Apache-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "ISC",
    "MIT",
    "Unicode-3.0",
    "Zlib",
];

/// Other licences: package, licence, why it may be used.
const EXCEPTIONS: [(&str, &str, &str); 6] = [
    (
        "serialport",
        "MPL-2.0",
        "behind the feature `serial`; a product may be built without",
    ),
    (
        "cbindgen",
        "MPL-2.0",
        "makes the C header, part of no product",
    ),
    (
        "tiny-keccak",
        "CC0-1.0",
        "asks for nothing; behind the feature `parquet`, which a product may be built without; at compile time only",
    ),
    (
        "target-lexicon",
        "Apache-2.0 WITH LLVM-exception",
        "Apache-2.0 and more allowed; finds Python at compile time only",
    ),
    ("libfuzzer-sys", "NCSA", "part of fuzz targets only"),
    ("webdriver", "MPL-2.0", "drives a browser in tests only"),
];

/// Where cargo gets a package that lies in no folder of the repository.
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
            assert_eq!(source.repr, REGISTRY, "{name}: allowed: from crates.io");
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
    assert_eq!(excepted, listed, "an exception that nothing needs");
}

/// What is kept in the tree and was written by others: folder, package, licence.
const VENDORED: [(&str, &str, &str); 1] = [("report/src/page/uplot", "uplot", "MIT")];

/// It has its licence beside it, its README names package and licence, and what is made of it carries its notice.
#[test]
fn what_is_vendored_keeps_its_licence() {
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
        for told in [
            format!("package `{package}`"),
            format!("Licence: {licence}"),
        ] {
            assert!(readme.contains(&told), "{told}");
        }
    }
}

#[test]
fn our_packages_state_their_licence_and_compiler() {
    for workspace in &*WORKSPACES {
        let ours = workspace
            .packages
            .iter()
            .filter(|package| package.source.is_none());
        for package in ours {
            let name = &package.name;
            assert_eq!(
                package.license.as_deref(),
                Some("MIT OR Apache-2.0"),
                "{name}"
            );
            assert_eq!(package.edition.as_str(), "2024", "{name}");
            let version = package.rust_version.as_ref().map(ToString::to_string);
            // Only the core works with an older compiler than the others.
            let stated = match name.as_str() {
                "dashpot-core" => "1.89.0",
                _ => "1.95.0",
            };
            assert_eq!(version.as_deref(), Some(stated), "{name}");
        }
    }
}
