//! The engine of the live page is built from the sources that are here.

use std::fs;
use std::path::{Path, PathBuf};

use dashpot::document::{self, in_repository};
use sha2::{Digest, Sha256};

/// What the module is compiled from. CI also builds it again and compares the bytes.
const SOURCES: [&str; 15] = [
    "browser/src",
    "core/src",
    "data/cases",
    "data/dampers",
    "data/tracks",
    "data/vehicles",
    "files/src",
    "live/src",
    "rail/data",
    "rail/src",
    "vehicle-run/src",
    "wear/src",
    "browser/Cargo.toml",
    "core/Cargo.toml",
    "rail/Cargo.toml",
];

const DIGEST: &str = "page/module/sources.sha256";

#[test]
fn the_module_of_the_page_is_built_from_these_sources() {
    let mut hash = Sha256::new();
    for source in SOURCES {
        for path in all_files(&in_repository(source)) {
            let content = fs::read(&path).expect("a source");
            hash.update((content.len() as u64).to_le_bytes());
            hash.update(content);
        }
    }
    let digest: String = hash
        .finalize()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    // `cargo xtask web` builds the module and writes this file.
    document::compare(DIGEST, &(digest + "\n"));
}

/// The file itself, or the files of a folder and its subfolders, in the order of their names.
fn all_files(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    let entries = fs::read_dir(path)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path());
    let mut entries: Vec<PathBuf> = entries.collect();
    entries.sort();
    entries.iter().flat_map(|entry| all_files(entry)).collect()
}
