//! Rules about the Rust files of the repository.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use dashpot::document::in_repository;

/// Maximum columns of a line.
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

/// True for hidden folders and for folders of build output, which cargo marks with a tag file.
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

/// Numbers, from 1, of the lines that begin inside a string: a line break would change their text.
fn lines_inside_strings(text: &str) -> BTreeSet<usize> {
    let bytes = text.as_bytes();
    let (mut inside, mut line, mut at) = (BTreeSet::new(), 1, 0);
    while at < bytes.len() {
        let rest = &bytes[at..];
        let hashes = |from: usize| {
            rest[from..]
                .iter()
                .take_while(|byte| **byte == b'#')
                .count()
        };
        let is_start_of_word = at == 0 || !bytes[at - 1].is_ascii_alphanumeric();
        let (skipped, is_string) = if rest.starts_with(b"//") {
            (length_to(rest, b"\n"), false)
        } else if rest[0] == b'r' && is_start_of_word && rest.get(1 + hashes(1)) == Some(&b'"') {
            let hashes = hashes(1);
            let end = format!("\"{}", "#".repeat(hashes));
            let start = hashes + 2;
            (
                start + length_to(&rest[start..], end.as_bytes()) + end.len(),
                true,
            )
        } else if rest[0] == b'"' {
            let mut end = 1;
            while end < rest.len() && rest[end] != b'"' {
                end += if rest[end] == b'\\' { 2 } else { 1 };
            }
            (end + 1, true)
        } else if rest.starts_with(b"'\"'") || rest.starts_with(b"'\\\"'") {
            (if rest[1] == b'"' { 3 } else { 4 }, false)
        } else {
            (1, false)
        };
        let skipped = skipped.min(rest.len());
        let breaks: Vec<usize> = (0..skipped).filter(|i| rest[*i] == b'\n').collect();
        for end in breaks {
            line += 1;
            let is_continued = end > 0 && rest[end - 1] == b'\\';
            if is_string && !is_continued {
                inside.insert(line);
            }
        }
        at += skipped.max(1);
    }
    inside
}

/// Number of bytes before `end`, or of all bytes without it.
fn length_to(bytes: &[u8], end: &[u8]) -> usize {
    let found = bytes.windows(end.len()).position(|window| window == end);
    found.unwrap_or(bytes.len())
}

#[test]
fn lines_inside_strings_are_found() {
    let text =
        "let a = \"x\ny\";\n// \"\nlet b = r#\"\"\n\"#;\nlet c = '\"';\nlet d = \"p \\\nq\";\n";
    assert_eq!(lines_inside_strings(text), BTreeSet::from([2, 5]));
}

/// rustfmt does not break comments and strings, so this test checks them.
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
        let text = read(&file);
        // The lines of a generated file are those that its generator writes.
        if text
            .lines()
            .take(10)
            .any(|line| line.ends_with("do not edit."))
        {
            continue;
        }
        let inside = lines_inside_strings(&text);
        for (number, line) in (1..).zip(text.lines()) {
            let columns = line.chars().count();
            if columns > MAX_COLUMNS && !inside.contains(&number) {
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
