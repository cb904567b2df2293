//! Compares documents and digests with the text that a test generates.

use std::path::PathBuf;

/// Returns true if `DASHPOT_BLESS=1` requests rewriting the generated files.
pub fn blessing() -> bool {
    std::env::var_os("DASHPOT_BLESS").is_some_and(|value| value == "1")
}

/// A file of the repository.
pub fn in_repository(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The text of a file of the repository.
pub fn read(path: &str) -> String {
    std::fs::read_to_string(in_repository(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Asserts that the file contains `text`, or writes it when blessing.
pub fn compare(path: &str, text: &str) {
    if blessing() {
        std::fs::write(in_repository(path), text).unwrap_or_else(|error| panic!("{path}: {error}"));
        return;
    }
    let found = std::fs::read_to_string(in_repository(path)).unwrap_or_default();
    if found != text {
        let line = found
            .lines()
            .zip(text.lines())
            .position(|(found, text)| found != text)
            .unwrap_or_else(|| found.lines().count().min(text.lines().count()));
        panic!(
            "{path}:{}: `{}` should be `{}`; rewrite the file with DASHPOT_BLESS=1, then review the difference",
            line + 1,
            found.lines().nth(line).unwrap_or("(end)"),
            text.lines().nth(line).unwrap_or("(end)"),
        );
    }
}

/// Like [`compare`], for binary files.
pub fn compare_bytes(path: &str, bytes: &[u8]) {
    let file = in_repository(path);
    if blessing() {
        std::fs::write(file, bytes).unwrap_or_else(|error| panic!("{path}: {error}"));
        return;
    }
    let found = std::fs::read(file).unwrap_or_default();
    let differ = found
        .iter()
        .zip(bytes)
        .position(|(found, byte)| found != byte);
    if let Some(offset) = differ.or_else(|| (found.len() != bytes.len()).then_some(bytes.len())) {
        panic!(
            "{path}, byte {offset}: differs from what this test generates; DASHPOT_BLESS=1 rewrites the file"
        );
    }
}

/// The part of a file between the lines `<!-- name -->` and `<!-- end -->`.
pub fn part(path: &str, name: &str) -> String {
    split(path, name).1
}

/// Asserts that the part of the file is `text`, or writes it when blessing.
pub fn compare_part(path: &str, name: &str, text: &str) {
    let (before, _, after) = split(path, name);
    compare(path, &format!("{before}{text}{after}"));
}

/// Text before the part, the part, and the text after it.
fn split(path: &str, name: &str) -> (String, String, String) {
    let whole = read(path);
    let start = format!("<!-- {name} -->\n");
    let (before, rest) = whole
        .split_once(&start)
        .unwrap_or_else(|| panic!("{path}: no line `<!-- {name} -->`"));
    let (part, after) = rest
        .split_once("<!-- end -->")
        .unwrap_or_else(|| panic!("{path}: no `<!-- end -->` after `<!-- {name} -->`"));
    (
        format!("{before}{start}"),
        part.to_owned(),
        format!("<!-- end -->{after}"),
    )
}
