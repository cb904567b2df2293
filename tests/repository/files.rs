//! Rust files of the repository.

use std::fs;
use std::path::{Path, PathBuf};

use dashpot::document::in_repository;

/// Columns of a line.
const MAX_COLUMNS: usize = 120;

/// Returns the Rust files of a folder and its subfolders; empty if the folder does not exist.
pub fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else {
        return files;
    };
    for entry in entries {
        let path = entry.expect("an entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && !is_skipped(&path, &name) {
            files.append(&mut rust_files(&path));
        } else if name.ends_with(".rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// True for hidden folders and the folders of build output, in which cargo puts a tag.
fn is_skipped(path: &Path, name: &str) -> bool {
    name.starts_with('.')
        || path.join("CACHEDIR.TAG").exists()
        || (name == "target" && path.join("debug").exists())
}

/// Returns the number of lines of a text file.
pub fn line_count(file: &Path) -> usize {
    read(file).lines().count()
}

/// Returns the text of a file.
pub fn read(file: &Path) -> String {
    fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// rustfmt does not break comments and strings.
#[test]
fn no_line_is_too_long() {
    let files = rust_files(&in_repository(""));
    assert!(
        files.len() > 100,
        "{} files: the sources were not found",
        files.len()
    );
    let mut long = Vec::new();
    for file in files {
        for (number, line) in (1..).zip(read(&file).lines()) {
            let columns = line.chars().count();
            if columns > MAX_COLUMNS {
                long.push(format!("{}:{number}: {columns} columns", file.display()));
            }
        }
    }
    assert!(
        long.is_empty(),
        "at most {MAX_COLUMNS} columns are allowed:\n{}",
        long.join("\n")
    );
}
