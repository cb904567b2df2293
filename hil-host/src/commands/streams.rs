//! Files that options name twice, which is wrong use.

use std::path::{Path, PathBuf};

use super::failure::{Failure, Outcome};
use crate::files::input::is_standard_stream;

/// Refuses `-` for more than one of `inputs`, each an option and the file it names.
///
/// # Errors
/// Two of them are `-`: standard input can be read once.
pub(super) fn refuse_second_standard_input(inputs: &[(&str, &Path)]) -> Outcome<()> {
    let options: Vec<&str> = inputs
        .iter()
        .filter(|(_, path)| is_standard_stream(path))
        .map(|(option, _)| *option)
        .collect();
    if options.len() > 1 {
        return Err(Failure::wrong_use(format!(
            "{}: `-` is standard input, which can be read for one of them only",
            options.join(" and ")
        )));
    }
    Ok(())
}

/// Refuses to write the file at `path`, as `option` asks, over the one at `input`.
///
/// # Errors
/// Both are the same file.
pub(super) fn refuse_input(option: &str, path: &Path, input: &Path) -> Outcome<()> {
    if is_standard_stream(path) || is_standard_stream(input) {
        return Ok(());
    }
    match (path.canonicalize(), input.canonicalize()) {
        (Ok(same), Ok(input)) if same == input => Err(Failure::wrong_use(format!(
            "{option} {}: is the input too; give another output file",
            path.display()
        ))),
        _ => Ok(()),
    }
}

/// Refuses one file for both `--output` and `--page`.
///
/// # Errors
/// Both are the same path.
pub(super) fn refuse_same_output(output: &Option<PathBuf>, page: &Option<PathBuf>) -> Outcome<()> {
    match output {
        Some(path) if page.as_ref() == Some(path) => Err(Failure::wrong_use(format!(
            "--output and --page: both are {}; give each a file of its own",
            path.display()
        ))),
        _ => Ok(()),
    }
}
