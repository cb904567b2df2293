//! Checks for files that several options name.

use std::path::{Path, PathBuf};

use super::failure::{Failure, Outcome};
use dashpot_files::input::is_standard_stream;

/// Rejects `-` for more than one of `inputs`, which are pairs of option and path.
///
/// # Errors
/// Two paths are `-`: standard input can be read only once.
pub(super) fn refuse_second_standard_input(inputs: &[(&str, &Path)]) -> Outcome<()> {
    let options: Vec<&str> = inputs
        .iter()
        .filter(|(_, path)| is_standard_stream(path))
        .map(|(option, _)| *option)
        .collect();
    if options.len() > 1 {
        return Err(Failure::wrong_use(format!(
            "{}: `-` is standard input, which can be read for only one of them",
            options.join(" and ")
        )));
    }
    Ok(())
}

/// Rejects an output `path`, given by `option`, that would overwrite `input`.
///
/// # Errors
/// Both paths are the same file.
pub(super) fn refuse_input(option: &str, path: &Path, input: &Path) -> Outcome<()> {
    if is_standard_stream(path) || is_standard_stream(input) {
        return Ok(());
    }
    match (path.canonicalize(), input.canonicalize()) {
        (Ok(same), Ok(input)) if same == input => Err(Failure::wrong_use(format!(
            "{option} {}: this is also an input file; give another output file",
            path.display()
        ))),
        _ => Ok(()),
    }
}

/// Rejects a file that is given twice for `option`.
///
/// # Errors
/// Two paths are the same file.
pub(super) fn refuse_twice(option: &str, inputs: &[PathBuf]) -> Outcome<()> {
    let files: Vec<_> = inputs.iter().map(|path| path.canonicalize().ok()).collect();
    for (number, file) in files.iter().enumerate() {
        if file.is_some() && files[..number].contains(file) {
            return Err(Failure::wrong_use(format!(
                "{option} {}: given twice; give each file once",
                inputs[number].display()
            )));
        }
    }
    Ok(())
}

/// Rejects the same file for two of `outputs`, which are pairs of option and path.
///
/// # Errors
/// Two paths are the same file, even if they are spelled differently.
pub(super) fn refuse_same_output(outputs: &[(&str, Option<&Path>)]) -> Outcome<()> {
    let location = |path: &Path| {
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize();
        folder.map_or_else(
            |_| path.to_owned(),
            |folder| folder.join(path.file_name().unwrap_or_default()),
        )
    };
    let outputs: Vec<(&str, &Path)> = outputs
        .iter()
        .filter_map(|(option, path)| Some((*option, (*path)?)))
        .collect();
    for (number, (option, path)) in outputs.iter().enumerate() {
        for (other, earlier) in &outputs[..number] {
            if location(path) == location(earlier) {
                return Err(Failure::wrong_use(format!(
                    "{other} and {option}: both are {}; give each a different file",
                    path.display()
                )));
            }
        }
    }
    Ok(())
}
